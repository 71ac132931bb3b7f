// See propellant_ledger.h. Tested by tests/components/depletion_test.cpp.
#include "runtime/forces/propellant_ledger.h"

#include <algorithm>

namespace twincraft {

PropellantLedger::PropellantLedger(const std::vector<Tank>& tanks)
    : shares_(tanks.size(), 1.0),
      share_rates_(tanks.size(), 0.0),
      is_idle_(
          std::ranges::all_of(tanks, [](const Tank& tank) { return tank.mass_flow.is_zero(); })) {
  for (const Tank& tank : tanks) tanks_.push_back({.full = tank.content});
}

void PropellantLedger::hold(const Inputs& inputs) {
  for (std::size_t k = 0; k < tanks_.size(); ++k) {
    tanks_[k] = inputs.tanks[k];
    share_rates_[k] = tanks_[k].share_rate();
    // A flow may be driven, or have been before a snapshot.
    is_idle_ = is_idle_ && tanks_[k].flow == 0.0 && tanks_[k].spent == 0.0;
  }
}

std::span<const double> PropellantLedger::shares(double time) {
  if (is_idle_) return shares_;
  for (std::size_t k = 0; k < tanks_.size(); ++k) shares_[k] = tanks_[k].share(time);
  return shares_;
}

}  // namespace twincraft
