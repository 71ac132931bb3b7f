#include "runtime/linear/probes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compiler/ir/angle.h"
#include "runtime/bsm/engine.h"

namespace twincraft {
namespace {

Model in_quaternions(const Model& model) {
  Model same = model;
  same.engines.attitude = AttitudeChart::kQuaternion;
  return same;
}

constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();

/// |a - b|, or nothing where it is rounding of the larger: summed over a long run that would count.
double difference(double a, double b) {
  const double found = std::abs(a - b);
  return found <= kRounding * std::max(std::abs(a), std::abs(b)) ? 0.0 : found;
}

}  // namespace

Prober::Prober(const Model& model)
    : feed_(model),
      engine_(make_bsm_engine(in_quaternions(model))),
      ode_(*engine_),
      stepper_(tableau_of(model.simulation.method), ode_) {
  const double gain = std::pow(2.0, stepper_.tableau().order);
  factor_ = gain / (gain - 1.0);
}

Observation Prober::stepped(const Observation& seen, double h, int steps) {
  const Eigen::VectorXd state = pack(seen, engine_->layout());
  stepper_.restart({state.data(), static_cast<std::size_t>(state.size())});
  for (int step = 0; step < steps; ++step) stepper_.step(seen.time + step * h, h);
  return engine_->observe(seen.time + steps * h, stepper_.state());
}

LocalError Prober::probe(const Observation& seen, double h) {
  engine_->hold(feed_.begin(seen.time));
  const Observation whole = stepped(seen, h, 1);
  const Observation halves = stepped(seen, 0.5 * h, 2);
  LocalError error;
  error.attitude = factor_ * principal_angle(whole.q_BN, halves.q_BN);
  const double apart = (whole.r_CN_N - halves.r_CN_N).norm();
  error.center = apart <= kRounding * whole.r_CN_N.norm() ? 0.0 : factor_ * apart;
  for (std::size_t joint = 0; joint < whole.joint_position.size(); ++joint)
    error.joint.push_back(factor_ *
                          difference(whole.joint_position[joint], halves.joint_position[joint]));
  return error;
}

}  // namespace twincraft
