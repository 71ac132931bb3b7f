// See propellant.h. Tested by tests/compiler/ir_test.cpp.
#include "compiler/ir/propellant.h"

#include <algorithm>

namespace twincraft {

double Tank::content_at(double time) const {
  double spent = 0.0;
  const auto& entries = mass_flow.entries;
  for (std::size_t i = 0; i < entries.size() && entries[i].time < time; ++i) {
    const double begin = std::max(entries[i].time, 0.0);
    const double end = i + 1 < entries.size() ? std::min(entries[i + 1].time, time) : time;
    spent += entries[i].value * std::max(end - begin, 0.0);
  }
  return content - spent;
}

}  // namespace twincraft
