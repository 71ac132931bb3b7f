// Random states and the comparison, block by block. Everything is relative to what is physically
// comparable: a mass-matrix entry to its two diagonal entries, an acceleration to the largest of
// its block over all states, and never to less than the centrifugal terms of the states drawn. To
// the bound comes what rounding of an engine's larger terms may do at that very state.
// Tested by tests/runtime/proof_test.cpp.
#include "runtime/compare/proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "runtime/compare/acceleration_blocks.h"
#include "runtime/compare/held_comparison.h"
#include "runtime/compare/random_state.h"
#include "runtime/compare/rounding.h"
#include "runtime/simulate/engines.h"

namespace twincraft {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// One engine at one physical state.
struct Answer {
  MatrixXd mass_matrix;
  VectorXd acceleration;  // v_B in N, omega in B, joints, wheels
  RoundingTerms terms;
};

Answer ask(Engine& engine, const RandomState& state, InputFeed& feed) {
  const StateLayout& layout = engine.layout();
  const VectorXd y = pack(state, layout);
  VectorXd rate(layout.size());
  const std::span<const double> view(y.data(), static_cast<std::size_t>(y.size()));
  engine.hold(feed.begin(state.time));
  engine.derivative(state.time, view, {rate.data(), view.size()});
  return {engine.mass_matrix(view), accelerations_of(rate, layout), engine.rounding_terms(view)};
}

/// What rounding may do to both together; zeros where no term is larger than its sum.
MatrixXd mass_allowance(const Answer& a, const Answer& b) {
  MatrixXd allowed = MatrixXd::Zero(a.mass_matrix.rows(), a.mass_matrix.cols());
  for (const Answer* answer : {&a, &b})
    if (answer->terms.mass.size() > 0) allowed += mass_rounding(answer->terms);
  return allowed;
}

/// With the mass matrix of `a`, whose terms are the smaller.
VectorXd acceleration_allowance(const Answer& a, const Answer& b) {
  VectorXd allowed = VectorXd::Zero(a.acceleration.size());
  for (const Answer* answer : {&a, &b})
    if (answer->terms.force.size() > 0)
      allowed += acceleration_rounding(answer->terms, a.mass_matrix, a.acceleration);
  return allowed;
}

/// NaN is worse than any number.
bool is_worse(double difference, double than) { return !(difference <= than); }

/// The worst is the one that is nearest to its bound, or farthest beyond.
void keep_worst(ProofLine& line, double difference, double bound, const std::string& where) {
  if (std::isnan(line.difference) || !is_worse(difference / bound, line.difference / line.bound))
    return;
  line.difference = difference;
  line.bound = bound;
  line.where = where;
}

/// Mass, centre of mass and inertia are blocks of the mass matrix: m, -m [NB] tilde(c), I about B.
void compare_mass_properties(const Answer& a, const Answer& b, ProofReport& report) {
  const MatrixXd difference = a.mass_matrix - b.mass_matrix;
  const MatrixXd allowed = mass_allowance(a, b);
  const double mass = a.mass_matrix(0, 0);
  const auto add = [&](const char* what, int row, int column, int size, double scale) {
    ProofLine line{
        what, difference.block(row, column, size, size).cwiseAbs().maxCoeff() / scale, {}};
    line.bound += allowed.block(row, column, size, size).maxCoeff() / scale;
    report.lines.push_back(line);
  };
  add("mass", 0, 0, 1, mass);
  if (difference.rows() == 3) return;  // a point mass
  const double arm = gyration_radius(a.mass_matrix);
  add("centre of mass", 0, 3, 3, mass * arm);
  add("inertia", 3, 3, 3, mass * arm * arm);
}

/// Both engines must show the very coordinates the state was made of, in the model's order.
double mapping_difference(Engine& engine, const RandomState& state, InputFeed& feed) {
  const VectorXd y = pack(state, engine.layout());
  engine.hold(feed.begin(state.time));
  const Observation seen =
      engine.observe(state.time, {y.data(), static_cast<std::size_t>(y.size())});
  double worst = 0.0;
  const auto compare = [&worst](const std::vector<double>& shown, const std::vector<double>& set) {
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double difference = std::abs(shown[i] - set[i]) / std::max(1.0, std::abs(set[i]));
      if (is_worse(difference, worst)) worst = difference;
    }
  };
  compare(seen.joint_position, state.joint_position);
  compare(seen.joint_rate, state.joint_rate);
  compare(seen.wheel_rate, state.wheel_rate);
  return worst;
}

