// The parts of a vehicle as data of the script: Basilisk's state effectors on a Spacecraft. Tested
// by tests/compiler/basilisk_test.cpp, and flown by tests/basilisk.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "compiler/emit/basilisk_bsm_code.h"
#include "compiler/emit/basilisk_bsm_parts.h"
#include "compiler/emit/basilisk_half.h"
#include "compiler/emit/python_text.h"
#include "compiler/ir/vector_json.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

class BsmHalf {
 public:
  BsmHalf(const Model& model, const BsmParts& parts) : model_(model), parts_(parts) {}
  Half half();

 private:
  const Link& link(int index) const { return link_at(model_, index); }
  const Rotor& rotor(int index) const { return rotor_at(model_, index); }
  void use(const char* module) { half_.simulation.insert(module); }
  /// A table of the script, and a comment that says what is in it.
  void table(std::string_view comment, std::string_view name, const Json& value) {
    half_.tables += assignment(name, value, comment);
  }

  void write_hub();
  void write_wheels();
  void write_chains(JointKind kind);
  MassProperties body_of(const Chain& chain, int index) const;
  Json segments_of(const Chain& chain) const;
  void write_motors();
  void write_tanks();
  void write_particles();
  void write_pendulums();
  void write_loads();
  void write_gravity();
  void write_slosh_tanks();
  Json place_of(const Load& load) const;
  std::string tank_name(int index) const {
    return index < 0 ? "" : model_.tanks[static_cast<std::size_t>(index)].name;
  }

  const Model& model_;
  const BsmParts& parts_;
  Json rests_ = Json::object();
  Half half_;
};

void BsmHalf::write_hub() {
  const MassProperties hub = hub_of(model_);
  // A point mass is flown at its centre of mass.
  const bool is_point = model_.simulation.translation;
  table("with what is fixed on it: mass, centre, inertia about it [kg, m, kg m2]", "HUB",
        {hub.mass, vector_json(is_point ? Vector3d::Zero().eval() : hub.r_CL_L),
         matrix_json(hub.I_PntC_L)});
  if (is_point) table("of mass of the hub, from B [m]", "CENTER", vector_json(hub.r_CL_L));
}

void BsmHalf::write_wheels() {
  Json wheels = Json::object();
  for (const Rotor& rotor : model_.assembly.rotors)
    if (rotor.link == 0) wheels[rotor.name] = {vector_json(rotor.axis_L), rotor.spin_inertia};
  if (wheels.empty()) return;
  use("reactionWheelStateEffector");
  table("gsHat_B, Js [kg m2]", "WHEELS", wheels);
}

/// What Basilisk's last body gets of a wheel: a tensor that is round about its axis, so that its
/// turning shows nowhere else.
Matrix3d round_tensor(const Rotor& wheel) {
  const Matrix3d along = wheel.axis_L * wheel.axis_L.transpose();
  return 0.5 * wheel.spin_inertia * (Matrix3d::Identity() + along);
}

MassProperties BsmHalf::body_of(const Chain& chain, int index) const {
  MassProperties body;
  for (const MassElement& element : link(index).elements) body = body + properties_of(element);
  if (chain.wheel && index == chain.links.back()) {
    body.mass -= kTokenMass;
    body.I_PntC_L -= round_tensor(rotor(*chain.wheel));
  }
  return body;
}

Json segment(const Joint& joint, const MassProperties& body) {
  const Matrix3d dcm_L0P = joint.dcm_PL0.transpose();
  if (joint.kind == JointKind::kHinge)
    return {{"Mass", body.mass},
            {"R_SP_P", vector_json(joint.r_HP_P)},
            {"DCM_S0P", matrix_json(dcm_L0P)},
            {"SHat_S", vector_json(joint.axis_L)},
            {"R_ScS_S", vector_json(body.r_CL_L)},
            {"ISPntSc_S", matrix_json(body.I_PntC_L)},
            {"K", joint.stiffness},
            {"C", joint.damping}};
  return {{"Mass", body.mass},
          {"R_F0P_P", vector_json(joint.r_HP_P)},
          {"DCM_FP", matrix_json(dcm_L0P)},
          {"FHat_P", vector_json(joint.dcm_PL0 * joint.axis_L)},
          {"R_FcF_F", vector_json(body.r_CL_L)},
          {"IPntFc_F", matrix_json(body.I_PntC_L)},
          {"K", joint.stiffness},
          {"C", joint.damping}};
}

