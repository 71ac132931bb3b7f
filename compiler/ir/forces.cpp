// See forces.h.
#include "compiler/ir/forces.h"

#include <set>

namespace twincraft {

std::vector<int> links_of(const Forces& forces) {
  std::set<int> links;
  forces.for_each_kind([&links](const char*, const auto& kind) {
    for (const auto& force : kind)
      for (const int link : force.links()) links.insert(link);
  });
  return {links.begin(), links.end()};
}

}  // namespace twincraft
