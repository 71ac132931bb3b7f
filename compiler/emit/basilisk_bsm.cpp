// The assembly in Basilisk's state effectors. They attach to the hub alone, so what can be written
// is a hub with wheels, tanks and slosh, and unbranched chains of hinges or of slides on it; the
// last hinge of a chain may be a wheel. Tested by tests/compiler/basilisk_test.cpp, and flown by
// tests/basilisk.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "compiler/emit/basilisk_bsm_code.h"
#include "compiler/emit/basilisk_half.h"
#include "compiler/emit/python_text.h"
#include "compiler/ir/vector_json.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

// Of what one of Basilisk's messages for motors holds.
constexpr int kMotors = 36;
// A wheel at the end of a chain is a body of its own there, with this mass [kg] of its mount's.
constexpr double kTokenMass = 1.0e-6;
// Basilisk's pendulum takes another chart of angles there.
constexpr double kPendulumChart = 0.78;  // [rad]

std::string component_of(const std::string& link) { return link.substr(0, link.find('.')); }

/// Links that follow one another, from the hub out.
struct Chain {
  std::string name;
  std::vector<int> links;
  std::optional<int> wheel = {};  // Assembly::rotors entry that is its last hinge
};

class BsmHalf {
 public:
  explicit BsmHalf(const Model& model);
  Half half();

 private:
  const Link& link(int index) const {
    return model_.assembly.links[static_cast<std::size_t>(index)];
  }
  const std::vector<int>& children(int index) const {
    return children_[static_cast<std::size_t>(index)];
  }
  bool has_motor(const Chain& chain) const {
    return std::ranges::any_of(chain.links,
                               [this](int i) { return !link(i).joint.effort.is_zero(); }) ||
           (chain.wheel && !rotor(*chain.wheel).torque.is_zero());
  }
  const Rotor& rotor(int index) const {
    return model_.assembly.rotors[static_cast<std::size_t>(index)];
  }
  Coordinate::Kind kind(int index) const { return kinds_[static_cast<std::size_t>(index)]; }
  bool is_slosh(int index) const {
    return kind(index) == Coordinate::Kind::kParticle || kind(index) == Coordinate::Kind::kPendulum;
  }
  void refuse(const std::string& component, std::string why) {
    half_.refusals.push_back({component, std::move(why)});
  }
  void note(const std::string& component, std::string what) {
    half_.notes.push_back({component, std::move(what)});
  }
  void use(const char* module) { half_.simulation.insert(module); }
  /// A table of the script, and a comment that says what is in it.
  void table(std::string_view comment, std::string_view name, const Json& value) {
    half_.tables += assignment(name, value, comment);
  }

  void find_branches();
  void follow(int first);
  void find_wheels();
  void find_wheel(int index);
  void check_motors();
  void check_slosh(int index);
  void check_tanks();
  void check_attitude();
  void check_loads();
  void check_gravity();
  void check_pendulums();

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
  std::vector<std::vector<int>> children_;
  std::vector<Coordinate::Kind> kinds_;
  std::vector<Chain> chains_;
  std::vector<int> particles_, pendulums_;  // links; of a pendulum the first
  Json rests_ = Json::object();
  Half half_;
};

BsmHalf::BsmHalf(const Model& model)
    : model_(model),
      children_(model.assembly.links.size()),
      kinds_(model.assembly.links.size(), Coordinate::Kind::kBodyAngle) {
  for (int i = 1; i < static_cast<int>(children_.size()); ++i)
    children_[static_cast<std::size_t>(link(i).parent)].push_back(i);
  for (const Coordinate& each : model.coordinates)
    if (!each.is_wheel()) kinds_[static_cast<std::size_t>(each.index)] = each.kind;
}

// What can be flown ------------------------------------------------------------------------------

void BsmHalf::find_branches() {
  for (int i = 1; i < static_cast<int>(children_.size()); ++i)
    if (is_slosh(i)) check_slosh(i);
  for (const int first : children(0))
    if (!is_slosh(first)) follow(first);
}