Json BsmHalf::segments_of(const Chain& chain) const {
  Json segments = Json::object();
  MassProperties body;
  for (const int index : chain.links) {
    body = body_of(chain, index);
    segments[link(index).name] = segment(link(index).joint, body);
  }
  if (!chain.wheel) return segments;
  const Rotor& wheel = rotor(*chain.wheel);
  segments[wheel.name] = {{"Mass", kTokenMass},
                          {"R_SP_P", vector_json(body.r_CL_L)},
                          {"SHat_S", vector_json(wheel.axis_L)},
                          {"ISPntSc_S", matrix_json(round_tensor(wheel))}};
  return segments;
}

void BsmHalf::write_chains(JointKind kind) {
  Json chains = Json::object();
  Json rests = Json::object();
  for (const Chain& chain : parts_.chains) {
    if (link(chain.links.front()).joint.kind != kind) continue;
    chains[chain.name] = segments_of(chain);
    for (const int each : chain.links)
      if (link(each).joint.rest != 0.0) rests[link(each).name] = link(each).joint.rest;
  }
  if (chains.empty()) return;
  const bool turns = kind == JointKind::kHinge;
  use(turns ? "spinningBodyNDOFStateEffector" : "linearTranslationNDOFStateEffector");
  table(
      turns
          ? "chains from the hub out, by SpinningBody's setters [kg, m, kg m2, N m/rad, N m s/rad]"
          : "chains from the hub out, by TranslatingBody's setters [kg, m, kg m2, N/m, N s/m]",
      turns ? "HINGES" : "SLIDES", chains);
  rests_.update(rests);
}

/// Where springs rest, and which chains have motors: Basilisk's message holds no more than 36.
void BsmHalf::write_motors() {
  Json driven = Json::array();
  for (const Chain& chain : parts_.chains)
    if (has_motor(model_, chain)) driven.push_back(chain.name);
  if (!rests_.empty()) table("of springs [rad, m]", "RESTS", rests_);
  if (!driven.empty()) table("chains with motors", "DRIVEN", driven);
}

/// A solid cylinder with the inertia per mass of `k` [m^2], which is round about an axis; without a
/// length it is a sphere.
Json solid_of(const Matrix3d& k) {
  const PrincipalInertia principal = principal_inertia(k);
  const Vector3d& m = principal.moments;
  int axis = 0;  // the moment that is farthest from the other two
  for (int i = 1; i < 3; ++i)
    if (std::abs(m[(i + 1) % 3] - m[(i + 2) % 3]) < std::abs(m[(axis + 1) % 3] - m[(axis + 2) % 3]))
      axis = i;
  const double along = m[axis], across = m[(axis + 1) % 3];
  if (std::abs(along - across) <= 1.0e-14 * across) return {{"radius", std::sqrt(2.5 * along)}};
  const Matrix3d R = principal.axes.toRotationMatrix();
  Matrix3d dcm_TB;  // the axis is its third row
  dcm_TB << R.col((axis + 1) % 3).transpose(), R.col((axis + 2) % 3).transpose(),
      R.col(axis).transpose();
  return {{"radius", std::sqrt(2.0 * along)},
          {"length", std::sqrt(12.0 * (across - 0.5 * along))},
          {"dcm_TB", matrix_json(dcm_TB)}};
}

void BsmHalf::write_tanks() {
  if (model_.tanks.empty()) return;
  use("fuelTank");
  Json tanks = Json::object();
  for (const Tank& tank : model_.tanks)
    tanks[tank.name] = {{"mass", 0.0}, {"r_TB_B", {0.0, 0.0, 0.0}}, {"radius", 1.0}};
  for (const MassElement& bulk : link(0).elements) {
    if (bulk.tank < 0) continue;
    Json& tank = tanks[tank_name(bulk.tank)];
    tank = {{"mass", bulk.mass}, {"r_TB_B", vector_json(bulk.r_EL_L)}};
    tank.update(solid_of(bulk.I_PntE_L / bulk.mass));
  }
  table("what does not slosh: spheres, and cylinders about the third row of dcm_TB [kg, m]",
        "TANKS", tanks);
}

void BsmHalf::write_particles() {
  if (parts_.particles.empty()) return;
  use("linearSpringMassDamper");
  Json all = Json::object();
  for (const int index : parts_.particles) {
    const Joint& joint = link(index).joint;
    const MassElement& element = link(index).elements.front();
    all[link(index).name] = {{"massInit", element.mass},
                             {"r_PB_B", vector_json(joint.r_HP_P + joint.dcm_PL0 * element.r_EL_L)},
                             {"pHat_B", vector_json(joint.dcm_PL0 * joint.axis_L)},
                             {"k", joint.stiffness},
                             {"c", joint.damping}};
  }
  table("on springs [kg, m, N/m, N s/m]", "PARTICLES", all);
}

