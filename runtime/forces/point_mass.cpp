// See point_mass.h. Tested by tests/runtime/point_mass_test.cpp.
#include "runtime/forces/point_mass.h"

namespace twincraft {
namespace {

Vector3d center_of_mass(const Model& model) {
  MassProperties sum;
  for (const MassElement& element : model.assembly.links.front().elements) {
    sum = sum + properties_of(element);
  }
  return sum.r_CL_L;
}

}  // namespace

PointMassEngine::PointMassEngine(const Model& model, GravityLaw law)
    : initial_(model.initial),
      mu_(law == GravityLaw::kNone ? 0.0 : model.gravity.mu),
      r_CB_N_(center_of_mass(model)) {
  PointMassEngine::hold(inputs_at(model, 0.0));
  force_at_start_N_ = force_N_;
}

PointMassEngine::PointMassEngine(const PointMassEngine& other)
    : Engine(other),
      initial_(other.initial_),
      mu_(other.mu_),
      r_CB_N_(other.r_CB_N_),
      layout_(other.layout_),
      force_N_(other.force_at_start_N_),
      force_at_start_N_(other.force_at_start_N_) {}

void PointMassEngine::hold(const Inputs& inputs) {
  force_N_.setZero();
  for (int load = 0; load < inputs.layout.loads; ++load)
    force_N_ += inputs.vector(inputs.layout.force(load));
}

void PointMassEngine::observe(double time, std::span<const double> state, Observation& seen) {
  unpack(state, layout_, seen);
  seen.time = time;
  seen.r_CN_N = seen.r_BN_N + r_CB_N_;
  seen.v_CN_N = seen.v_BN_N;
  seen.mass = mass();
  seen.kinetic = 0.5 * seen.mass * seen.v_CN_N.squaredNorm();
  seen.potential = mu_ == 0.0 ? 0.0 : -mu_ * seen.mass / seen.r_CN_N.norm();
  seen.momentum = seen.mass * seen.v_CN_N;
  seen.momentum_scale = seen.momentum.norm();
  seen.own_kinetic = seen.springs = seen.H_scale = 0.0;
  seen.H_PntC_N.setZero();
}

}  // namespace twincraft
