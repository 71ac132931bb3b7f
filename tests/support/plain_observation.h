// What is observed of a vehicle, in plain doubles and by another way than the engine's: every link
// is moved in its own axes, and every element summed up by itself. What observers are held against.
// Used by tests/runtime/observer_test.cpp.
#pragma once

#include <span>

#include "runtime/bsm/motion.h"
#include "runtime/engine/observation.h"
#include "runtime/engine/state.h"
#include "runtime/forces/forces.h"
#include "runtime/forces/propellant_ledger.h"

namespace twincraft::test {

/// And how large the numbers are that its own kinetic energy is added up of.
struct SizedObservation : Observation {
  double own_kinetic_size = 0.0;  // [J]
};

class PlainObservation {
 public:
  explicit PlainObservation(const Model& model);

  void hold(const Inputs& inputs) { propellant_.hold(inputs); }
  SizedObservation observe(double time, std::span<const double> state);

 private:
  void add_elements(SizedObservation& seen) const;
  void add_rotors(SizedObservation& seen) const;
  double springs(const Observation& seen) const;  // [J]

  StateLayout layout_;
  bsm::Tree tree_;
  PropellantLedger propellant_;
  Elements elements_;
  ForceModel forces_;
  bsm::Motion motion_;
};

}  // namespace twincraft::test
