// See elements.h. Tested by tests/runtime/forces_test.cpp.
#include "runtime/forces/elements.h"

namespace twincraft {

void Elements::add(std::size_t link, const MassElement& element) {
  Placed placed;
  placed.set(0, element);
  placed.link = link;
  placed.tank = element.tank;
  placed.full_mass = element.mass;
  if (element.tank >= 0) draining_.push_back({now_.size(), placed});
  now_.push_back(placed);
}

void Elements::set_shares(std::span<const double> shares) {
  for (const Draining& draining : draining_) {
    Placed& element = now_[draining.element];
    element.keep(shares[static_cast<std::size_t>(element.tank)], draining.full);
  }
}

}  // namespace twincraft
