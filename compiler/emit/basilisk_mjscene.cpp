// The body tree in Basilisk's MJScene: an XML of its own, of what moves alone, and what acts on it.
// Tested by tests/compiler/basilisk_test.cpp, and flown by tests/basilisk.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "compiler/emit/basilisk_half.h"
#include "compiler/emit/basilisk_mjscene_code.h"
#include "compiler/emit/mujoco_inertial.h"
#include "compiler/emit/python_text.h"
#include "compiler/ir/number.h"
#include "compiler/ir/vector_json.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

std::string text(double value) { return shortest(value); }
std::string text(const Vector3d& v) {
  return fmt::format("{} {} {}", shortest(v.x()), shortest(v.y()), shortest(v.z()));
}
std::string text(const Quaterniond& q) {
  return fmt::format("{} {} {} {}", shortest(q.w()), shortest(q.x()), shortest(q.y()),
                     shortest(q.z()));
}
bool is_identity(const Quaterniond& q) { return q.vec().isZero(0.0); }

/// MuJoCo 3 pins a site within 1e-6 m of its body's origin to the body, unless it is turned.
/// MJScene looks for the centre of mass again and again where its own site is pinned.
bool is_pinned(const Vector3d& r) {
  constexpr double kNear = 1.0e-5;  // [m]
  return !r.isZero(0.0) && r.norm() < kNear;
}
Quaterniond turned() { return {0.5, 0.5, 0.5, 0.5}; }

/// The drag on a bob: -drag times its velocity in its mount's axes.
struct Drag {
  int bob = 0, mount = 0;  // bodies of the tree
  double drag = 0.0;       // [N s/m]
};

class MjSceneHalf {
 public:
  explicit MjSceneHalf(const Model& model);
  Half half();

 private:
  const TreeBody& body(int index) const {
    return model_.tree.bodies[static_cast<std::size_t>(index)];
  }
  /// The body whose axes are a link's.
  int body_of(int link) const { return bodies_of_links_[static_cast<std::size_t>(link)]; }
  const Drag* drag_on(int bob) const;
  void table(std::string_view comment, std::string_view name, const Json& value) {
    half_.tables += assignment(name, value, comment);
  }

  void find_drags();
  void write_xml();
  void write_body(int index, int depth);
  void write_inertial(int index, const std::string& margin);
  void element(const std::string& margin, const std::string& tag,
               const std::vector<std::pair<std::string, std::string>>& attributes,
               bool is_closed = true);
  void write_joints();
  void write_loads();
  void write_flows();
  void write_jets();
  bool is_merged(int index) const;
  void write_targets();
  void write_gradients();
  void check_gravity();

  const Model& model_;
  std::vector<std::vector<int>> children_;
  std::vector<int> bodies_of_links_;
  std::vector<Drag> drags_;
  std::vector<std::string> joints_;  // in MuJoCo's order
  std::string xml_;
  bool pulls_on_elements_ = false;  // gravity does
  MjSceneTables has_;
  Half half_;
};

MjSceneHalf::MjSceneHalf(const Model& model)
    : model_(model),
      children_(model.tree.bodies.size()),
      bodies_of_links_(model.assembly.links.size(), 0) {
  for (int i = 1; i < static_cast<int>(children_.size()); ++i) {
    children_[static_cast<std::size_t>(body(i).parent)].push_back(i);
    if (body(i).link > 0 && !body(i).joints.empty())
      bodies_of_links_[static_cast<std::size_t>(body(i).link)] = i;
  }
}

void MjSceneHalf::find_drags() {
  for (const Link& link : model_.assembly.links) {
    const int second = link.joint.damped_by_cosine_of;
    if (second < 0 || link.joint.damping == 0.0) continue;
    const MassElement& bob =
        model_.assembly.links[static_cast<std::size_t>(second)].elements.front();
    const int at = body_of(second);
    drags_.push_back({at, body(at).parent, link.joint.damping / bob.r_EL_L.squaredNorm()});
  }
}

const Drag* MjSceneHalf::drag_on(int bob) const {
  const auto found = std::ranges::find(drags_, bob, &Drag::bob);
  return found == drags_.end() ? nullptr : &*found;
}

// The XML ----------------------------------------------------------------------------------------