void BsmHalf::check_slosh(int index) {
  const bool is_pendulum = kind(index) == Coordinate::Kind::kPendulum;
  if (is_pendulum && link(index).joint.damped_by_cosine_of < 0) return;  // its second angle
  if (link(index).parent != 0) {
    const std::string& mount = link(link(index).parent).name;
    return refuse(component_of(link(index).name),
                  fmt::format("it moves on `{}`, and Basilisk's slosh is on the hub", mount));
  }
  (is_pendulum ? pendulums_ : particles_).push_back(index);
}

void BsmHalf::follow(int first) {
  Chain chain{component_of(link(first).name), {}};
  for (int at = first;;) {
    chain.links.push_back(at);
    std::vector<int> next;
    std::ranges::copy_if(children(at), std::back_inserter(next),
                         [this](int i) { return !is_slosh(i); });
    if (next.size() > 1) {
      std::vector<std::string> names;
      for (const int each : next) names.push_back(link(each).name);
      refuse(component_of(link(at).name),
             fmt::format("{} branch off it, and Basilisk's effectors are chains on the hub",
                         enumeration(names)));
      for (const int each : next) follow(each);  // for what is to be said of these
      return;
    }
    if (next.empty()) break;
    if (link(next.front()).joint.kind != link(at).joint.kind) {
      const bool turns = link(at).joint.kind == JointKind::kHinge;
      refuse(component_of(link(next.front()).name),
             fmt::format("it {} on `{}`, which {}: a chain of Basilisk's has joints of one kind",
                         turns ? "slides" : "turns", link(at).name, turns ? "turns" : "slides"));
    }
    at = next.front();
  }
  chains_.push_back(std::move(chain));
}

void BsmHalf::find_wheels() {
  for (int i = 0; i < static_cast<int>(model_.assembly.rotors.size()); ++i)
    if (rotor(i).link != 0) find_wheel(i);
}

/// Which chain ends in a wheel that is not on the hub.
void BsmHalf::find_wheel(int index) {
  const Rotor& wheel = rotor(index);
  const std::string& mount = link(wheel.link).name;
  const auto chain = std::ranges::find_if(
      chains_, [&wheel](const Chain& each) { return each.links.back() == wheel.link; });
  if (chain == chains_.end() || !children(wheel.link).empty())
    return refuse(wheel.name, fmt::format("its mount `{}` carries more than the wheel, and only "
                                          "the last body of a chain of Basilisk's can be a wheel",
                                          mount));
  if (chain->wheel)
    return refuse(wheel.name, fmt::format("`{}` carries another wheel, and a chain of Basilisk's "
                                          "ends in one",
                                          mount));
  if (link(wheel.link).joint.kind == JointKind::kSlide)
    return refuse(wheel.name, fmt::format("its mount `{}` slides, and a chain of Basilisk's has "
                                          "joints of one kind",
                                          mount));
  chain->wheel = index;
  note(wheel.name, fmt::format("it is the last body of the chain `{}`, with {:g} kg of `{}`",
                               chain->name, kTokenMass, mount));
}

void BsmHalf::check_motors() {
  const auto on_hub = std::ranges::count(model_.assembly.rotors, 0, &Rotor::link);
  if (on_hub > kMotors)
    refuse("", fmt::format("{} wheels are on the hub, and Basilisk takes {}", on_hub, kMotors));
  for (const Chain& chain : chains_) {
    const int joints = static_cast<int>(chain.links.size()) + (chain.wheel ? 1 : 0);
    if (has_motor(chain) && joints > kMotors)
      refuse(chain.name, fmt::format("its chain has a motor and {} joints, and Basilisk's message "
                                     "for motors holds {}",
                                     joints, kMotors));
  }
}

void BsmHalf::check_tanks() {
  for (int i = 1; i < static_cast<int>(children_.size()); ++i)
    for (const MassElement& element : link(i).elements)
      if (element.tank >= 0 && !is_slosh(i))
        refuse(element.name, fmt::format("it moves with `{}`, and Basilisk's tanks are on the hub",
                                         link(i).name));
  for (const Tank& tank : model_.tanks)
    if (tank.momentum == LeavingMomentum::kJet && !tank.mass_flow.is_zero())
      refuse(tank.name, "its jet takes momentum along by another law than Basilisk's");
}

