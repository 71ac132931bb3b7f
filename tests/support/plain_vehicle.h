// A vehicle in plain doubles, by another way than the engine's kernel: every link is moved from its
// parent, in its own axes. Plain books and observations are sums over it.
#pragma once

#include "runtime/bsm/motion.h"
#include "runtime/engine/state.h"
#include "runtime/forces/forces.h"
#include "runtime/forces/propellant_ledger.h"

namespace twincraft::test {

class PlainVehicle {
 protected:
  explicit PlainVehicle(const Model& model);

  void hold(const Inputs& inputs);
  /// Let masses be those that the tanks leave, and links move as the state says.
  void move_to(double time, const VehicleState& state);

  StateLayout layout_;
  bsm::Tree tree_;
  PropellantLedger propellant_;
  Elements elements_;   // all of them
  ForceModel forces_;   // gravity and loads
  bsm::Motion motion_;  // with the velocity of B taken as zero
};

}  // namespace twincraft::test