void MjSceneHalf::element(const std::string& margin, const std::string& tag,
                          const std::vector<std::pair<std::string, std::string>>& attributes,
                          bool is_closed) {
  std::string words = "<" + tag;
  for (const auto& [key, value] : attributes) words += fmt::format(" {}=\"{}\"", key, value);
  words += is_closed ? "/>" : ">";
  // A body begins a line; what it has follows where there is room.
  const bool begins = tag == "body" || tag == "general";
  const std::size_t column = xml_.size() - (xml_.rfind('\n', xml_.size() - 2) + 1);
  if (!begins && column + words.size() <= kScriptLine) {
    xml_.pop_back();
    xml_ += words + "\n";
  } else {
    xml_ += filled(words, margin, margin + "  ");
  }
}

void MjSceneHalf::write_inertial(int index, const std::string& margin) {
  const MujocoInertial inertial = mujoco_inertial(body(index).inertial);
  const Quaterniond& axes = inertial.principal.axes;
  std::vector<std::pair<std::string, std::string>> attributes = {{"pos", text(inertial.r_CL_L)},
                                                                 {"mass", text(inertial.mass)}};
  if (!is_identity(axes)) attributes.emplace_back("quat", text(axes));
  attributes.emplace_back("diaginertia", text(inertial.principal.moments));
  element(margin, "inertial", attributes);
  const std::string& name = body(index).name;
  if (is_pinned(inertial.r_CL_L))
    element(margin, "site",
            {{"name", name + "_com"}, {"pos", text(inertial.r_CL_L)}, {"quat", text(turned())}});
  else if (drag_on(index) != nullptr)
    element(margin, "site", {{"name", name + "_com"}, {"pos", text(inertial.r_CL_L)}});
  if (pulls_on_elements_ && is_merged(index) && body(index).link >= 0)
    for (const MassElement& each : body(index).elements)
      element(
          margin, "site",
          {{"name", each.name + ".weight"}, {"pos", text(each.r_EL_L)}, {"quat", text(turned())}});
  if (std::ranges::find(drags_, index, &Drag::mount) != drags_.end())
    element(margin, "site", {{"name", name + "_origin"}});
}

void MjSceneHalf::write_body(int index, int depth) {
  const TreeBody& body = this->body(index);
  const std::string margin(static_cast<std::size_t>(std::min(depth, 12)), ' ');
  std::vector<std::pair<std::string, std::string>> head = {{"name", body.name}};
  if (!body.pos.isZero(0.0)) head.emplace_back("pos", text(body.pos));
  if (!is_identity(body.quat)) head.emplace_back("quat", text(body.quat));
  element(margin, "body", head, false);
  const std::string inner = margin + " ";
  if (index == 0 && !model_.simulation.translation)
    element(inner, "freejoint", {{"name", body.name}});
  if (index == 0 && model_.simulation.translation)
    for (const auto& [suffix, axis] : {std::pair{".x", "1 0 0"}, {".y", "0 1 0"}, {".z", "0 0 1"}})
      element(inner, "joint", {{"name", body.name + suffix}, {"type", "slide"}, {"axis", axis}});
  for (const TreeJoint& joint : body.joints) {
    std::vector<std::pair<std::string, std::string>> attributes = {{"name", joint.name}};
    if (joint.kind == JointKind::kSlide) attributes.emplace_back("type", "slide");
    attributes.emplace_back("axis", text(joint.axis));
    if (joint.stiffness != 0.0) attributes.emplace_back("stiffness", text(joint.stiffness));
    if (joint.springref != 0.0) attributes.emplace_back("springref", text(joint.springref));
    if (joint.damping != 0.0 && drag_on(index) == nullptr)
      attributes.emplace_back("damping", text(joint.damping));
    element(inner, "joint", attributes);
    joints_.push_back(joint.name);
  }
  write_inertial(index, inner);
  for (const int child : children_[static_cast<std::size_t>(index)]) write_body(child, depth + 1);
  xml_.pop_back();  // bodies end where their last part does
  xml_ += "</body>\n";
}

