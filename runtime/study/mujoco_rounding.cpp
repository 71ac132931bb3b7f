// See mujoco_rounding.h.
#include "runtime/study/mujoco_rounding.h"

#include <algorithm>
#include <cmath>

#include "runtime/compare/random_state.h"
#include "runtime/compare/rounding.h"
#include "runtime/simulate/engines.h"

namespace twincraft {
namespace {

constexpr std::size_t kSamples = 50;  // looked at, of a run

std::span<const double> view(const Eigen::VectorXd& y) {
  return {y.data(), static_cast<std::size_t>(y.size())};
}

/// What a constant error of 1 in an acceleration moves in `duration` [s^2].
double reach(double duration, double frequency) {
  const double free = 0.5 * duration * duration;
  return frequency > 0.0 ? std::min(free, duration / frequency) : free;
}

class Prediction {
 public:
  Prediction(const Bundle& bundle, const Subject& subject, double duration)
      : model_(bundle.model),
        subject_(subject),
        duration_(duration),
        feed_(bundle.model),
        bsm_(make_engine(EngineKind::kBsm, bundle)),
        mujoco_(make_engine(EngineKind::kMujoco, bundle)) {}

  double at(const Observation& seen) {
    const Eigen::VectorXd x = pack(seen, bsm_->layout());
    const Eigen::VectorXd y = pack(seen, mujoco_->layout());
    const Inputs& inputs = feed_.begin(seen.time);
    bsm_->hold(inputs);
    mujoco_->hold(inputs);
    Eigen::VectorXd rate(x.size());
    bsm_->derivative(seen.time, view(x), {rate.data(), static_cast<std::size_t>(rate.size())});
    const Eigen::MatrixXd M = bsm_->mass_matrix(view(x));
    const Eigen::VectorXd off = acceleration_rounding(mujoco_->rounding_terms(view(y)), M,
                                                      accelerations_of(rate, bsm_->layout()));
    if (!subject_.joint) return off.segment<3>(3).norm() * reach(duration_, 0.0);
    const Eigen::Index entry = 6 + static_cast<Eigen::Index>(*subject_.joint);
    const double stiffness = model_.assembly.links[*subject_.joint + 1].joint.stiffness;
    return off[entry] * reach(duration_, std::sqrt(stiffness * inverse_of(M)(entry, entry)));
  }

 private:
  const Model& model_;
  const Subject& subject_;
  double duration_;  // [s]
  InputFeed feed_;
  std::unique_ptr<Engine> bsm_, mujoco_;
};

}  // namespace

double mujoco_rounding(const Bundle& bundle, const Subject& subject, const Trajectory& run) {
  const bool is_turning = subject.joint || subject.metric == "attitude_deg";
  if (!is_turning || bundle.model.simulation.translation || run.samples.empty()) return 0.0;
  Prediction prediction(bundle, subject, run.samples.back().time);
  const std::size_t stride = 1 + run.samples.size() / kSamples;
  double worst = 0.0;
  for (std::size_t i = 0; i < run.samples.size(); i += stride)
    worst = std::max(worst, prediction.at(run.samples[i]));
  return worst;
}

}  // namespace twincraft
