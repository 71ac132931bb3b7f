// See exchange.h.
#include "runtime/mujoco/exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twincraft {
namespace {

// qDot = 1/2 q (x) (0, omega_BN_B), scalar first, of the normalised quaternion, as MuJoCo reads it.
void write_quaternion_rate(const double* q, const double* omega, double* rate) {
  const double half = 0.5 / std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double w = half * q[0], x = half * q[1], y = half * q[2], z = half * q[3];
  rate[0] = -x * omega[0] - y * omega[1] - z * omega[2];
  rate[1] = w * omega[0] + y * omega[2] - z * omega[1];
  rate[2] = w * omega[1] + z * omega[0] - x * omega[2];
  rate[3] = w * omega[2] + x * omega[1] - y * omega[0];
}

}  // namespace

Exchange::Exchange(const Assembly& assembly, const TreeMap& map)
    : layout_{.chart = AttitudeChart::kQuaternion,
              .joints = static_cast<int>(assembly.links.size()) - 1,
              .wheels = static_cast<int>(assembly.rotors.size())},
      map_(map) {
  for (std::size_t i = 1; i < assembly.links.size(); ++i)
    joint_names_.push_back(assembly.links[i].name);
  for (const Rotor& rotor : assembly.rotors) wheel_names_.push_back(rotor.name);
}

// MuJoCo normalises the quaternion in place, which is not idempotent in the last bit, so everything
// is copied anew before every evaluation.
void Exchange::hand_over(const double* state, Placement placement, mjData& data) const {
  static constexpr double kIdentity[4] = {1.0, 0.0, 0.0, 0.0};
  double* qpos = data.qpos;
  double* qvel = data.qvel;
  const bool raw = placement == Placement::kRaw;
  for (int i = 0; i < 3; ++i) {
    qpos[i] = raw ? state[StateLayout::position() + i] : 0.0;
    qvel[i] = raw ? state[StateLayout::velocity() + i] : 0.0;
    qvel[3 + i] = state[layout_.rate() + i];
  }
  const bool aligned = placement == Placement::kAligned;
  std::copy_n(aligned ? kIdentity : state + StateLayout::attitude(), 4, qpos + 3);
  for (int i = 0; i < layout_.joints; ++i) {
    qpos[map_.joint_qpos.data()[i]] = state[layout_.joint() + i];
    qvel[map_.joint_dof.data()[i]] = state[layout_.joint_rate() + i];
  }
  for (int i = 0; i < layout_.wheels; ++i) {
    qvel[map_.wheel_dof.data()[i]] = state[layout_.wheel() + i];
  }
}

double Exchange::take_back(const double* state, const Vector3d& a_BN_N, const mjData& data,
                           double* rate) const {
  const double* qacc = data.qacc;
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    rate[StateLayout::position() + i] = state[StateLayout::velocity() + i];
    sum += rate[StateLayout::velocity() + i] = a_BN_N[i];
    sum += rate[layout_.rate() + i] = qacc[3 + i];
  }
  write_quaternion_rate(state + StateLayout::attitude(), state + layout_.rate(),
                        rate + StateLayout::attitude());
  for (int i = 0; i < layout_.joints; ++i) {
    rate[layout_.joint() + i] = state[layout_.joint_rate() + i];
    sum += rate[layout_.joint_rate() + i] = qacc[map_.joint_dof.data()[i]];
  }
  for (int i = 0; i < layout_.wheels; ++i) {
    sum += rate[layout_.wheel() + i] = qacc[map_.wheel_dof.data()[i]];
  }
  return sum;
}

std::string Exchange::name(int index) const {
  if (index < StateLayout::velocity()) return "hub position";
  if (index < StateLayout::attitude()) return "hub velocity";
  if (index < layout_.rate()) return "hub attitude";
  if (index < layout_.joint()) return "hub rate";
  const auto joint = [this](int i) {
    return fmt::format("`{}`", joint_names_.at(static_cast<std::size_t>(i)));
  };
  if (index < layout_.joint_rate()) return joint(index - layout_.joint());
  if (index < layout_.wheel()) return "rate of " + joint(index - layout_.joint_rate());
  const auto wheel = static_cast<std::size_t>(index - layout_.wheel());
  return fmt::format("rate of `{}`", wheel_names_.at(wheel));
}

}  // namespace twincraft
