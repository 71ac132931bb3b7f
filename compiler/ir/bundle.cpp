#include "compiler/ir/bundle.h"

namespace twincraft {

const std::string& Bundle::text(std::string_view target) const {
  static const std::string none;
  const auto found = emitted.find(target);
  return found == emitted.end() ? none : found->second.text;
}

}  // namespace twincraft
