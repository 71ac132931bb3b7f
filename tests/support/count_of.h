#pragma once

#include <string_view>

namespace twincraft::test {

/// How often `what` stands in `text`.
inline std::size_t count_of(std::string_view text, std::string_view what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

}  // namespace twincraft::test