void MjSceneHalf::write_xml() {
  xml_ =
      "<mujoco><compiler angle=\"radian\"/><option><flag "
      "constraint=\"disable\"/></option><worldbody>\n";
  write_body(0, 0);
  xml_.pop_back();
  xml_ += "</worldbody>";
  // MuJoCo takes joints that both sites share out of what an actuator between them sees and moves:
  // what is left is the velocity in the mount.
  if (!drags_.empty()) xml_ += "\n<actuator>\n";
  for (const Drag& drag : drags_)
    for (const auto& [axis, gear] :
         {std::pair{"x", "1 0 0 0 0 0"}, {"y", "0 1 0 0 0 0"}, {"z", "0 0 1 0 0 0"}})
      element(" ", "general",
              {{"name", body(drag.bob).name + ".drag." + axis},
               {"site", body(drag.bob).name + "_com"},
               {"refsite", body(drag.mount).name + "_origin"},
               {"gear", gear},
               {"gainprm", "0"},
               {"biastype", "affine"},
               {"biasprm", "0 0 " + text(-drag.drag)}});
  if (!drags_.empty()) xml_ += "</actuator>";
  half_.tables += "XML = \"\"\"" + xml_ + "</mujoco>\"\"\"\n";
}

// What acts --------------------------------------------------------------------------------------

void MjSceneHalf::write_joints() {
  Json joints = Json::object();
  for (const std::string& name : joints_) joints[name] = nullptr;
  const auto add_motor = [&](const std::string& name, const char* kind, const Schedule& effort) {
    if (effort.is_zero()) return;
    joints[name] = name + kind;
    has_.motors = true;
  };
  for (const Rotor& rotor : model_.assembly.rotors) add_motor(rotor.name, ".torque", rotor.torque);
  for (const Link& link : model_.assembly.links)
    add_motor(link.name, link.joint.kind == JointKind::kHinge ? ".torque" : ".force",
              link.joint.effort);
  has_.joints = !joints_.empty();
  if (has_.joints) table("in the order of MuJoCo, with their inputs", "JOINTS", joints);
}

void MjSceneHalf::write_loads() {
  Json sites = Json::object();
  Json at_com = Json::object();
  for (const Load& load : model_.loads) {
    const std::string& on = body(body_of(load.link)).name;
    if (load.r_FL_L)
      sites[load.name] = {{"on", on}, {"at", vector_json(*load.r_FL_L)}};
    else
      at_com[load.name] = on;
  }
  has_.sites = !sites.empty();
  has_.at_com = !at_com.empty();
  if (has_.sites)
    table("loads and thrusters: the body, in whose axes they act, and where [m]", "PUSHES", sites);
  if (has_.at_com)
    table("those at the centre of mass of the vehicle: the body in whose axes they act", "AT_COM",
          at_com);
  if (has_.at_com)
    half_.notes.push_back({"",
                           "what acts at the centre of mass follows it by a model in Python, "
                           "which takes 0.2 ms a step or more"});
}

void MjSceneHalf::write_flows() {
  Json parts = Json::object();
  for (const TreeBody& each : model_.tree.bodies) {
    if (each.tank < 0) continue;
    const Tank& tank = model_.tanks[static_cast<std::size_t>(each.tank)];
    if (tank.mass_flow.is_zero()) continue;
    parts[each.name] = {tank.name, mujoco_inertial(each.inertial).mass / tank.content};
  }
  has_.flows = !parts.empty();
  if (has_.flows) table("body that drains: its tank, its part of what that holds", "PARTS", parts);
}

void MjSceneHalf::write_jets() {
  Json jets = Json::array();
  for (const Stream& stream : model_.forces.streams) {
    const Nozzle& nozzle = model_.nozzles[static_cast<std::size_t>(stream.nozzle)];
    if (nozzle.mass_flow.is_zero()) continue;
    jets.push_back(
        {{"nozzle", nozzle.name + ".flow"},
         {"part", stream.part},
         {"on", {body(body_of(stream.nozzle_link)).name, body(body_of(stream.element_link)).name}},
         {"at", {vector_json(stream.r_PL_L), vector_json(stream.r_EL_L)}},
         {"k", matrix_json(stream.k_L)}});
  }
  has_.jets = !jets.empty();
  if (!has_.jets) return;
  table(
      "from source to nozzle: part of the nozzle's flow, bodies, places [m], k of the source [m2]",
      "JETS", jets);
  half_.notes.push_back(
      {"", "jet damping is a model in Python, which takes 0.2 ms a step or more"});
}

