// What can be flown: whatever the parts cannot hold is refused at its component.
#include "compiler/emit/basilisk_bsm_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "compiler/emit/basilisk_half.h"

namespace twincraft {
namespace {

// Of what one of Basilisk's messages for motors holds.
constexpr int kMotors = 36;
// Basilisk's pendulum takes another chart of angles there.
constexpr double kPendulumChart = 0.78;  // [rad]

class PartsFinder {
 public:
  explicit PartsFinder(const Model& model);
  BsmParts found();

 private:
  const Link& link(int index) const { return link_at(model_, index); }
  const Rotor& rotor(int index) const { return rotor_at(model_, index); }
  const std::vector<int>& children(int index) const {
    return children_[static_cast<std::size_t>(index)];
  }
  Coordinate::Kind kind(int index) const { return kinds_[static_cast<std::size_t>(index)]; }
  bool is_slosh(int index) const {
    return kind(index) == Coordinate::Kind::kParticle || kind(index) == Coordinate::Kind::kPendulum;
  }
  void refuse(const std::string& component, std::string why) {
    parts_.refusals.push_back({component, std::move(why)});
  }
  void note(const std::string& component, std::string what) {
    parts_.notes.push_back({component, std::move(what)});
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

  const Model& model_;
  std::vector<std::vector<int>> children_;
  std::vector<Coordinate::Kind> kinds_;
  BsmParts parts_;
};

PartsFinder::PartsFinder(const Model& model)
    : model_(model),
      children_(model.assembly.links.size()),
      kinds_(model.assembly.links.size(), Coordinate::Kind::kBodyAngle) {
  for (int i = 1; i < static_cast<int>(children_.size()); ++i)
    children_[static_cast<std::size_t>(link(i).parent)].push_back(i);
  for (const Coordinate& each : model.coordinates)
    if (!each.is_wheel()) kinds_[static_cast<std::size_t>(each.index)] = each.kind;
}

void PartsFinder::find_branches() {
  for (int i = 1; i < static_cast<int>(children_.size()); ++i)
    if (is_slosh(i)) check_slosh(i);
  for (const int first : children(0))
    if (!is_slosh(first)) follow(first);
}

void PartsFinder::check_slosh(int index) {
  const bool is_pendulum = kind(index) == Coordinate::Kind::kPendulum;
  if (is_pendulum && link(index).joint.damped_by_cosine_of < 0) return;  // its second angle
  if (link(index).parent != 0) {
    const std::string& mount = link(link(index).parent).name;
    return refuse(component_of(link(index)),
                  fmt::format("it moves on `{}`, and Basilisk's slosh is on the hub", mount));
  }
  (is_pendulum ? parts_.pendulums : parts_.particles).push_back(index);
}

void PartsFinder::follow(int first) {
  Chain chain{component_of(link(first)), {}};
  for (int at = first;;) {
    chain.links.push_back(at);
    std::vector<int> next;
    std::ranges::copy_if(children(at), std::back_inserter(next),
                         [this](int i) { return !is_slosh(i); });
    if (next.size() > 1) {
      std::vector<std::string> names;
      for (const int each : next) names.push_back(link(each).name);
      refuse(component_of(link(at)),
             fmt::format("{} branch off it, and Basilisk's effectors are chains on the hub",
                         enumeration(names)));
      for (const int each : next) follow(each);  // for what is to be said of these
      return;
    }
    if (next.empty()) break;
    if (link(next.front()).joint.kind != link(at).joint.kind) {
      const bool turns = link(at).joint.kind == JointKind::kHinge;
      refuse(component_of(link(next.front())),
             fmt::format("it {} on `{}`, which {}: a chain of Basilisk's has joints of one kind",
                         turns ? "slides" : "turns", link(at).name, turns ? "turns" : "slides"));
    }
    at = next.front();
  }
  parts_.chains.push_back(std::move(chain));
}

void PartsFinder::find_wheels() {
  for (int i = 0; i < static_cast<int>(model_.assembly.rotors.size()); ++i)
    if (rotor(i).link != 0) find_wheel(i);
}

/// Which chain ends in a wheel that is not on the hub.
void PartsFinder::find_wheel(int index) {
  const Rotor& wheel = rotor(index);
  const std::string& mount = link(wheel.link).name;
  const auto chain = std::ranges::find_if(
      parts_.chains, [&wheel](const Chain& each) { return each.links.back() == wheel.link; });
  if (chain == parts_.chains.end() || !children(wheel.link).empty())
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

void PartsFinder::check_motors() {
  const auto on_hub = std::ranges::count(model_.assembly.rotors, 0, &Rotor::link);
  if (on_hub > kMotors)
    refuse("", fmt::format("{} wheels are on the hub, and Basilisk takes {}", on_hub, kMotors));
  for (const Chain& chain : parts_.chains) {
    const int joints = static_cast<int>(chain.links.size()) + (chain.wheel ? 1 : 0);
    if (has_motor(model_, chain) && joints > kMotors)
      refuse(chain.name, fmt::format("its chain has a motor and {} joints, and Basilisk's message "
                                     "for motors holds {}",
                                     joints, kMotors));
  }
}

void PartsFinder::check_tanks() {
  for (int i = 1; i < static_cast<int>(children_.size()); ++i)
    for (const MassElement& element : link(i).elements)
      if (element.tank >= 0 && !is_slosh(i))
        refuse(element.name, fmt::format("it moves with `{}`, and Basilisk's tanks are on the hub",
                                         link(i).name));
  for (const Tank& tank : model_.tanks)
    if (tank.momentum == LeavingMomentum::kJet && !tank.mass_flow.is_zero())
      refuse(tank.name, "its jet takes momentum along by another law than Basilisk's");
}

void PartsFinder::check_pendulums() {
  for (const int first : parts_.pendulums) {
    const int second = link(first).joint.damped_by_cosine_of;
    const std::string name = component_of(link(first));
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

void PartsFinder::check_attitude() {
  if (model_.engines.attitude == AttitudeChart::kQuaternion && !model_.simulation.translation)
    note("", "the attitude is in MRPs, and in quaternions in the analytic engine of the spec");
}

void PartsFinder::check_loads() {
  const bool is_rigid = model_.assembly.links.size() == 1 && model_.tanks.empty();
  if (is_rigid) return;
  for (const Load& load : model_.loads)
    if (!load.r_FL_L)
      refuse(load.name, "it acts at the centre of mass, which moves in this vehicle");
}

void PartsFinder::check_gravity() {
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

BsmParts PartsFinder::found() {
  find_branches();
  find_wheels();
  check_motors();
  check_tanks();
  check_pendulums();
  check_attitude();
  check_loads();
  check_gravity();
  return std::move(parts_);
}

}  // namespace

BsmParts bsm_parts(const Model& model) { return PartsFinder(model).found(); }

const Link& link_at(const Model& model, int index) {
  return model.assembly.links[static_cast<std::size_t>(index)];
}

const Rotor& rotor_at(const Model& model, int index) {
  return model.assembly.rotors[static_cast<std::size_t>(index)];
}

std::string component_of(const Link& link) { return link.name.substr(0, link.name.find('.')); }

bool has_motor(const Model& model, const Chain& chain) {
  return std::ranges::any_of(
             chain.links, [&model](int i) { return !link_at(model, i).joint.effort.is_zero(); }) ||
         (chain.wheel && !rotor_at(model, *chain.wheel).torque.is_zero());
}

}  // namespace twincraft
