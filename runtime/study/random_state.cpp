// Drawing and writing. Tested by tests/runtime/proof_test.cpp.
#include "runtime/study/random_state.h"

#include <random>

namespace twincraft {
namespace {

constexpr std::uint64_t kSeed = 20240229;

class Draw {
 public:
  /// Uniform in [-1, 1): the top 53 bits, because <random>'s distributions differ between
  /// libraries.
  double symmetric() { return 2.0 * static_cast<double>(bits_() >> 11) * 0x1p-53 - 1.0; }
  double unit() { return 0.5 * (symmetric() + 1.0); }
  Vector3d vector() {
    Vector3d v;
    for (double& entry : v) entry = symmetric();
    return v;
  }
  Quaterniond attitude() {
    Eigen::Vector4d q;
    do {
      for (double& entry : q) entry = symmetric();
    } while (q.squaredNorm() > 1.0 || q.squaredNorm() < 0.01);
    q.normalize();
    return q[0] < 0.0 ? Quaterniond(-q[0], -q[1], -q[2], -q[3])
                      : Quaterniond(q[0], q[1], q[2], q[3]);
  }

 private:
  std::mt19937_64 bits_{kSeed};
};

RandomState draw_state(const Model& model, Draw& draw) {
  RandomState state = undisturbed(model);
  state.time = draw.unit() * model.simulation.duration;
  if (model.simulation.translation) {
    state.r_BN_N += 0.1 * state.r_BN_N.norm() * draw.vector();
    return state;
  }
  state.q_BN = draw.attitude();
  state.omega_BN_B = 0.1 * draw.vector();  // [rad/s]
  for (std::size_t i = 0; i < state.joint_position.size(); ++i) {
    const bool slides = model.assembly.links[i + 1].joint.kind == JointKind::kSlide;
    state.joint_position[i] += (slides ? 0.05 : 0.5) * draw.symmetric();  // [m] or [rad]
    state.joint_rate[i] = (slides ? 0.02 : 0.1) * draw.symmetric();
  }
  for (double& rate : state.wheel_rate) rate = 100.0 * draw.symmetric();  // [rad/s]
  return state;
}

}  // namespace

RandomState undisturbed(const Model& model) {
  const InitialState& start = model.initial;
  return {0.0,
          start.r_BN_N,
          start.v_BN_N,
          Quaterniond::Identity(),
          start.omega_BN_B,
          start.joint_position,
          start.joint_rate,
          start.rotor_speed};
}

std::vector<RandomState> random_states(const Model& model, int count) {
  Draw draw;
  std::vector<RandomState> states;
  for (int i = 0; i < count; ++i) states.push_back(draw_state(model, draw));
  return states;
}

Eigen::VectorXd state_vector(const RandomState& state, const StateLayout& layout) {
  Eigen::VectorXd y(layout.size());
  y.segment<3>(StateLayout::position()) = state.r_BN_N;
  y.segment<3>(StateLayout::velocity()) = state.v_BN_N;
  const Quaterniond& q = state.q_BN;
  if (layout.attitude_size() == 3) y.segment<3>(StateLayout::attitude()) = q.vec() / (1.0 + q.w());
  if (layout.attitude_size() == 4) y.segment<4>(StateLayout::attitude()) << q.w(), q.vec();
  if (layout.rate_size() > 0) y.segment<3>(layout.rate()) = state.omega_BN_B;
  for (std::size_t i = 0; i < state.joint_position.size(); ++i) {
    y[layout.joint() + static_cast<int>(i)] = state.joint_position[i];
    y[layout.joint_rate() + static_cast<int>(i)] = state.joint_rate[i];
  }
  for (std::size_t i = 0; i < state.wheel_rate.size(); ++i)
    y[layout.wheel() + static_cast<int>(i)] = state.wheel_rate[i];
  return y;
}

Eigen::VectorXd accelerations_of(const Eigen::VectorXd& rate, const StateLayout& layout) {
  Eigen::VectorXd accelerations(layout.degrees_of_freedom());
  accelerations << rate.segment<3>(StateLayout::velocity()),
      rate.segment(layout.rate(), layout.rate_size()),
      rate.segment(layout.joint_rate(), layout.joints), rate.segment(layout.wheel(), layout.wheels);
  return accelerations;
}

}  // namespace twincraft