void BsmHalf::check_pendulums() {
  for (const int first : pendulums_) {
    const int second = link(first).joint.damped_by_cosine_of;
    const std::string name = component_of(link(first).name);
    if (!link(second).elements.front().I_PntE_L.isZero(0.0))
      refuse(name, "its bob has an inertia, and Basilisk's is a point");
    const double theta = model_.initial.joint_position[static_cast<std::size_t>(second - 1)];
    if (std::abs(theta) > kPendulumChart)
      refuse(name, "its second angle is beyond 45 deg, where Basilisk's pendulum changes its axes");
    note(name,
         "beyond 45 deg of its second angle Basilisk's pendulum changes its axes, and the "
         "angles written are those about the new ones");
  }
}

void BsmHalf::check_attitude() {
  if (model_.engines.attitude == AttitudeChart::kQuaternion && !model_.simulation.translation)
    note("", "the attitude is in MRPs, and in quaternions in the analytic engine of the spec");
}

void BsmHalf::check_loads() {
  const bool is_rigid = model_.assembly.links.size() == 1 && model_.tanks.empty();
  if (is_rigid) return;
  for (const Load& load : model_.loads)
    if (!load.r_FL_L)
      refuse(load.name, "it acts at the centre of mass, which moves in this vehicle");
}

void BsmHalf::check_gravity() {
  std::size_t elements = 0;
  for (const Link& each : model_.assembly.links) elements += each.elements.size();
  const GravityLaw law = model_.gravity.bsm;
  if (law == GravityLaw::kBodyGradient && (model_.assembly.links.size() > 1 || elements > 1))
    refuse("",
           "its parts feel the gradient of gravity each by itself (`body_gradient`), and "
           "Basilisk knows that of one rigid body");
  if (law == GravityLaw::kBodyCom && elements > 1)
    note("",
         "gravity pulls at the centre of mass (`system_com`) in Basilisk, and at every part "
         "in the spec (`body_com`): a long vehicle turns by degrees in an orbit");
}

// What it is written as --------------------------------------------------------------------------

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
  for (const Chain& chain : chains_) {
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
  for (const Chain& chain : chains_)
    if (has_motor(chain)) driven.push_back(chain.name);
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
  if (particles_.empty()) return;
  use("linearSpringMassDamper");
  Json all = Json::object();
  for (const int index : particles_) {
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
  if (pendulums_.empty()) return;
  use("sphericalPendulum");
  Json all = Json::object();
  for (const int index : pendulums_) {
    const Joint& phi = link(index).joint;
    const MassElement& bob = link(phi.damped_by_cosine_of).elements.front();
    const double length = bob.r_EL_L.norm();
    const double drag = phi.damping / (length * length);
    all[component_of(link(index).name)] = {{"massInit", bob.mass},
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
  for (const Chain& chain : chains_) {
    const auto found = std::ranges::find(chain.links, load.link);
    if (found != chain.links.end()) return {chain.name, found - chain.links.begin() + 1};
  }
  return Json::array();
}

void BsmHalf::write_slosh_tanks() {
  Json tanks = Json::object();
  for (int i = 1; i < static_cast<int>(children_.size()); ++i)
    for (const MassElement& element : link(i).elements)
      if (element.tank >= 0) tanks[component_of(link(i).name)] = tank_name(element.tank);
  if (!particles_.empty() || !pendulums_.empty())
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

Half BsmHalf::half() {
  find_branches();
  find_wheels();
  check_motors();
  check_tanks();
  check_pendulums();
  check_attitude();
  check_loads();
  check_gravity();
  if (!half_.refusals.empty()) return std::move(half_);
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

Half bsm_half(const Model& model) { return BsmHalf(model).half(); }

}  // namespace twincraft
