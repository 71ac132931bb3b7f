// Drawing and writing. Tested by tests/runtime/proof_test.cpp.
#include "runtime/compare/random_state.h"

#include <random>

#include "runtime/engine/state.h"

namespace twincraft {
namespace {

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
  std::mt19937_64 bits_{kStateSeed};
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
  RandomState state{model.initial};
  state.q_BN = Quaterniond::Identity();
  return state;
}

std::vector<RandomState> random_states(const Model& model, int count) {
  Draw draw;
  std::vector<RandomState> states;
  for (int i = 0; i < count; ++i) states.push_back(draw_state(model, draw));
  return states;
}

Eigen::VectorXd accelerations_of(const Eigen::VectorXd& rate, const StateLayout& layout) {
  Eigen::VectorXd accelerations(layout.degrees_of_freedom());
  accelerations << rate.segment<3>(StateLayout::velocity()),
      rate.segment(layout.rate(), layout.rate_size()),
      rate.segment(layout.joint_rate(), layout.joints), rate.segment(layout.wheel(), layout.wheels);
  return accelerations;
}

}  // namespace twincraft
