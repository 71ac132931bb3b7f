// The rates of the books in plain doubles: every wrench is written down. What the kernel is held
// against.
// Used by tests/runtime/books_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "runtime/engine/observation.h"
#include "runtime/forces/link_forces.h"
#include "tests/support/plain_vehicle.h"

namespace twincraft::test {

/// And how large the numbers are that are added up: what rounding is relative to.
struct SizedRates : BookRates {
  double power_size = 0.0, own_power_size = 0.0;  // [W]
  double force_size = 0.0;                        // [N]
  double torque_size = 0.0;                       // [N m]
};

class PlainBooks : PlainVehicle {
 public:
  explicit PlainBooks(const Model& model);

  void hold(const Inputs& inputs);
  SizedRates rates(double time, std::span<const double> state);

 private:
  struct State;
  struct Center {
    double mass = 0.0;                   // [kg]
    Vector3d r_CB_B = Vector3d::Zero();  // [m]
    Vector3d v_CB_B = Vector3d::Zero();  // [m/s] with the velocity of B taken as zero
  };

  Center center() const;
  void add_inner_power(const State& x, SizedRates& rates) const;
  void add_fall(const State& x, const Center& center, SizedRates& rates) const;
  void add_forces(double time, const State& x, const Center& center, SizedRates& rates);
  void add_leaving(const State& x, const Center& center, SizedRates& rates) const;

  LinkForces link_forces_;
  Inputs inputs_;
  std::vector<Wrench> wrenches_;
};

}  // namespace twincraft::test
