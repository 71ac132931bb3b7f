// Random states and the comparison, block by block. Everything is relative to what is physically
// comparable: a mass-matrix entry to its two diagonal entries, an acceleration to the largest of
// its block over all states, and never to less than the centrifugal terms of the states drawn.
// Tested by tests/runtime/proof_test.cpp.
#include "runtime/study/proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/bsm/engine.h"
#include "runtime/mujoco/engine.h"
#include "runtime/study/random_state.h"

namespace twincraft {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A block of the velocity coordinates (v_B, omega, joint rates, wheel rates).
struct AccelerationBlock {
  std::string what;
  std::vector<std::string> names;
  std::vector<int> entries;  // of the acceleration vector
  double floor = 0.0;        // smallest magnitude worth comparing with
};

/// One engine at one physical state.
struct Answer {
  MatrixXd mass_matrix;
  VectorXd acceleration;  // v_B in N, omega in B, joints, wheels
};

Answer ask(Engine& engine, const RandomState& state) {
  const StateLayout& layout = engine.layout();
  const VectorXd y = state_vector(state, layout);
  VectorXd rate(layout.size());
  const std::span<const double> view(y.data(), static_cast<std::size_t>(y.size()));
  engine.hold_inputs(state.time);
  engine.derivative(state.time, view, {rate.data(), view.size()});
  return {engine.mass_matrix(view), accelerations_of(rate, layout)};
}

/// NaN is worse than any number.
bool is_worse(double difference, double than) { return !(difference <= than); }

void keep_worst(ProofLine& line, double difference, const std::string& where) {
  if (std::isnan(line.difference) || !is_worse(difference, line.difference)) return;
  line.difference = difference;
  line.where = where;
}

/// Radius of gyration about B [m] from the hub blocks of a mass matrix.
double gyration(const MatrixXd& M) { return std::sqrt(M.block<3, 3>(3, 3).trace() / M(0, 0)); }

/// Mass, centre of mass and inertia are blocks of the mass matrix: m, -m [NB] tilde(c), I about B.
void compare_mass_properties(const Answer& a, const Answer& b, ProofReport& report) {
  const MatrixXd difference = a.mass_matrix - b.mass_matrix;
  const double mass = a.mass_matrix(0, 0);
  report.lines.push_back({"mass", std::abs(difference(0, 0)) / mass, {}});
  if (difference.rows() == 3) return;  // a point mass
  const double arm = gyration(a.mass_matrix);
  report.lines.push_back(
      {"centre of mass", difference.block<3, 3>(0, 3).cwiseAbs().maxCoeff() / (mass * arm), {}});
  report.lines.push_back(
      {"inertia", difference.block<3, 3>(3, 3).cwiseAbs().maxCoeff() / (mass * arm * arm), {}});
}

/// Both engines must show the very coordinates the state was made of, in the model's order.
double mapping_difference(Engine& engine, const RandomState& state) {
  const VectorXd y = state_vector(state, engine.layout());
  engine.hold_inputs(state.time);
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

/// MuJoCo forms m Omega^2 r^2 of a spinning wheel before it cancels; what rounding then leaves of
/// the wheel's acceleration is within the bound of this [rad/s^2]. Of the wheels drawn, 100 rad/s.
double spin_floor(const Model& model) {
  constexpr double kOmega2 = 1.0e4;  // [rad^2/s^2]
  double floor = 0.0;
  for (const TreeBody& wheel : model.tree.bodies) {
    if (wheel.link >= 0 || wheel.joints.empty()) continue;
    double arm = 0.0;  // [m] no more than this from the hub's origin, at zero coordinates
    for (const TreeBody* body = &wheel; body->parent >= 0;
         body = &model.tree.bodies[static_cast<std::size_t>(body->parent)])
      arm += body->pos.norm();
    const Vector3d& axis = wheel.joints.front().axis;
    const double torque = wheel.inertial.mass * kOmega2 * arm * arm;
    floor = std::max(floor, torque / axis.dot(wheel.inertial.I_PntC_L * axis));
  }
  return floor * std::numeric_limits<double>::epsilon() / kProofBound;
}

std::vector<AccelerationBlock> blocks_of(const Model& model, const MatrixXd& M) {
  if (model.simulation.translation) {
    // Nothing turns, so nothing cancels, and any acceleration is worth comparing with.
    constexpr double kAny = std::numeric_limits<double>::min();
    return {{"acceleration", {"x", "y", "z"}, {0, 1, 2}, kAny}};
  }
  const double arm = gyration(M);
  // Rates drawn are about 0.1 rad/s, so this is what turning alone makes of any coordinate.
  constexpr double kCentrifugal = 0.01;  // [rad/s^2]
  AccelerationBlock linear{
      "hub linear acceleration", {"x", "y", "z"}, {0, 1, 2}, kCentrifugal * arm};
  AccelerationBlock angular{"hub angular acceleration", {"x", "y", "z"}, {3, 4, 5}, kCentrifugal};
  AccelerationBlock hinges{"hinge accelerations", {}, {}, kCentrifugal};
  AccelerationBlock slides{"slide accelerations", {}, {}, kCentrifugal * arm};
  AccelerationBlock wheels{
      "wheel accelerations", {}, {}, std::max(kCentrifugal, spin_floor(model))};
  const auto& links = model.assembly.links;
  for (std::size_t i = 1; i < links.size(); ++i) {
    AccelerationBlock& block = links[i].joint.kind == JointKind::kSlide ? slides : hinges;
    block.names.push_back(links[i].name);
    block.entries.push_back(6 + static_cast<int>(i) - 1);
  }
  for (const Rotor& rotor : model.assembly.rotors) {
    wheels.entries.push_back(6 + static_cast<int>(links.size() - 1 + wheels.names.size()));
    wheels.names.push_back(rotor.name);
  }
  std::vector<AccelerationBlock> blocks{linear, angular, hinges, slides, wheels};
  std::erase_if(blocks, [](const AccelerationBlock& block) { return block.entries.empty(); });
  return blocks;
}

ProofLine compare_mass_matrices(const std::vector<Answer>& a, const std::vector<Answer>& b) {
  ProofLine line{"mass matrix", 0.0, {}};
  for (std::size_t state = 0; state < a.size(); ++state) {
    const VectorXd scale = a[state].mass_matrix.diagonal().cwiseSqrt().cwiseInverse();
    const MatrixXd difference = a[state].mass_matrix - b[state].mass_matrix;
    const MatrixXd relative = scale.asDiagonal() * difference * scale.asDiagonal();
    for (int column = 0; column < relative.cols(); ++column)
      for (int row = 0; row < relative.rows(); ++row)
        keep_worst(line, std::abs(relative(row, column)),
                   fmt::format("state {}, row {}, column {}", state + 1, row + 1, column + 1));
  }
  return line;
}

ProofLine compare_block(const AccelerationBlock& block, const std::vector<Answer>& a,
                        const std::vector<Answer>& b) {
  double scale = block.floor;
  for (const std::vector<Answer>* answers : {&a, &b})
    for (const Answer& answer : *answers)
      for (int entry : block.entries) scale = std::max(scale, std::abs(answer.acceleration[entry]));
  ProofLine line{block.what, 0.0, {}};
  for (std::size_t state = 0; state < a.size(); ++state)
    for (std::size_t i = 0; i < block.entries.size(); ++i) {
      const int entry = block.entries[i];
      const double difference =
          std::abs(a[state].acceleration[entry] - b[state].acceleration[entry]);
      keep_worst(line, difference / scale, fmt::format("state {}, {}", state + 1, block.names[i]));
    }
  return line;
}

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

ProofReport prove(const Model& model, Engine& a, Engine& b) {
  ProofReport report;
  report.remarks = deliberate_mismatches(model);
  if (!same_coordinates(model, a, b, report)) return report;
  const std::vector<RandomState> states = random_states(model, kProofStates);
  std::vector<Answer> of_a, of_b;
  for (const RandomState& state : states) {
    of_a.push_back(ask(a, state));
    of_b.push_back(ask(b, state));
  }
  report.lines.push_back(
      {"coordinate mapping",
       std::max(mapping_difference(a, states.front()), mapping_difference(b, states.front())),
       {}});
  const RandomState start = undisturbed(model);
  const Answer start_a = ask(a, start);
  compare_mass_properties(start_a, ask(b, start), report);
  report.lines.push_back(compare_mass_matrices(of_a, of_b));
  for (const AccelerationBlock& block : blocks_of(model, start_a.mass_matrix))
    report.lines.push_back(compare_block(block, of_a, of_b));
  return report;
}

ProofReport prove(const Bundle& bundle) {
  ProofReport report;
  report.refusal = bundle.model.mujoco_refusal;
  if (!report.refusal.empty()) return report;
  try {
    const std::unique_ptr<Engine> bsm = make_bsm_engine(bundle.model);
    const std::unique_ptr<Engine> mujoco = make_mujoco_engine(bundle.model, bundle.mjcf);
    return prove(bundle.model, *bsm, *mujoco);
  } catch (const NumericalFailure& failure) {
    report.refusal = failure.what();
    return report;
  }
}

std::string to_text(const ProofReport& report) {
  if (!report.refusal.empty()) return fmt::format("no proof: {}\n", report.refusal);
  std::string text = fmt::format("{:<26}{:>12}   worst at\n", "both halves", "difference");
  for (const ProofLine& line : report.lines)
    text += fmt::format("{:<26}{:>12.1e}   {:<32}{}\n", line.what, line.difference, line.where,
                        line.pass() ? "ok" : "DIFFERS");
  text += fmt::format("relative, {} random states, bound {:g}\n", kProofStates, kProofBound);
  for (const std::string& remark : report.remarks) text += fmt::format("remark: {}\n", remark);
  text += report.pass() ? "the two targets are one machine\n" : "the two targets differ\n";
  return text;
}

}  // namespace twincraft
