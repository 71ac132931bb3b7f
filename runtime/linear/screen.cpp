#include "runtime/linear/screen.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/linear/amplification.h"
#include "runtime/linear/inspection.h"
#include "runtime/linear/linearise.h"

namespace twincraft {
namespace {

// A fifth of what the rules allow and less: a mode within it is not near its limit of stability
// either, and a bound on a mode need not see how far it is excited.
constexpr double kModeError = 0.01;      // of the motion; the rule's is 5 %
constexpr double kTurnError = 1.0e-3;    // [rad]; the rule's is 0.1 deg at least
constexpr double kOrbitError = 1.0e-4;   // of the distance; the rule's is 1e-3
constexpr double kAcceptedTurn = 0.01;   // [rad]; the rule's is 1 deg
constexpr double kLeastMotion = 1.0e-6;  // [rad] or [m]: less is no motion

/// [rad/s] Of the hub, or of a hinge where that is faster.
double turning_of(const Model& model, const Observation& seen) {
  double rate = seen.omega_BN_B.norm();
  for (std::size_t joint = 0; joint < seen.joint_rate.size(); ++joint)
    if (model.assembly.links[joint + 1].joint.kind == JointKind::kHinge)
      rate = std::max(rate, std::abs(seen.joint_rate[joint]));
  return rate;
}

/// The modes at one state after another.
class ModeScreen {
 public:
  explicit ModeScreen(const Model& model)
      : plan_(model.simulation), tableau_(tableau_of(plan_.method)), motion_(model) {}

  bool sees_too_many() const { return motion_.size() > kMostStates; }

  /// No mode is faster than the norm of a power of A allows, which tells most vehicles at once.
  bool passes(const Observation& seen, double inputs_at) {
    const Eigen::MatrixXd A = motion_.jacobian(seen, inputs_at), square = A * A;
    const double fastest = std::sqrt(std::sqrt((square * square).norm()));
    if (fastest_mode_error_bound(tableau_, fastest, plan_.step, plan_.duration) <= kModeError)
      return true;
    const std::optional<Eigen::VectorXcd> found = eigenvalues(A);
    return found && std::ranges::all_of(*found, [this](Complex s) {
             return mode_error_bound(tableau_, s, plan_.step, plan_.duration) <= kModeError;
           });
  }

 private:
  const SimulationPlan& plan_;
  const Tableau& tableau_;
  OwnMotion motion_;
};

}  // namespace

ResolutionScreen::ResolutionScreen(const Model& model)
    : model_(model), joints_(model.assembly.links.size() - 1) {}

void ResolutionScreen::see(const Observation& sample) {
  const double turning = turning_of(model_, sample);
  if (turning > turning_) {
    turning_ = turning;
    fastest_ = sample;
  }
  for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    joints_[joint].see(sample.joint_position[joint]);
  if (model_.gravity.mu == 0.0) return;
  const double r = sample.r_CN_N.norm();
  orbit_rate_ = std::max(orbit_rate_, sample.r_CN_N.cross(sample.v_CN_N).norm() / (r * r));
}

bool ResolutionScreen::passes(const Observation& last, const AcceptedErrors& accepted) const {
  if (tableau_of(model_.simulation.method).adaptive) return passes_accepted(accepted);
  return passes_motion() && (model_.simulation.translation || passes_modes(last));
}

bool ResolutionScreen::passes_accepted(const AcceptedErrors& accepted) const {
  for (std::size_t joint = 0; joint < accepted.joint.size(); ++joint)
    if (!(accepted.joint[joint] <= kModeError * std::max(joints_[joint].half(), kLeastMotion)))
      return false;
  return accepted.attitude <= kAcceptedTurn;
}

/// What turns at a rate meets every force on it as a vibration at that rate. On an orbit the
/// amplitude that a step loses changes the period, too, which adds up with the square of the steps.
bool ResolutionScreen::passes_motion() const {
  const SimulationPlan& plan = model_.simulation;
  const Tableau& tableau = tableau_of(plan.method);
  const auto error = [&](double rate) {
    return fastest_mode_error_bound(tableau, rate, plan.step, plan.duration);
  };
  if (!plan.translation && !(error(turning_) <= kTurnError)) return false;
  if (model_.gravity.mu == 0.0) return true;
  const double steps = plan.duration / plan.step, angle = orbit_rate_ * plan.step;
  const double lost = std::abs(1.0 - std::abs(amplification(tableau, Complex(0.0, angle))));
  return error(orbit_rate_) + 1.5 * angle * lost * steps * steps <= kOrbitError;
}

bool ResolutionScreen::passes_modes(const Observation& last) const {
  ModeScreen screen(model_);
  if (screen.sees_too_many()) return true;
  const Inspection inspection = plan_inspection(model_);
  Observation at{model_.initial};
  const auto foresees = [&](double time) {
    at.time = time;
    return screen.passes(at, time);
  };
  const auto foresees_all = [&](const std::vector<double>& times) {
    return std::ranges::all_of(times, foresees);
  };
  for (const Stretch& stretch : inspection.stretches)
    if (!foresees(stretch.begin)) return false;
  if (drains(model_) && !(foresees_all(inspection.before) && foresees_all(inspection.along)))
    return false;
  return screen.passes(fastest_, fastest_.time) && screen.passes(last, last.time);
}

}  // namespace twincraft