// Gravity pulls on every element of the ledger where it is. A body of one element is a target as it
// is, and so are the tokens at its centre of mass; of one of several every element is, by a site.
bool MjSceneHalf::is_merged(int index) const {
  const TreeBody& each = body(index);
  if (each.link < 0) return is_merged(each.parent);  // a wheel's token, whose mass is an element's
  return each.tank < 0 && each.elements.size() > 1;
}

void MjSceneHalf::write_targets() {
  Json pulled = Json::array();
  Json weights = Json::object();
  for (int i = 0; i < static_cast<int>(children_.size()); ++i) {
    if (!is_merged(i))
      pulled.push_back(body(i).name);
    else if (body(i).link >= 0)
      for (const MassElement& element : body(i).elements) weights[element.name] = element.mass;
  }
  has_.weights = !weights.empty();
  table("bodies that gravity pulls on", "PULLED", pulled);
  if (has_.weights) table("and parts of others, at their sites [kg]", "WEIGHTS", weights);
}

/// Of what is not round: at which site, the mass of which body or how much [kg], and inertia per
/// mass in the axes of the site.
void MjSceneHalf::write_gradients() {
  Json all = Json::object();
  const auto add = [&all](const std::string& site, const Json& of, const PrincipalInertia& inertia,
                          double mass, bool is_turned) {
    const Vector3d& moments = inertia.moments;
    if (moments.maxCoeff() - moments.minCoeff() <= 1.0e-14 * moments.maxCoeff()) return;
    const Quaterniond axes = is_turned ? turned().conjugate() * inertia.axes : inertia.axes;
    const Matrix3d R = axes.toRotationMatrix();
    const Matrix3d k = R * (moments / mass).asDiagonal() * R.transpose();
    all[site] = {of, matrix_json(k)};
  };
  for (int i = 0; i < static_cast<int>(children_.size()); ++i) {
    const MujocoInertial inertial = mujoco_inertial(body(i).inertial);
    if (!is_merged(i))
      add(body(i).name + "_com", body(i).name, inertial.principal, inertial.mass,
          is_pinned(inertial.r_CL_L));
    else if (body(i).link >= 0)
      for (const MassElement& element : body(i).elements)
        add(element.name + ".weight", element.mass, principal_inertia(element.I_PntE_L),
            element.mass, true);
  }
  has_.gradients = !all.empty();
  if (has_.gradients)
    table("site: a body or a mass [kg], inertia per mass there [m2]", "GRADIENTS", all);
}

void MjSceneHalf::check_gravity() {
  const bool in_python =
      has_.gravity == GravityLaw::kSystemCom || has_.gravity == GravityLaw::kBodyGradient;
  if (has_.pulls_bodies()) write_targets();
  if (has_.gravity == GravityLaw::kBodyGradient) write_gradients();
  if (in_python)
    half_.notes.push_back(
        {"", fmt::format("gravity `{}` is a model in Python, which takes 0.2 ms "
                         "a step or more",
                         has_.gravity == GravityLaw::kSystemCom ? "system_com" : "body_gradient")});
  const bool burns =
      std::ranges::any_of(model_.loads, [](const Load& load) { return load.thruster.has_value(); });
  if (has_.gravity == GravityLaw::kNone && burns)
    half_.notes.push_back({"",
                           "MJScene counts from the origin of N: an attitude is off by up to "
                           "1e-4 deg once the vehicle has gained kilometres a second"});
  if (has_.gravity != GravityLaw::kNone)
    half_.notes.push_back({"",
                           "MJScene counts from the planet's centre: an attitude in orbit is "
                           "off by 1e-4 to 0.4 deg"});
}

Half MjSceneHalf::half() {
  if (!model_.mujoco_refusal.empty()) {
    half_.refusals.push_back({"", model_.mujoco_refusal});
    return std::move(half_);
  }
  find_drags();
  has_.gravity = model_.gravity.mujoco;
  pulls_on_elements_ = has_.pulls_bodies();
  write_xml();
  write_joints();
  write_loads();
  write_flows();
  write_jets();
  check_gravity();
  has_.is_point = model_.simulation.translation;
  if (is_adaptive(model_.simulation.method))
    half_.notes.push_back({"", "a step of an adaptive method is flown in tenths"});
  half_.models = mjscene_models(has_);
  half_.code = mjscene_code(has_);
  return std::move(half_);
}

}  // namespace

Half mjscene_half(const Model& model) { return MjSceneHalf(model).half(); }

}  // namespace twincraft
