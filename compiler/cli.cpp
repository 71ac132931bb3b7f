// CLI11 says that something is wrong; this file says what was probably meant.
// Tested by tests/agreement/scsim_test.cpp.
#include "compiler/cli.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "compiler/diag/diagnostics.h"

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
                                 [](const std::string& text) { return text.starts_with("-"); });
  if (flag == extras.end())
    return {fmt::format("unexpected argument `{}`", printable(extras.front())),
            fmt::format("`{} --help` shows the usage", app.get_name())};
  const std::string word = flag->substr(0, flag->find('='));
  const std::string near = nearest(word, flags_of(app));
  return {fmt::format("unknown flag `{}`", printable(word)),
          near.empty() ? fmt::format("`{} --help` lists the flags", app.get_name())
                       : fmt::format("did you mean `{}`?", near)};
}

/// A slip in a flag can leave CLI11 complaining of something else first; the slip is the cause.
Fault fault_of(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> extras = app.remaining();
  if (!extras.empty()) return unexpected(app, extras);
  return {printable(error.what()), fmt::format("`{} --help` shows the flags", app.get_name())};
}

}  // namespace

std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::Success& wish) {  // --help, --version
    return app.exit(wish);
  } catch (const CLI::ParseError& error) {
    const Fault fault = fault_of(app, error);
    fmt::print(stderr, "{}: {}\n  hint: {}\n", app.get_name(), fault.text, fault.hint);
    return kExitUsage;
  }
}

CLI::Validator one_of(std::vector<std::string> words) {
  const std::string choices = fmt::format("{}", fmt::join(words, "|"));
  const auto check = [words = std::move(words), choices](std::string& word) -> std::string {
    if (std::find(words.begin(), words.end(), word) != words.end()) return {};
    const std::string near = nearest(word, words);
    return fmt::format("`{}` is none of {}{}", word, choices,
                       near.empty() ? "" : fmt::format("; did you mean `{}`?", near));
  };
  return CLI::Validator(check, "");
}

bool wants_colour(int file_descriptor) {
  const char* no_colour = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return ::isatty(file_descriptor) != 0 && (no_colour == nullptr || *no_colour == '\0') &&
         terminal != nullptr && std::string_view(terminal) != "dumb";
}

}  // namespace twincraft
