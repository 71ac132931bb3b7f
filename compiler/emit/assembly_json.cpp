// The assembly as JSON, part by part. Tested by tests/compiler/emit_test.cpp.
#include "compiler/emit/assembly_json.h"

#include <cmath>

#include "compiler/emit/json.h"
#include "compiler/ir/gravity_law.h"
#include "compiler/ir/vector_json.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

/// A zero that always held is written like an input that was never given: they are one machine.
Json schedule_json(const Schedule& schedule) {
  Json entries = Json::array();
  const bool is_idle = schedule.entries.size() == 1 && schedule.is_zero() &&
                       !std::isfinite(schedule.entries.front().time);
  if (is_idle) return entries;
  for (const Schedule::Entry& entry : schedule.entries) {
    const Json time = std::isfinite(entry.time) ? Json(entry.time) : Json(nullptr);
    entries.push_back(Json::array({time, entry.value}));
  }
  return entries;
}

Json schedules_json(const std::array<Schedule, 3>& schedules) {
  Json axes = Json::array();
  for (const Schedule& schedule : schedules) axes.push_back(schedule_json(schedule));
  return axes;
}

/// Units differ between a hinge and a slide, so the keys do too.
Json joint_json(const Joint& joint) {
  const bool hinge = joint.kind == JointKind::kHinge;
  Json json = {{"kind", hinge ? "hinge" : "slide"},
               {"r_HP_P_m", vector_json(joint.r_HP_P)},
               {"dcm_PL0", matrix_json(joint.dcm_PL0)},
               {"axis_L", vector_json(joint.axis_L)},
               {hinge ? "stiffness_N_m_rad" : "stiffness_N_m", joint.stiffness},
               {hinge ? "damping_N_m_s_rad" : "damping_N_s_m", joint.damping},
               {hinge ? "rest_rad" : "rest_m", joint.rest},
               {hinge ? "torque_N_m" : "force_N", schedule_json(joint.effort)}};
  if (joint.damped_by_cosine_of >= 0) {
    json["damping_times_squared_cosine_of_link"] = joint.damped_by_cosine_of;
  }
  return json;
}

Json element_json(const MassElement& element) {
  Json json = {{"name", element.name},
               {"mass_kg", element.mass},
               {"r_EL_L_m", vector_json(element.r_EL_L)},
               {"I_PntE_L_kg_m2", matrix_json(element.I_PntE_L)}};
  if (element.tank >= 0) json["tank"] = element.tank;
  return json;
}

Json link_json(const Link& link) {
  Json json = {{"name", link.name}, {"parent", link.parent}};
  if (link.parent >= 0) json["joint"] = joint_json(link.joint);
  json["elements"] = Json::array();
  for (const MassElement& element : link.elements)
    json["elements"].push_back(element_json(element));
  return json;
}

Json rotor_json(const Rotor& rotor) {
  return {{"name", rotor.name},
          {"link", rotor.link},
          {"axis_L", vector_json(rotor.axis_L)},
          {"spin_inertia_kg_m2", rotor.spin_inertia},
          {"torque_N_m", schedule_json(rotor.torque)}};
}

Json coordinate_json(const Coordinate& coordinate) {
  return {{"name", coordinate.name},
          {"kind", kind_of(coordinate).word},
          {coordinate.is_wheel() ? "rotor" : "link", coordinate.index}};
}

Json load_json(const Load& load) {
  return {{"name", load.name},
          {"link", load.link},
          {"force_L_N", schedules_json(load.force_L)},
          {"torque_L_N_m", schedules_json(load.torque_L)},
          {"at", load.r_FL_L ? "point" : "com"},
          {"r_FL_L_m", load.r_FL_L ? vector_json(*load.r_FL_L) : Json(nullptr)}};
}

Json tank_json(const Tank& tank) {
  const bool jet = tank.momentum == LeavingMomentum::kJet;
  return {{"name", tank.name},
          {"content_kg", tank.content},
          {"mass_flow_kg_s", schedule_json(tank.mass_flow)},
          {"depletion", {{"momentum", jet ? "jet" : "none"}}}};
}

Json nozzle_json(const Nozzle& nozzle) {
  return {{"name", nozzle.name},
          {"tank", nozzle.tank},
          {"link", nozzle.link},
          {"r_PL_L_m", vector_json(nozzle.r_PL_L)},
          {"mass_flow_kg_s", schedule_json(nozzle.mass_flow)}};
}

Json initial_json(const VehicleState& initial) {
  const Quaterniond& q = initial.q_BN;
  return {{"r_BN_N_m", vector_json(initial.r_BN_N)},
          {"v_BN_N_m_s", vector_json(initial.v_BN_N)},
          {"q_BN", {q.w(), q.x(), q.y(), q.z()}},
          {"omega_BN_B_rad_s", vector_json(initial.omega_BN_B)},
          {"joint_position", initial.joint_position},
          {"joint_rate", initial.joint_rate},
          {"rotor_speed_rad_s", initial.wheel_rate}};
}

template <class Items, class Print>
Json list_json(const Items& items, Print print) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(print(item));
  return list;
}

[[maybe_unused]] Json field_json(const Vector3d& value) { return vector_json(value); }
[[maybe_unused]] Json field_json(const Matrix3d& value) { return matrix_json(value); }
[[maybe_unused]] Json field_json(const auto& value) { return value; }

/// Of the kinds that say their fields.
void add_forces(const Forces& forces, Json& json) {
  forces.for_each_kind([&json](const char* word, const auto& kind) {
    using Force = typename std::decay_t<decltype(kind)>::value_type;
    const auto print = [](const auto& force) {
      Json fields = Json::object();
      force.for_each_field(
          [&fields](const char* name, const auto& value) { fields[name] = field_json(value); });
      return fields;
    };
    if constexpr (requires(const Force& force) { force.for_each_field([](auto&&...) {}); })
      if (!kind.empty()) json[word] = list_json(kind, print);
  });
}

}  // namespace

std::string emit_bsm(const Model& model) {
  Json json = {{"format", "twincraft-assembly/1"}, {"name", model.name}};
  if (!model.description.empty()) json["description"] = model.description;
  if (model.simulation.translation) json["motion"] = "translation";
  json["links"] = list_json(model.assembly.links, link_json);
  json["rotors"] = list_json(model.assembly.rotors, rotor_json);
  json["coordinates"] = list_json(model.coordinates, coordinate_json);
  json["loads"] = list_json(model.loads, load_json);
  if (!model.tanks.empty()) json["tanks"] = list_json(model.tanks, tank_json);
  if (!model.nozzles.empty()) json["nozzles"] = list_json(model.nozzles, nozzle_json);
  add_forces(model.forces, json);
  json["gravity"] = {{"mu_m3_s2", model.gravity.mu}, {"law", word_of(model.gravity.bsm)}};
  json["initial"] = initial_json(model.initial);
  return json_text(json);
}

}  // namespace twincraft
