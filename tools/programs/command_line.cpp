// CLI11 says that something is wrong; this file says what was probably meant.
// Tested by tests/agreement/scsim_test.cpp.
#include "tools/programs/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "compiler/diag/diagnostics.h"
#include "tools/programs/cli.h"

namespace twincraft {
namespace {

struct Fault {
  std::string text;
  std::string hint;
};

std::vector<std::string> flags_of(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  return flags;
}

/// What CLI11 could not place: an unknown flag or one argument too many.
Fault unexpected(const CLI::App& app, const std::vector<std::string>& extras) {
  const auto flag = std::find_if(extras.begin(), extras.end(),
                                 [](const std::string& text) { return text.starts_with('-'); });
  if (flag == extras.end())
    return {fmt::format("unexpected argument {}", in_backticks(extras.front())),
            fmt::format("`{} --help` shows the usage", app.get_name())};
  const std::string word = flag->substr(0, flag->find('='));
  const std::string near = nearest(word, flags_of(app));
  return {fmt::format("unknown flag {}", in_backticks(word)),
          near.empty() ? fmt::format("`{} --help` lists the flags", app.get_name())
                       : fmt::format("did you mean `{}`?", near)};
}

/// `-o`, or the name of a positional argument.
std::string shown_name(const CLI::Option& option) {
  return option.nonpositional() && !option.get_snames().empty() ? "-" + option.get_snames().front()
                                                                : option.get_name();
}

/// An empty value is a variable of the shell that was not set, and never means the default.
std::optional<Fault> empty_value(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const std::vector<std::string>& values = option->results();
    if (std::ranges::find(values, std::string()) == values.end()) continue;
    const std::string name = shown_name(*option);
    if (option->get_type_name() == "DIR")
      return Fault{fmt::format("`{}` names no folder: its value is empty", name),
                   fmt::format("write for example `{} out`", name)};
    return Fault{fmt::format("`{}` is empty", name),
                 fmt::format("give it a value, or leave it out; `{} --help` shows the usage",
                             app.get_name())};
  }
  return std::nullopt;
}

/// A slip in a flag can leave CLI11 complaining of something else first; the slip is the cause.
Fault fault_of(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> extras = app.remaining();
  if (!extras.empty()) return unexpected(app, extras);
  const std::string text = error.what();
  const auto ends_at = [&text](std::string_view part) { return text.find(part); };
  if (const std::size_t end = ends_at(": At Most 1 required"); end != std::string::npos)
    return {fmt::format("{} is given more than once", in_backticks(text.substr(0, end))),
            "give it once; only `--set` and `-W` can be repeated"};
  const std::string prefix = "Could not convert: ";
  if (const std::size_t end = ends_at(" = "); text.starts_with(prefix) && end != std::string::npos)
    return {fmt::format("`{}` cannot be {}", text.substr(prefix.size(), end - prefix.size()),
                        in_backticks(text.substr(end + 3))),
            "a whole number is expected"};
  return {printable(text), fmt::format("`{} --help` shows the flags", app.get_name())};
}

/// Without words of its own in the help.
CLI::Validator validator(const FlagCheck& check) {
  return CLI::Validator([check](std::string& text) { return check(text); }, "");
}

}  // namespace

FlagCheck one_of(std::vector<std::string> words) {
  const std::string choices = fmt::format("{}", fmt::join(words, "|"));
  return [words = std::move(words), choices](const std::string& word) -> std::string {
    if (std::find(words.begin(), words.end(), word) != words.end()) return {};
    const std::string near = nearest(word, words);
    return fmt::format("{} is none of {}{}", in_backticks(word), choices,
                       near.empty() ? "" : fmt::format("; did you mean `{}`?", near));
  };
}

class CommandLine::Parser : public CLI::App {
 public:
  using CLI::App::App;
  std::string version;
};

CommandLine::CommandLine(std::string_view what, std::string_view program)
    : parser_(std::make_unique<Parser>(std::string(what), std::string(program))) {}

CommandLine::~CommandLine() = default;

void CommandLine::add_text(const std::string& name, std::string& value, const std::string& type,
                           const std::string& meaning, const std::vector<FlagCheck>& checks) {
  CLI::Option* option = parser_->add_option(name, value, meaning)->type_name(type);
  for (const FlagCheck& check : checks) option->check(validator(check));
}

void CommandLine::add_list(const std::string& name, std::vector<std::string>& values,
                           const std::string& type, const std::string& meaning,
                           const FlagCheck& check) {
  CLI::Option* option = parser_->add_option(name, values, meaning)->type_name(type);
  option->allow_extra_args(false);
  if (check) option->check(validator(check));
}

void CommandLine::add_number(const std::string& name, int& value, int least, int most,
                             const std::string& meaning) {
  parser_->add_option(name, value, meaning)
      ->type_name("N")
      ->check(CLI::Range(least, most).description(""));
}

void CommandLine::add_switch(const std::string& name, bool& value, const std::string& meaning) {
  parser_->add_flag(name, value, meaning);
}

void CommandLine::add_version(const std::string& text) { parser_->version = text; }

void CommandLine::require(const std::string& flag, const std::string& other) {
  parser_->get_option(flag)->needs(parser_->get_option(other));
}

void CommandLine::add_footer(const std::string& text) { parser_->footer(text); }

void CommandLine::set_column(std::size_t width) { parser_->get_formatter()->column_width(width); }

std::optional<int> CommandLine::parse(int argc, const char* const* argv) {
  Parser& app = *parser_;
  app.set_help_flag("-h,--help", "print this");  // here, so that the help ends with them
  if (!app.version.empty()) app.set_version_flag("--version", app.version, "print the version");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wish) {  // --help, --version
    return app.exit(wish);
  } catch (const CLI::ParseError& error) {
    const Fault fault = fault_of(app, error);
    return report_usage(app.get_name(), fault.text, fault.hint);
  }
  const std::optional<Fault> fault = empty_value(app);
  if (fault) return report_usage(app.get_name(), fault->text, fault->hint);
  return std::nullopt;
}

bool CommandLine::has(const std::string& name) const {
  return parser_->get_option(name)->count() > 0;
}

}  // namespace twincraft
