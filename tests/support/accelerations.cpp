// accelerations SPEC...: for each vehicle its MJCF, and the accelerations that the analytic engine
// finds at random states, as JSON. For tests/mujoco to hold against the MuJoCo that users have.
//
// An MJCF holds the machine of t = 0 and its motors. What else our engines add to it, gravity,
// loads and propellant on its way, is left out here; where the spec makes the MJCF another machine
// on purpose (token masses and inertias, drag of small angles), the analytic engine gets that one.
#include <iostream>
#include <nlohmann/json.hpp>

#include "runtime/bsm/engine.h"
#include "runtime/compare/acceleration_blocks.h"
#include "runtime/compare/proof.h"
#include "runtime/compare/random_state.h"
#include "runtime/compare/rounding.h"
#include "runtime/mujoco/engine.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

using Eigen::VectorXd;
using Json = nlohmann::json;

constexpr int kStates = 5;

template <class T>
auto& at(std::vector<T>& items, int index) {
  return items.at(static_cast<std::size_t>(index));
}

/// The machine that the MJCF is.
Model bare(Model model) {
  model.gravity = {};
  model.loads.clear();
  model.nozzles.clear();
  model.forces = {};
  for (Tank& tank : model.tanks) tank.mass_flow = {};
  for (Link& link : model.assembly.links) link.joint.damped_by_cosine_of = -1;
  for (const TreeBody& body : model.tree.bodies)
    if (body.token_inertia > 0.0)
      at(model.assembly.links, body.link).elements.at(0).I_PntE_L +=
          body.token_inertia * Matrix3d::Identity();
  const std::vector<Seat> seats = seats_of(model.tree);
  for (const TreeWheel& wheel : model.tree.wheels)
    for (const MassElement& token : at(model.tree.bodies, wheel.body).elements) {
      const Seat& seat = seats.at(static_cast<std::size_t>(wheel.body));
      at(model.assembly.links, seat.link).elements.push_back(seated(token, seat));
    }
  model.initial.r_BN_N.setZero();
  model.initial.v_BN_N.setZero();
  return model;
}

Json numbers(const VectorXd& v) { return std::vector<double>(v.begin(), v.end()); }

Json efforts(const Model& model, double time) {
  Json all = Json::object();
  for (const Link& link : model.assembly.links) all[link.name] = link.joint.effort.at(time);
  for (const Rotor& rotor : model.assembly.rotors) all[rotor.name] = rotor.torque.at(time);
  return all;
}

/// Acceleration and what rounding may do to it, in both engines together.
struct Answer {
  VectorXd acceleration, rounding;
};

Answer ask(Engine& bsm, Engine& mujoco, const RandomState& state, InputFeed& feed) {
  const VectorXd y = pack(state, bsm.layout()), z = pack(state, mujoco.layout());
  const std::span<const double> view(y.data(), static_cast<std::size_t>(y.size()));
  const std::span<const double> other(z.data(), static_cast<std::size_t>(z.size()));
  VectorXd rate(y.size());
  bsm.hold(feed.begin(state.time));
  mujoco.hold(feed.begin(state.time));
  bsm.derivative(state.time, view, {rate.data(), view.size()});
  Answer answer{accelerations_of(rate, bsm.layout()), {}};
  answer.rounding = VectorXd::Zero(answer.acceleration.size());
  const RoundingTerms terms = mujoco.rounding_terms(other);
  if (terms.force.size() > 0)
    answer.rounding += acceleration_rounding(terms, bsm.mass_matrix(view), answer.acceleration);
  return answer;
}

/// Of every entry, what makes a difference relative.
VectorXd scales_of(const std::vector<AccelerationBlock>& blocks, const std::vector<Answer>& all) {
  VectorXd scales(all.front().acceleration.size());
  for (const AccelerationBlock& block : blocks) {
    double scale = block.floor;
    for (const Answer& answer : all)
      scale = std::max(scale, answer.acceleration(block.entries).cwiseAbs().maxCoeff());
    scales(block.entries).setConstant(scale);
  }
  return scales;
}

Json vehicle(const std::string& spec) {
  const Bundle bundle = test::compiled({spec, {}});
  if (!bundle.model.mujoco_refusal.empty()) return nullptr;
  const Model model = bare(bundle.model);
  const auto bsm = make_bsm_engine(model);
  const auto mujoco = make_mujoco_engine(model, bundle.text(kMjcf));
  InputFeed feed(model);
  const std::vector<RandomState> states = random_states(model, kStates);
  std::vector<Answer> answers;
  for (const RandomState& state : states) answers.push_back(ask(*bsm, *mujoco, state, feed));
  const VectorXd y = pack(states.front(), bsm->layout());
  const VectorXd scales = scales_of(
      acceleration_blocks(model, bsm->mass_matrix({y.data(), static_cast<std::size_t>(y.size())})),
      answers);
  Json document{{"spec", spec},
                {"mjcf", bundle.text(kMjcf)},
                {"translation", model.simulation.translation},
                {"joints", Json::array()},
                {"wheels", Json::array()},
                {"scale", numbers(scales)},
                {"states", Json::array()}};
  for (std::size_t i = 1; i < model.assembly.links.size(); ++i)
    document["joints"].push_back(model.assembly.links[i].name);
  for (const Rotor& rotor : model.assembly.rotors) document["wheels"].push_back(rotor.name);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const RandomState& state = states[i];
    const Quaterniond& q = state.q_BN;
    document["states"].push_back({{"attitude", {q.w(), q.x(), q.y(), q.z()}},
                                  {"rate", numbers(state.omega_BN_B)},
                                  {"joint_position", state.joint_position},
                                  {"joint_rate", state.joint_rate},
                                  {"wheel_rate", state.wheel_rate},
                                  {"effort", efforts(model, state.time)},
                                  {"acceleration", numbers(answers[i].acceleration)},
                                  {"bound", numbers(kProofBound * scales + answers[i].rounding)}});
  }
  return document;
}

}  // namespace
}  // namespace twincraft

int main(int argc, char** argv) {
  nlohmann::json all = nlohmann::json::array();
  for (int i = 1; i < argc; ++i) {
    nlohmann::json one = twincraft::vehicle(argv[i]);
    if (!one.is_null()) all.push_back(std::move(one));
  }
  std::cout << all << "\n";
}
