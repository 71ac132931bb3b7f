// What is left in the tanks at the time of an evaluation, for both engines alike. Shares follow the
// time of the stage; the flow is held from event to event like any other input, so that a stage at
// the end of a step does not see the next one's. Tested by tests/components/depletion_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "compiler/ir/inputs.h"

namespace twincraft {

class PropellantLedger {
 public:
  explicit PropellantLedger(const std::vector<Tank>& tanks);

  /// Nothing has ever flowed and nothing will by schedule: all shares are 1.
  bool is_idle() const { return is_idle_; }

  void hold(const Inputs& inputs);

  /// Of every tank: what is left at `time`, as a part of what it held at t = 0. No allocation.
  std::span<const double> shares(double time);

  /// Of every tank: d(share)/dt [1/s] under the held flow.
  std::span<const double> share_rates() const { return share_rates_; }

 private:
  std::vector<Drain> tanks_;
  std::vector<double> shares_, share_rates_;
  bool is_idle_;
};

}  // namespace twincraft
