// What is observed of a vehicle, in plain doubles: every element is summed up by itself. What
// observers are held against.
// Used by tests/runtime/observer_test.cpp.
#pragma once

#include <span>

#include "runtime/engine/observation.h"
#include "tests/support/plain_vehicle.h"

namespace twincraft::test {

/// And how large the numbers are that its own kinetic energy is added up of.
struct SizedObservation : Observation {
  double own_kinetic_size = 0.0;  // [J]
};

class PlainObservation : PlainVehicle {
 public:
  explicit PlainObservation(const Model& model) : PlainVehicle(model) {}

  using PlainVehicle::hold;
  SizedObservation observe(double time, std::span<const double> state);

 private:
  void add_elements(SizedObservation& seen) const;
  void add_rotors(SizedObservation& seen) const;
  double springs(const Observation& seen) const;  // [J]
};

}  // namespace twincraft::test
