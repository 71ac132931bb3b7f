// Lines of a source text. Tested by tests/compiler/diag_test.cpp.
#include "compiler/diag/source.h"

#include <algorithm>
#include <utility>

namespace twincraft {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

Source::Source(std::string name, std::string text)
    : name_(std::move(name)), text_(std::move(text)) {
  if (text_.starts_with(kByteOrderMark)) text_.erase(0, kByteOrderMark.size());
  line_starts_.push_back(0);
  for (std::size_t at = text_.find('\n'); at != std::string::npos; at = text_.find('\n', at + 1)) {
    line_starts_.push_back(at + 1);
  }
}

std::string_view Source::line(int number) const {
  if (number < 1 || static_cast<std::size_t>(number) > line_starts_.size()) return {};
  const std::size_t index = static_cast<std::size_t>(number) - 1;
  const bool last = index + 1 == line_starts_.size();
  const std::size_t begin = line_starts_[index];
  const std::size_t end = last ? text_.size() : line_starts_[index + 1] - 1;
  std::string_view text = std::string_view(text_).substr(begin, end - begin);
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

Span Source::span(std::size_t begin, std::size_t length) const {
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), begin);
  const auto line = after - line_starts_.begin();
  const std::size_t column = begin - *(after - 1) + 1;
  return {this, static_cast<int>(line), static_cast<int>(column), static_cast<int>(length)};
}

const Source& Sources::add(std::string name, std::string text) {
  return sources_.emplace_back(std::move(name), std::move(text));
}

}  // namespace twincraft
