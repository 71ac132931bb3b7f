// The error norm by blocks and the loop that accepts or rejects.
// Tested by tests/runtime/runge_kutta_test.cpp.
#include "runtime/integrate/step_control.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "compiler/ir/number.h"
#include "runtime/engine/engine.h"

namespace twincraft {
namespace {

constexpr double kSafety = 0.9;
constexpr double kGrowth = 4.0;
constexpr double kShrink = 0.1;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Entries = Eigen::Map<const Eigen::VectorXd>;

Entries entries(std::span<const double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// Principal angle [rad] in [0, pi].
double attitude_angle(AttitudeChart chart, const Entries& attitude) {
  if (chart == AttitudeChart::kQuaternion)
    return 2.0 * std::atan2(attitude.tail<3>().norm(), std::abs(attitude[0]));
  const double angle = 4.0 * std::atan(attitude.norm());
  return std::min(angle, 2.0 * std::numbers::pi - angle);
}

/// Angle [rad] by which a small `error` of the chart's components turns the body.
double attitude_error(AttitudeChart chart, const Entries& attitude, const Entries& error) {
  const double norm_squared = attitude.squaredNorm();
  // An MRP is a stereographic projection of the unit quaternion, which stretches all directions
  // alike: |dq| = 2 |dsigma| / (1 + |sigma|^2), and the angle is twice |dq|.
  if (chart == AttitudeChart::kMrp) return 4.0 * error.norm() / (1.0 + norm_squared);
  // The part along the quaternion only changes its norm, which normalisation takes away.
  const double stretch = attitude.dot(error) / norm_squared;
  return 2.0 * (error - stretch * attitude).norm() / std::sqrt(norm_squared);
}

double step_factor(double ratio, double exponent) {
  if (ratio == 0.0) return kGrowth;
  return std::clamp(kSafety * std::pow(ratio, -exponent), kShrink, kGrowth);
}

}  // namespace

std::string_view block_name(Block block) {
  constexpr std::array<std::string_view, kBlocks> kNames{
      "position", "velocity", "attitude", "rate", "joint", "joint_rate", "wheel"};
  return kNames[static_cast<std::size_t>(block)];
}

StepControl::StepControl(const StateLayout& layout, const BlockTolerances& tolerance,
                         std::vector<std::string> names)
    : chart_(layout.chart), names_(std::move(names)) {
  const auto range = [](Block block, int begin, int size, const Tolerance& allowed) {
    return Range{block, static_cast<std::size_t>(begin), static_cast<std::size_t>(size), allowed};
  };
  ranges_ = {range(Block::kPosition, layout.position(), 3, tolerance.position),
             range(Block::kVelocity, layout.velocity(), 3, tolerance.velocity),
             range(Block::kAttitude, layout.attitude(), layout.attitude_size(), tolerance.attitude),
             range(Block::kRate, layout.rate(), layout.rate_size(), tolerance.rate),
             range(Block::kJoint, layout.joint(), layout.joints, tolerance.joint),
             range(Block::kJointRate, layout.joint_rate(), layout.joints, tolerance.joint_rate),
             range(Block::kWheel, layout.wheel(), layout.wheels, tolerance.wheel)};
}

double StepControl::ratio(const Range& range, std::span<const double> state,
                          std::span<const double> error) const {
  if (range.size == 0) return 0.0;
  const Entries y = entries(state.subspan(range.begin, range.size));
  const Entries e = entries(error.subspan(range.begin, range.size));
  const bool is_attitude = range.block == Block::kAttitude;
  const double deviation = is_attitude ? attitude_error(chart_, y, e) : e.norm();
  if (deviation == 0.0) return 0.0;
  const double magnitude = is_attitude ? attitude_angle(chart_, y) : y.norm();
  return deviation / (range.tolerance.absolute + range.tolerance.relative * magnitude);
}

StepControl::Verdict StepControl::judge(std::span<const double> state,
                                        std::span<const double> error) const {
  Verdict worst;
  for (const Range& range : ranges_) {
    const double found = ratio(range, state, error);
    if (found <= worst.ratio) continue;
    worst = {std::isnan(found) ? kInfinity : found, range.block};
  }
  return worst;
}

StepControl::Verdict StepControl::judge_proposal(const RungeKutta& stepper) const {
  // An infinite state would make its own relative tolerance infinite.
  Verdict verdict = judge(stepper.proposal(), stepper.error());
  if (!stepper.proposal_is_finite()) verdict.ratio = kInfinity;
  return verdict;
}

void StepControl::add_accepted(const RungeKutta& stepper, AcceptedErrors& accepted) const {
  const Range& attitude = range_of(Block::kAttitude);
  const Range& joint = range_of(Block::kJoint);
  if (attitude.size > 0)
    accepted.attitude +=
        attitude_error(chart_, entries(stepper.proposal().subspan(attitude.begin, attitude.size)),
                       entries(stepper.error().subspan(attitude.begin, attitude.size)));
  accepted.joint.resize(joint.size);
  for (std::size_t i = 0; i < joint.size; ++i)
    accepted.joint[i] += std::abs(stepper.error()[joint.begin + i]);
}

double StepControl::advance(RungeKutta& stepper, double from, double to, StepCounts& counts,
                            const std::atomic<bool>* stop, AcceptedErrors* accepted) const {
  const double exponent = stepper.tableau().control_exponent();
  const double smallest = 16.0 * std::numeric_limits<double>::epsilon() * std::abs(to);
  double time = from;
  double h = to - from;
  while (time < to && !(stop != nullptr && *stop)) {
    // Reach the end exactly; a remainder below the smallest step is rounding, not a step.
    const bool reaches_end = h > to - time - smallest;
    if (reaches_end) h = to - time;
    stepper.attempt(time, h);
    counts.evaluations += stepper.tableau().stages;
    const Verdict verdict = judge_proposal(stepper);
    ++counts.driven_by[static_cast<std::size_t>(verdict.block)];
    const double next = h * step_factor(verdict.ratio, exponent);
    if (verdict.passes()) {
      if (accepted != nullptr) add_accepted(stepper, *accepted);
      stepper.accept();
      ++counts.accepted;
      time = reaches_end ? to : time + h;
    } else {
      ++counts.rejected;
      if (next < smallest) fail(stepper, time, verdict);
    }
    h = next;
  }
  return time;
}

void StepControl::fail(const RungeKutta& stepper, double time, const Verdict& verdict) const {
  if (!stepper.proposal_is_finite()) {
    const auto entry = static_cast<std::size_t>(stepper.first_non_finite());
    throw NumericalFailure(fmt::format("`{}` is not finite at t = {} s, however short the step",
                                       names_[entry], shortest(time)),
                           names_[entry]);
  }
  throw NumericalFailure(
      fmt::format("step underflow at t = {} s: no step meets the tolerance of "
                  "`{}`",
                  shortest(time), block_name(verdict.block)));
}

}  // namespace twincraft
