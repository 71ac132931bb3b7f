// Tested by tests/agreement/scsim_test.cpp.
#include "tools/programs/cli.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>

#include "compiler/files/output.h"

namespace twincraft {
namespace {

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
std::string check_warning_word(const std::string& word) {
  if (word == "error" || (word.starts_with(kNo) && code_of(word.substr(kNo.size())))) return {};
  std::vector<std::string> words{"error"};
  for (const Code code : all_codes()) words.push_back(fmt::format("{}{}", kNo, code_name(code)));
  const std::string near = nearest(word, words);
  return fmt::format("{} is neither `-Werror` nor `-Wno-CODE` of a known code{}",
                     in_backticks("-W" + word),
                     near.empty() ? "" : fmt::format("; did you mean `-W{}`?", near));
}

}  // namespace

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

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\n\v\f\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(kBlank) - begin + 1));
}

void add_warning_flags(CommandLine& line, std::vector<std::string>& words) {
  line.add_list("-W", words, "error|no-CODE",
                "-Werror: warnings are errors; -Wno-SC3402: leave those out", check_warning_word);
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