bool same_coordinates(const Model& model, Engine& a, Engine& b, ProofReport& report) {
  const auto freedom = [](const Engine& engine) { return engine.layout().degrees_of_freedom(); };
  const bool same = freedom(a) == model.degrees_of_freedom() && freedom(b) == freedom(a) &&
                    a.layout().joints == b.layout().joints;
  report.lines.push_back(
      {"coordinate count", same ? 0.0 : 1.0, fmt::format("{} and {}", freedom(a), freedom(b))});
  return same;
}

void compare_mass_matrices(const Answer& a, const Answer& b, std::size_t state, ProofLine& line) {
  const VectorXd scale = a.mass_matrix.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd difference = a.mass_matrix - b.mass_matrix;
  const MatrixXd relative = scale.asDiagonal() * difference * scale.asDiagonal();
  const MatrixXd allowed = scale.asDiagonal() * mass_allowance(a, b) * scale.asDiagonal();
  for (int column = 0; column < relative.cols(); ++column)
    for (int row = 0; row < relative.rows(); ++row)
      keep_worst(line, std::abs(relative(row, column)), kProofBound + allowed(row, column),
                 fmt::format("state {}, row {}, column {}", state + 1, row + 1, column + 1));
}

/// Both engines at the states of the proof. Only accelerations are kept of all of them; what
/// rounding may do to them is found again for the states that need it.
class StateComparison {
 public:
  StateComparison(Engine& a, Engine& b, InputFeed& feed, std::vector<RandomState> states,
                  const ProofProgress& progress)
      : a_(a), b_(b), feed_(feed), states_(std::move(states)), allowances_(states_.size()) {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (progress) progress(static_cast<double>(i) / static_cast<double>(states_.size()));
      const Answer of_a = ask(a_, states_[i], feed_), of_b = ask(b_, states_[i], feed_);
      compare_mass_matrices(of_a, of_b, i, mass_matrix_);
      accelerations_.push_back({of_a.acceleration, of_b.acceleration});
    }
  }

  const ProofLine& mass_matrix() const { return mass_matrix_; }

  ProofLine compare(const AccelerationBlock& block) {
    double scale = block.floor;
    for (const auto& pair : accelerations_)
      for (const VectorXd& acceleration : pair)
        scale = std::max(scale, acceleration(block.entries).cwiseAbs().maxCoeff());
    ProofLine line{block.what, 0.0, {}};
    for (std::size_t state = 0; state < states_.size(); ++state) {
      const auto& [of_a, of_b] = accelerations_[state];
      const VectorXd off = (of_a - of_b)(block.entries).cwiseAbs() / scale;
      VectorXd bound = VectorXd::Constant(off.size(), kProofBound);
      if (!(off.maxCoeff() <= kProofBound)) bound += allowance(state)(block.entries) / scale;
      for (std::size_t i = 0; i < block.names.size(); ++i) {
        const auto entry = static_cast<Eigen::Index>(i);
        keep_worst(line, off[entry], bound[entry],
                   fmt::format("state {}, {}", state + 1, block.names[i]));
      }
    }
    return line;
  }

 private:
  const VectorXd& allowance(std::size_t state) {
    VectorXd& known = allowances_[state];
    if (known.size() == 0)
      known =
          acceleration_allowance(ask(a_, states_[state], feed_), ask(b_, states_[state], feed_));
    return known;
  }

  Engine& a_;
  Engine& b_;
  InputFeed& feed_;
  std::vector<RandomState> states_;
  std::vector<std::array<VectorXd, 2>> accelerations_;
  std::vector<VectorXd> allowances_;  // empty: not asked for
  ProofLine mass_matrix_{"mass matrix", 0.0, {}};
};

