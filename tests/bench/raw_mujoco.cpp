#include "tests/bench/raw_mujoco.h"

#include <algorithm>
#include <array>

#include "runtime/engine/engine.h"
#include "runtime/integrate/tableau.h"

namespace twincraft::bench {
namespace {

MujocoModel load(const std::string& mjcf) {
  MujocoModel model = load_mjcf(mjcf);
  hide_pictures(*model);
  return model;
}

void minimal_acceleration(const mjModel* m, mjData* d) {
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_crb(m, d);
  mj_factorM(m, d);
  mj_comVel(m, d);
  mj_passive(m, d);
  mj_rne(m, d, 0, d->qfrc_bias);
  for (int i = 0; i < m->nv; ++i) d->qacc[i] = d->qfrc_passive[i] - d->qfrc_bias[i];
  mj_solveM(m, d, d->qacc, d->qacc, 1);
}

}  // namespace

RawMujoco::RawMujoco(const std::string& mjcf, Pipeline pipeline)
    : pipeline_(pipeline),
      model_(load(mjcf)),
      data_(make_data(*model_)),
      is_free_(model_->jnt_type[0] == mjJNT_FREE) {}

Eigen::VectorXd RawMujoco::initial_state() const {
  mj_resetDataKeyframe(model_.get(), data_.get(), 0);
  Eigen::VectorXd state(size());
  std::copy_n(data_->qpos, model_->nq, state.data());
  std::copy_n(data_->qvel, model_->nv, state.data() + model_->nq);
  return state;
}

void RawMujoco::derivative(double, std::span<const double> state, std::span<double> rate) {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  const double* qpos = state.data();
  const double* qvel = qpos + m->nq;
  std::copy_n(qpos, m->nq, d->qpos);
  std::copy_n(qvel, m->nv, d->qvel);
  if (pipeline_ == Pipeline::kForward) {
    mj_forward(m, d);
  } else {
    minimal_acceleration(m, d);
  }
  write_position_rate(qpos, qvel, rate.data());
  std::copy_n(d->qacc, m->nv, rate.data() + m->nq);
}

// Of a free joint: the velocity in N, and qDot = 1/2 q (0, omega_BN_B).
void RawMujoco::write_position_rate(const double* qpos, const double* qvel, double* rate) const {
  if (!is_free_) {
    std::copy_n(qvel, model_->nv, rate);
    return;
  }
  std::copy_n(qvel, 3, rate);
  const double w = 0.5 * qpos[3], x = 0.5 * qpos[4], y = 0.5 * qpos[5], z = 0.5 * qpos[6];
  const double* omega = qvel + 3;
  rate[3] = -x * omega[0] - y * omega[1] - z * omega[2];
  rate[4] = w * omega[0] + y * omega[2] - z * omega[1];
  rate[5] = w * omega[1] + z * omega[0] - x * omega[2];
  rate[6] = w * omega[2] + x * omega[1] - y * omega[0];
  std::copy_n(qvel + 6, model_->nv - 6, rate + 7);
}

void RawMujoco::finish_step(std::span<double> state) {
  if (is_free_) Eigen::Map<Eigen::Vector4d>(state.data() + 3).normalize();
}

PlainMujoco::PlainMujoco(const std::string& mjcf, double h)
    : model_(load(mjcf)), data_(make_data(*model_)) {
  model_->opt.integrator = mjINT_RK4;
  model_->opt.timestep = h;
}

void PlainMujoco::restart() { mj_resetDataKeyframe(model_.get(), data_.get(), 0); }

void PlainMujoco::step() { mj_step(model_.get(), data_.get()); }

// MuJoCo starts again from its defaults after a bad number, and counts a warning.
bool PlainMujoco::is_sound() const {
  return std::ranges::all_of(std::array{mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC},
                             [this](mjtWarning bad) { return data_->warning[bad].number == 0; });
}

std::size_t run_raw(PlainMujoco& plain, std::size_t steps) {
  plain.restart();
  for (std::size_t i = 0; i < steps; ++i) plain.step();
  if (!plain.is_sound()) throw NumericalFailure("mj_step: the state is not finite");
  return steps;
}

std::size_t run_raw(RawMujoco& raw, double h, std::size_t steps) {
  RungeKutta stepper(kRk4, raw);
  const Eigen::VectorXd initial = raw.initial_state();
  std::copy(initial.begin(), initial.end(), stepper.state().begin());
  for (std::size_t i = 0; i < steps; ++i) stepper.step(h * static_cast<double>(i), h);
  if (!stepper.state_is_finite()) throw NumericalFailure("raw MuJoCo: the state is not finite");
  return steps;
}

}  // namespace twincraft::bench
