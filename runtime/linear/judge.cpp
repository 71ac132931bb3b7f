#include "runtime/linear/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compiler/ir/angle.h"
#include "compiler/ir/number.h"
#include "runtime/linear/amplification.h"

namespace twincraft {
namespace {

constexpr double kAdvisedShare = 0.2;   // of a limit: what an advised step aims at
constexpr double kStabilitySets = 0.8;  // of the stability limit: an adaptive method's end
constexpr double kMostTurn = 0.2;       // [rad] in a step, that no failure is laid to
constexpr double kAdvisedTurn = 0.05;   // [rad] in a step
constexpr double kNearPole = 0.35;      // cosine of a pendulum's theta
constexpr double kMostSteps = 1.0e9;    // of a run: a step that takes more is none

}  // namespace

std::vector<Observation> foreseen(const Model& model, const Inspection& inspection) {
  std::vector<Observation> instants;
  for (const double time : inspection.all()) {
    instants.push_back({model.initial});
    instants.back().time = time;
  }
  return instants;
}

void Judge::advise_from(double error, double limit) {
  const double aim = kAdvisedShare * limit;
  if (error <= aim) return;
  const double factor = std::isfinite(error) ? std::pow(aim / error, 1.0 / order()) : 0.01;
  advised_ = std::min(advised_, step_ * factor);
}

Resolution Judge::told() const {
  Resolution resolution;
  resolution.step = model_.simulation.step;
  resolution.fastest = modal_.fastest();
  const bool is_orbit = !resolution.fastest && model_.gravity.mu != 0.0 && run_.motion != nullptr;
  if (is_orbit) resolution.fastest = {"orbit", run_.motion->fastest_orbit_rate(), 0.0, "orbit"};
  if (!is_adaptive(model_) && std::isfinite(modal_.largest_stable_step()))
    resolution.largest_stable_step = modal_.largest_stable_step();
  resolution.attitude_error_deg = attitude_deg_;
  resolution.worst_coordinate = worst_coordinate_;
  if (!worst_coordinate_.empty()) resolution.worst_error = worst_error_;
  return resolution;
}

/// Fixed steps: a step. Adaptive methods: a tolerance.
void Judge::advise(Resolution& resolution) const {
  if (is_adaptive(model_)) {
    const double given = model_.simulation.tolerance.joint.relative;
    resolution.advised_tolerance = nice_step(given * kAdvisedShare / tolerance_factor_);
    return;
  }
  const double advised = std::min({advised_, modal_.advised_step(), step_});
  const std::optional<double> step =
      stable_until_empty(nice_step(advised < step_ ? advised : 0.5 * step_));
  if (!step) return;
  if (is_of_use(*step)) resolution.advised_step = step;
  if (order() >= 4 || *step > 0.1 * step_) return;
  const double of_rk4 = nice_step(std::min(step_, modal_.advised_step_of(kRk4)));
  if (is_of_use(of_rk4)) resolution.advised_rk4_step = of_rk4;
}

/// A run at this step [s] ends in a time that somebody waits for.
bool Judge::is_of_use(double step) const { return model_.simulation.duration < kMostSteps * step; }

/// What a draining tank carries becomes faster the nearer a step comes to the end of the burn: a
/// shorter step meets faster modes.
/// @return  nothing when no step is short enough
std::optional<double> Judge::stable_until_empty(double step) const {
  if (!drains(model_)) return step;
  Model finer = model_;
  while (is_of_use(step)) {
    finer.simulation.step = step;
    const Inspection inspection = plan_inspection(finer);
    const std::vector<Observation> instants = foreseen(finer, inspection);
    const RunShown run{nullptr, instants, finer.simulation.duration, 0.0, {}};
    Judge judge(finer, inspection, run);
    judge.look_at_modes();
    const double stable = judge.modal_.stable_advice();
    if (stable >= step) return step;
    step = nice_step(stable);
  }
  return std::nullopt;
}

/// As a sentence.
std::string Judge::cure(const Resolution& resolution) const {
  if (resolution.advised_tolerance)
    return fmt::format("--set simulation.tolerance={} resolves it",
                       shortest(*resolution.advised_tolerance));
  if (resolution.advised_rk4_step)
    return fmt::format("--integrator rk4 --step '{}' resolves it",
                       step_words(*resolution.advised_rk4_step));
  if (resolution.advised_step)
    return fmt::format("--step '{}' resolves it", step_words(*resolution.advised_step));
  if (drains(model_))
    return "No step of use resolves a tank that empties: end its burn with some propellant left";
  return fmt::format("No step of use resolves it: the run would take more than {:.0e} steps",
                     kMostSteps);
}

Resolution Judge::conclude() {
  Resolution resolution = told();
  if (!is_adaptive(model_))
    findings_.insert(findings_.end(), modal_.findings().begin(), modal_.findings().end());
  if (!findings_.empty()) {
    advise(resolution);
    twincraft::conclude(findings_, cure(resolution), resolution);
  }
  if (is_adaptive(model_) && resolution.fastest) remark_on_steps(resolution);
  return resolution;
}

/// Where stability sets the step, the tolerance says nothing of the error any more.
void Judge::remark_on_steps(Resolution& resolution) const {
  const FastestMotion& fastest = *resolution.fastest;
  if (fastest.kind == "orbit") return;
  const double zeta = std::min(1.0, fastest.damping_ratio);
  const Complex s = fastest.rate * Complex(-zeta, std::sqrt(1.0 - zeta * zeta));
  const double limit = stability_limit(tableau_of(method()), s);
  if (fastest.rate * step_ <= kStabilitySets * limit) return;
  resolution.remarks.push_back(
      fmt::format("{} at {:.3g} 1/s sets the step of {}, not the tolerance", fastest.coordinate,
                  fastest.rate, tableau_of(method()).name));
}

/// A pendulum beside theta = 90 deg, where phi means nothing, in the last good states or just
/// before the jump that ended them.
std::optional<Finding> Judge::pole_at_the_end() const {
  if (run_.motion == nullptr || !run_.motion->last()) return std::nullopt;
  const Observation& last = *run_.motion->last();
  std::vector<Observation> ends = run_.motion->jumps();
  std::erase_if(ends, [&](const Observation& jump) { return jump.time < last.time - 2.0 * step_; });
  ends.push_back(last);
  for (const Coordinate& coordinate : model_.coordinates) {
    if (coordinate.kind != Coordinate::Kind::kPendulum || !coordinate.name.ends_with(".theta"))
      continue;
    for (const Observation& end : ends) {
      const double theta = position_of(coordinate, end);
      if (std::abs(std::cos(theta)) < kNearPole)
        return Finding{ResolutionRule::kRotation, 1.0, coordinate.name, std::nullopt,
                       fmt::format("{} is {:.3g} deg at t = {:.9g} s, near its pole, where phi "
                                   "means nothing: choose another `reference`",
                                   coordinate.name, kDegrees * theta, end.time)};
    }
  }
  return std::nullopt;
}

/// What turned fastest when a run failed that no mode explains: a pendulum at its pole, a chain
/// that whips.
std::optional<Finding> Judge::fastest_at_the_end() {
  if (run_.motion == nullptr || !run_.motion->last()) return std::nullopt;
  const Observation& last = *run_.motion->last();
  Finding finding{ResolutionRule::kRotation, 1.0, "rotation", std::nullopt, "the hub"};
  double rate = last.omega_BN_B.norm();  // [rad/s]
  for (const Coordinate& coordinate : model_.coordinates) {
    if (coordinate.is_wheel() || coordinate.is_length()) continue;
    const double turns = std::abs(rate_of(coordinate, last));
    if (turns <= rate) continue;
    rate = turns;
    finding.coordinate = finding.text = coordinate.name;
  }
  if (rate * step_ <= kMostTurn) return std::nullopt;
  advised_ = std::min(advised_, kAdvisedTurn / rate);
  finding.text +=
      fmt::format(" turns at {:.3g} rad/s at t = {:.9g} s, {:.2g} rad in a step of {} s", rate,
                  last.time, rate * step_, shortest(step_));
  return finding;
}

Resolution Judge::conclude_failure() {
  Resolution resolution = told();
  resolution.resolved = false;
  if (is_adaptive(model_)) return resolution;
  // Beside its pole a pendulum's modes say nothing, and no step is sure to pass it.
  if (const std::optional<Finding> pole = pole_at_the_end()) {
    twincraft::conclude({*pole}, "", resolution);
    return resolution;
  }
  std::optional<Finding> cause = modal_.destroyer();
  if (!cause) cause = fastest_at_the_end();
  if (!cause) return resolution;
  advise(resolution);
  twincraft::conclude({*cause}, cure(resolution), resolution);
  return resolution;
}

}  // namespace twincraft
