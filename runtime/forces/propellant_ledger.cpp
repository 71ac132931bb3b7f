// See propellant_ledger.h. Tested by tests/components/depletion_test.cpp.
#include "runtime/forces/propellant_ledger.h"

#include <algorithm>
#include <utility>

namespace twincraft {

PropellantLedger::PropellantLedger(std::vector<Tank> tanks)
    : tanks_(std::move(tanks)),
      shares_(tanks_.size(), 1.0),
      share_rates_(tanks_.size(), 0.0),
      is_idle_(
          std::ranges::all_of(tanks_, [](const Tank& tank) { return tank.mass_flow.is_zero(); })) {}

void PropellantLedger::hold(double time) {
  for (std::size_t k = 0; k < tanks_.size(); ++k) {
    share_rates_[k] = -tanks_[k].mass_flow.at(time) / tanks_[k].content;
  }
}

std::span<const double> PropellantLedger::shares(double time) {
  for (std::size_t k = 0; k < tanks_.size(); ++k) shares_[k] = tanks_[k].share(time);
  return shares_;
}

}  // namespace twincraft
