#include "tools/programs/depfile.h"

#include <cstddef>
#include <string_view>

namespace twincraft {
namespace {

/// Backslashes stand for themselves, but where a blank follows: there each is written twice.
std::string escaped(std::string_view path) {
  std::string text;
  std::size_t backslashes = 0;  // right before
  for (const char c : path) {
    if (c == ' ' || c == '\t') text.append(backslashes + 1, '\\');
    if (c == '#') text += '\\';
    if (c == '$') text += '$';
    text += c;
    backslashes = c == '\\' ? backslashes + 1 : 0;
  }
  return text;
}

}  // namespace

std::optional<std::string> depfile_rule(const std::vector<std::string>& outputs,
                                        const std::vector<std::string>& inputs) {
  std::string rule;
  for (const std::string& path : outputs) rule += (rule.empty() ? "" : " ") + escaped(path);
  rule += ':';
  for (const std::string& path : inputs) rule += " \\\n  " + escaped(path);
  for (const std::vector<std::string>* paths : {&outputs, &inputs})
    for (const std::string& path : *paths)
      if (path.find('\n') != std::string::npos) return std::nullopt;
  return rule + '\n';
}

}  // namespace twincraft