std::vector<std::string> deliberate_mismatches(const Model& model) {
  std::vector<std::string> remarks;
  if (!model.engines.compensate && !model.assembly.rotors.empty())
    remarks.push_back(
        "`engines.mujoco.compensate: false` leaves the token wheel masses on top of the tree");
  if (std::ranges::any_of(model.tree.bodies,
                          [](const TreeBody& body) { return body.token_inertia > 0.0; }))
    remarks.push_back(
        "`engines.mujoco.bob_inertia` or `particle_inertia` gives the tree inertias that the "
        "assembly does not have");
  if (model.gravity.bsm != model.gravity.mujoco)
    remarks.push_back("the spec gives the two engines different gravity laws");
  return remarks;
}

}  // namespace

bool ProofReport::pass() const {
  return refusal.empty() && !lines.empty() &&
         std::all_of(lines.begin(), lines.end(), [](const ProofLine& line) { return line.pass(); });
}

ProofReport prove(const Model& model, Engine& a, Engine& b, const ProofProgress& progress) {
  ProofReport report;
  report.remarks = deliberate_mismatches(model);
  if (!same_coordinates(model, a, b, report)) return report;
  InputFeed feed(model);
  a.hold(feed.begin(0.0));
  b.hold(feed.begin(0.0));
  for (ProofLine& line : compare_held(model.assembly, a.held(), b.held()))
    report.lines.push_back(std::move(line));
  std::vector<RandomState> states = random_states(model, kProofStates);
  report.lines.push_back({"coordinate mapping",
                          std::max(mapping_difference(a, states.front(), feed),
                                   mapping_difference(b, states.front(), feed)),
                          {}});
  const RandomState start = undisturbed(model);
  const Answer start_a = ask(a, start, feed);
  compare_mass_properties(start_a, ask(b, start, feed), report);
  StateComparison comparison(a, b, feed, std::move(states), progress);
  report.lines.push_back(comparison.mass_matrix());
  for (const AccelerationBlock& block : acceleration_blocks(model, start_a.mass_matrix))
    report.lines.push_back(comparison.compare(block));
  return report;
}

ProofReport prove(const Bundle& bundle, const ProofProgress& progress) {
  ProofReport report;
  report.refusal = bundle.model.mujoco_refusal;
  if (!report.refusal.empty()) return report;
  try {
    const std::unique_ptr<Engine> bsm = make_engine(EngineKind::kBsm, bundle);
    const std::unique_ptr<Engine> mujoco = make_engine(EngineKind::kMujoco, bundle);
    return prove(bundle.model, *bsm, *mujoco, progress);
  } catch (const NumericalFailure& failure) {
    report.refusal = failure.what();
    return report;
  }
}

std::string to_text(const ProofReport& report) {
  if (!report.refusal.empty()) return fmt::format("no proof: {}\n", report.refusal);
  std::string text = fmt::format("{:<26}{:>12}   worst at\n", "both halves", "difference");
  bool raised = false;
  for (const ProofLine& line : report.lines) {
    const bool is_raised = line.bound > 2.0 * kProofBound;
    raised = raised || is_raised;
    text += fmt::format("{:<26}{:>12.1e}   {:<32}{}{}\n", line.what, line.difference, line.where,
                        line.pass() ? "ok" : "DIFFERS",
                        is_raised ? fmt::format(", bound {:.1e}", line.bound) : std::string());
  }
  text += fmt::format("relative, {} random states, bound {:g}\n", kProofStates, kProofBound);
  if (raised)
    text +=
        "a bound of its own: MuJoCo refers all inertias to the vehicle's centre of mass. A body "
        "of\n"
        "mass m at a distance r from it is rounded in proportion to m r^2, not to its own "
        "inertia.\n"
        "The bound adds that rounding, from the sizes of the terms that MuJoCo sums at this "
        "state.\n";
  for (const std::string& remark : report.remarks) text += fmt::format("remark: {}\n", remark);
  text += report.pass() ? "the two targets are one machine\n" : "the two targets differ\n";
  return text;
}

}  // namespace twincraft
