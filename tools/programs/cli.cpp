// CLI11 says that something is wrong; this file says what was probably meant.
// Tested by tests/agreement/scsim_test.cpp.
#include "tools/programs/cli.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>

#include "compiler/files/output.h"

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

/// Where memory runs out inside a destructor, such as nlohmann's of JSON values, nothing can be
/// caught any more. Allocates nothing.
[[noreturn]] void end_without_catch() {
  const std::exception_ptr fault = std::current_exception();
  std::string_view text = "internal error, please report it\n";
  try {
    if (fault) std::rethrow_exception(fault);
  } catch (const std::bad_alloc&) {
    text = "out of memory\n";
  } catch (...) {
    text = "internal error: an exception nobody expected, please report it\n";
  }
  // Not write_standard_error, which allocates; this text is ours.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(kExitFailure);
}

constexpr std::string_view kNo = "no-";

std::optional<Code> code_of(std::string_view name) {
  for (const Code code : all_codes())
    if (code_name(code) == name) return code;
  return std::nullopt;
}

/// @return empty, or what is wrong with a word after `-W`
std::string check_warning_word(std::string& word) {
  if (word == "error" || (word.starts_with(kNo) && code_of(word.substr(kNo.size())))) return {};
  std::vector<std::string> words{"error"};
  for (const Code code : all_codes()) words.push_back(fmt::format("{}{}", kNo, code_name(code)));
  const std::string near = nearest(word, words);
  return fmt::format("{} is neither `-Werror` nor `-Wno-CODE` of a known code{}",
                     in_backticks("-W" + word),
                     near.empty() ? "" : fmt::format("; did you mean `-W{}`?", near));
}

}  // namespace

std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv) {
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

int report_usage(std::string_view program, const std::string& text, const std::string& hint) {
  write_standard_error(fmt::format("{}: {}\n  hint: {}\n", program, text, hint));
  return kExitUsage;
}

int explain_code(std::string_view program, const std::string& word) {
  std::string wanted = word;
  std::ranges::transform(wanted, wanted.begin(), [](unsigned char c) {
    return static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  });
  const std::optional<Code> code = code_of(wanted);
  if (!code) {
    std::vector<std::string> names;
    for (const Code known : all_codes()) names.emplace_back(code_name(known));
    const std::string near = nearest(wanted, names);
    return report_usage(program, "there is no diagnostic code " + in_backticks(word),
                        near.empty()
                            ? fmt::format("codes run from {} to {}", names.front(), names.back())
                            : fmt::format("did you mean `{}`?", near));
  }
  const std::string error = write_standard_output(
      fmt::format("{}: {}\n\n{}\n", wanted, code_title(*code), code_explanation(*code)));
  if (error.empty()) return kExitDone;
  write_standard_error(fmt::format("{}: {}\n", program, error));
  return kExitInputOutput;
}

CLI::Validator one_of(std::vector<std::string> words) {
  const std::string choices = fmt::format("{}", fmt::join(words, "|"));
  const auto check = [words = std::move(words), choices](std::string& word) -> std::string {
    if (std::find(words.begin(), words.end(), word) != words.end()) return {};
    const std::string near = nearest(word, words);
    return fmt::format("{} is none of {}{}", in_backticks(word), choices,
                       near.empty() ? "" : fmt::format("; did you mean `{}`?", near));
  };
  return CLI::Validator(check, "");
}

void add_warning_flags(CLI::App& app, std::vector<std::string>& words) {
  app.add_option("-W", words, "-Werror: warnings are errors; -Wno-SC3402: leave those out")
      ->type_name("error|no-CODE")
      ->allow_extra_args(false)
      ->check(CLI::Validator(check_warning_word, ""));
}

void judge_warnings(const std::vector<std::string>& words, Diagnostics& diagnostics) {
  std::vector<Code> silent;
  bool promote = false;
  for (const std::string& word : words) {
    if (word == "error") promote = true;
    if (word.starts_with(kNo)) silent.push_back(code_of(word.substr(kNo.size())).value());
  }
  diagnostics.silence(silent);
  if (promote) diagnostics.promote_warnings();
}

int run_program(std::string_view program, const std::function<int()>& body) {
  survive_failed_writes();
  std::set_terminate(end_without_catch);
  try {
    return body();
  } catch (const std::bad_alloc&) {
    write_standard_error(fmt::format("{}: out of memory\n", program));
  } catch (const std::exception& error) {
    write_standard_error(
        fmt::format("{}: internal error: {}\n"
                    "  this is a fault of {}, not of the spec; please report it with the spec\n",
                    program, printable(error.what()), program));
  }
  return kExitFailure;
}

}  // namespace twincraft
