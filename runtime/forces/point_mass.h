// The vehicle as a point mass: everything an engine needs but the law of motion itself, which each
// engine states in its own way. Its state is position and velocity alone; the hub's axes stay along
// those of N, so a force fixed in the hub is a force in N. Torques find nothing to turn.
// Tested by tests/runtime/point_mass_test.cpp.
#pragma once

#include "runtime/engine/engine.h"
#include "runtime/forces/forces.h"

namespace twincraft {

class PointMassEngine : public Engine {
 public:
  PointMassEngine& operator=(const PointMassEngine&) = delete;
  const StateLayout& layout() const override { return layout_; }
  Eigen::VectorXd initial_state() const override { return pack(initial_, layout_); }
  void hold(const Inputs& inputs) override;
  void finish_step(std::span<double>) override {}
  void observe(double time, std::span<const double> state, Observation& seen) override;

 protected:
  PointMassEngine(const Model& model, GravityLaw law);
  /// As newly built.
  PointMassEngine(const PointMassEngine& other);

  virtual double mass() const = 0;  // [kg]

  Vector3d gravity(const Vector3d& r_BN_N) const {  // [m/s^2] where the mass is
    return mu_ == 0.0 ? Vector3d(Vector3d::Zero()) : point_gravity(mu_, r_BN_N + r_CB_N_);
  }
  const Vector3d& held_force_N() const { return force_N_; }  // [N] of all loads

  /// What changes the books. @param g_N  [m/s^2] gravity() at its place
  BookRates book_rates(const Vector3d& v_BN_N, const Vector3d& g_N) const {
    return {.power = force_N_.dot(v_BN_N), .force_N = force_N_ + mass() * g_N};
  }

 private:
  VehicleState initial_;
  double mu_;        // [m^3/s^2] zero without gravity
  Vector3d r_CB_N_;  // [m] where in the hub the mass is
  StateLayout layout_{.translation = true};
  Vector3d force_N_ = Vector3d::Zero();
  Vector3d force_at_start_N_;  // [N] at t = 0
};

}  // namespace twincraft