void BsmHalf::write_pendulums() {
  if (parts_.pendulums.empty()) return;
  use("sphericalPendulum");
  Json all = Json::object();
  for (const int index : parts_.pendulums) {
    const Joint& phi = link(index).joint;
    const MassElement& bob = link(phi.damped_by_cosine_of).elements.front();
    const double length = bob.r_EL_L.norm();
    const double drag = phi.damping / (length * length);
    all[component_of(link(index))] = {{"massInit", bob.mass},
                                      {"pendulumRadius", length},
                                      {"d", vector_json(phi.r_HP_P)},
                                      {"pHat_01", vector_json(phi.dcm_PL0.col(0))},
                                      {"pHat_02", vector_json(phi.dcm_PL0.col(1))},
                                      {"pHat_03", vector_json(phi.dcm_PL0.col(2))},
                                      {"D", matrix_json(drag * Matrix3d::Identity())}};
  }
  table("pivot d; rest, reference and normal pHat [kg, m, N s/m]", "PENDULUMS", all);
}

/// Which chain a load is on and where in it, counted from 1 as Basilisk does.
Json BsmHalf::place_of(const Load& load) const {
  for (const Chain& chain : parts_.chains) {
    const auto found = std::ranges::find(chain.links, load.link);
    if (found != chain.links.end()) return {chain.name, found - chain.links.begin() + 1};
  }
  return Json::array();
}

void BsmHalf::write_slosh_tanks() {
  Json tanks = Json::object();
  for (int i = 1; i < static_cast<int>(model_.assembly.links.size()); ++i)
    for (const MassElement& element : link(i).elements)
      if (element.tank >= 0) tanks[component_of(link(i))] = tank_name(element.tank);
  if (!parts_.particles.empty() || !parts_.pendulums.empty())
    table("what sloshes: the tank it drains with", "TANK_OF", tanks);
}

void BsmHalf::write_loads() {
  if (model_.loads.empty()) return;
  use("extForceTorque");
  const MassProperties hub = hub_of(model_);
  Json loads = Json::object();
  for (const Load& load : model_.loads)
    loads[load.name] = {{"on", place_of(load)},
                        {"at", vector_json(load.r_FL_L.value_or(hub.r_CL_L))}};
  table("loads and thrusters: body of a chain (none: hub), in whose axes they act, and where [m]",
        "LOADS", loads);
}

void BsmHalf::write_gravity() {
  if (model_.gravity.bsm == GravityLaw::kNone) return;
  use("gravityEffector");
  if (model_.gravity.bsm == GravityLaw::kBodyGradient) use("GravityGradientEffector");
}

/// @pre nothing is refused
Half BsmHalf::half() {
  use("spacecraft");
  write_hub();
  write_wheels();
  write_chains(JointKind::kHinge);
  write_chains(JointKind::kSlide);
  write_motors();
  write_tanks();
  write_particles();
  write_pendulums();
  write_slosh_tanks();
  write_loads();
  write_gravity();
  const auto has = [this](std::string_view table) {
    return half_.tables.find(fmt::format("\n{} = ", table)) != std::string::npos;
  };
  const bool wheel_motors = std::ranges::any_of(model_.assembly.rotors, [](const Rotor& rotor) {
    return rotor.link == 0 && !rotor.torque.is_zero();
  });
  half_.code = bsm_code({.is_point = model_.simulation.translation,
                         .wheels = has("WHEELS"),
                         .wheel_motors = wheel_motors,
                         .hinges = has("HINGES"),
                         .slides = has("SLIDES"),
                         .rests = has("RESTS"),
                         .chain_motors = has("DRIVEN"),
                         .tanks = has("TANKS"),
                         .particles = has("PARTICLES"),
                         .pendulums = has("PENDULUMS"),
                         .loads = has("LOADS"),
                         .gravity = model_.gravity.bsm});
  return std::move(half_);
}

}  // namespace

MassProperties hub_of(const Model& model) {
  MassProperties hub;
  for (const MassElement& element : model.assembly.links.front().elements)
    if (element.tank < 0) hub = hub + properties_of(element);
  return hub;
}

Half bsm_half(const Model& model) {
  BsmParts parts = bsm_parts(model);
  Half half;
  if (parts.refusals.empty()) half = BsmHalf(model, parts).half();
  half.refusals = std::move(parts.refusals);
  half.notes = std::move(parts.notes);
  return half;
}

}  // namespace twincraft
