// Flags and arguments of our programs. CLI11 reads them, in command_line.cpp alone, because whoever
// includes it takes three seconds longer to compile.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace twincraft {

/// What is wrong with the text of a flag; empty: nothing.
using FlagCheck = std::function<std::string(const std::string& text)>;

/// Accepts exactly these words; for any other it names the nearest.
FlagCheck one_of(std::vector<std::string> words);

/// `program` and what it does; then its flags in the order of its help, which is asked for by -h.
/// Variables outlive it, and hold their defaults until parse().
class CommandLine {
 public:
  CommandLine(std::string_view what, std::string_view program);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// A name without dashes is that of an argument.
  /// @param type  stands for the value in the help: `DIR`
  void add_text(const std::string& name, std::string& value, const std::string& type,
                const std::string& meaning, const std::vector<FlagCheck>& checks = {});
  /// May be given several times.
  void add_list(const std::string& name, std::vector<std::string>& values, const std::string& type,
                const std::string& meaning, const FlagCheck& check = {});
  void add_number(const std::string& name, int& value, int least, int most,
                  const std::string& meaning);
  void add_switch(const std::string& name, bool& value, const std::string& meaning);
  void add_version(const std::string& text);

  /// `flag` says nothing without `other`, which was added before.
  void require(const std::string& flag, const std::string& other);
  /// Below the flags in the help.
  void add_footer(const std::string& text);
  /// Width of the help's first column.
  void set_column(std::size_t width);

  /// Prints help or version to standard output, a usage error with its near miss to standard
  /// error. A flag with an empty value is a usage error. @return nothing to go on, or the code the
  /// program exits with
  std::optional<int> parse(int argc, const char* const* argv);

  /// After parse(): whether the command line has it.
  bool has(const std::string& name) const;

 private:
  class Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace twincraft
