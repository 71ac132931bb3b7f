// MuJoCo alone: a loop around its own calls on the emitted MJCF, with no force applied and nothing
// of ours but the stepper. What both engines are measured against; in its favour, it neither feels
// gravity nor drains tanks, and its state is its own qpos and qvel.
#pragma once

#include <Eigen/Core>
#include <string>

#include "runtime/integrate/runge_kutta.h"
#include "runtime/mujoco/handles.h"

namespace twincraft::bench {

enum class Pipeline {
  kForward,  // mj_forward, with the features as the MJCF sets them
  kMinimal,  // the sub-stages that free multibody motion needs, and no other
};

class RawMujoco final : public Ode {
 public:
  /// @throws NumericalFailure when MuJoCo does not load `mjcf`
  RawMujoco(const std::string& mjcf, Pipeline pipeline);

  int size() const override { return model_->nq + model_->nv; }
  /// (qpos, qvel) to (qpos rate, qacc); no time dependence.
  void derivative(double time, std::span<const double> state, std::span<double> rate) override;
  /// Normalise the quaternion of a free joint.
  void finish_step(std::span<double> state) override;
  StageAccess access() const override { return {__builtin_cpu_supports("avx2") != 0}; }

  /// The MJCF's keyframe.
  Eigen::VectorXd initial_state() const;

 private:
  void write_position_rate(const double* qpos, const double* qvel, double* rate) const;

  Pipeline pipeline_;
  MujocoModel model_;
  MujocoData data_;
  bool is_free_;  // the first joint; else all are slides and hinges
};

/// What a user of MuJoCo runs: its own loop around mj_step, RK4 by MuJoCo itself. Four forward
/// evaluations a step, of which the first also asks for sensors, and checks for numbers that are
/// not finite; sums without compensation, and time that is added up. The MJCF turns contacts and
/// constraints off and has no sensor; gravity, loads and tanks are not in it.
class PlainMujoco {
 public:
  /// @param h  the timestep [s] @throws NumericalFailure when MuJoCo does not load `mjcf`
  PlainMujoco(const std::string& mjcf, double h);

  /// Back to the MJCF's keyframe.
  void restart();
  void step();
  /// No step met a number that is not finite.
  bool is_sound() const;

 private:
  MujocoModel model_;
  MujocoData data_;
};

/// @return `steps`, of mj_step
std::size_t run_raw(PlainMujoco& plain, std::size_t steps);

/// @return `steps` of RK4 from the initial state, `h` [s] each
std::size_t run_raw(RawMujoco& raw, double h, std::size_t steps);

}  // namespace twincraft::bench
