// One function per truth, each a list of what the truth knows nothing of.
// Tested by tests/runtime/reference_test.cpp.
#include "compiler/analysis/truth.h"

#include <algorithm>
#include <array>

#include "compiler/analysis/configuration.h"
#include "compiler/ir/inputs.h"

namespace twincraft {
namespace {

using Reason = std::optional<std::string>;

// How parallel is parallel: a direction given in decimals and normalised is off by a few ulp.
constexpr double kParallel = 1.0e-12;

bool is_parallel(const Vector3d& vector, const Vector3d& axis) {
  return vector.cross(axis).norm() <= kParallel * vector.norm();
}

/// Where in the hub every element with mass is, in both halves; false when one can move. A wheel on
/// the hub can not: its centre of mass is on its axis.
bool collect_fixed(const Model& model, std::vector<Vector3d>& positions) {
  const auto has_mass = [](const MassElement& element) { return element.mass > 0.0; };
  for (std::size_t link = 0; link < model.assembly.links.size(); ++link) {
    for (const MassElement& element : model.assembly.links[link].elements) {
      if (!has_mass(element)) continue;
      if (link > 0) return false;
      positions.push_back(element.r_EL_L);
    }
  }
  for (const TreeBody& body : model.tree.bodies) {
    const bool is_hub = body.parent < 0;
    const bool is_wheel_on_hub = body.parent == 0 && body.link < 0;
    for (const MassElement& element : body.elements) {
      if (!has_mass(element)) continue;
      if (!is_hub && !is_wheel_on_hub) return false;
      const Vector3d turned = body.quat * element.r_EL_L;
      positions.push_back(is_hub ? element.r_EL_L : body.pos + turned);
    }
  }
  return true;
}

/// Is any force of `load` not zero at some time in [0, duration)?
bool pushes(const Load& load, double duration) {
  return std::ranges::any_of(load.force_L, [duration](const Schedule& force) {
    return !force.during({{0.0, duration}}).is_zero();
  });
}

bool drains(const Tank& tank, double duration) { return tank.content_at(duration) != tank.content; }

bool is_elliptic(const Model& model) {
  const VehicleState& initial = model.initial;
  const std::vector<LinkMotion> links =
      configuration(model.assembly, initial.joint_position, initial.joint_rate);
  const Vector3d c = system_properties(model.assembly, links).r_CL_L;
  const Vector3d c_dot = center_of_mass_rate(model.assembly, links) + initial.omega_BN_B.cross(c);
  const Vector3d r = initial.r_BN_N + initial.q_BN * c;
  const Vector3d v = initial.v_BN_N + initial.q_BN * c_dot;
  const Vector3d h = r.cross(v);
  // A straight fall (h = 0) has energy below zero too, but reaches the centre.
  return 0.5 * v.squaredNorm() < model.gravity.mu / r.norm() && h.norm() > 0.0;
}

/// What no truth about one rigid body knows of.
Reason not_rigid(const Model& model) {
  if (model.assembly.links.size() > 1) return "the vehicle has joints";
  if (!model.assembly.rotors.empty()) return "the vehicle has wheels";
  return std::nullopt;
}

/// What makes a rigid body turn other than by itself and by loads.
Reason turned_from_outside(const Model& model, GravityLaw law) {
  if (model.simulation.translation) return "a point mass does not turn";
  if (const Reason moving = not_rigid(model)) return moving;
  for (const Tank& tank : model.tanks)
    if (drains(tank, model.simulation.duration)) return "tank `" + tank.name + "` drains";
  if (law == GravityLaw::kBodyGradient) return "gravity turns the vehicle (`body_gradient`)";
  if (law == GravityLaw::kBodyCom && !all_mass_at_one_point(model))
    return "gravity at several points (`body_com`) turns the vehicle";
  return std::nullopt;
}

Reason kepler_inapplicable(const Model& model, GravityLaw law) {
  if (law == GravityLaw::kNone) return "there is no gravity";
  for (const Load& load : model.loads) {
    if (pushes(load, model.simulation.duration)) return "`" + load.name + "` applies a force";
  }
  if (law != GravityLaw::kSystemCom && !all_mass_at_one_point(model))
    return "gravity acts at several points, so the system centre of mass is not on a Kepler orbit; "
           "it is under `application: system_com`";
  if (!is_elliptic(model)) return "the initial state is not on an ellipse";
  return std::nullopt;
}

bool is_constant(const Load& load, double duration) {
  std::vector<const Schedule*> schedules;
  for (const Schedule& force : load.force_L) schedules.push_back(&force);
  for (const Schedule& torque : load.torque_L) schedules.push_back(&torque);
  return event_times(schedules, duration).empty();
}

Reason spin_up_inapplicable(const Model& model, GravityLaw law) {
  if (const Reason turned = turned_from_outside(model, law)) return turned;
  for (const Load& load : model.loads) {
    if (!is_constant(load, model.simulation.duration))
      return "`" + load.name + "` changes during the run";
  }
  const MassProperties hub = hub_properties(model);
  const Vector3d torque = load_torque(model, 0.0, hub.r_CL_L);
  const Vector3d& omega = model.initial.omega_BN_B;
  if (omega.isZero(0.0) && torque.isZero(0.0)) return std::nullopt;
  const Vector3d axis = (omega.isZero(0.0) ? torque : omega).normalized();
  if (!is_parallel(torque, axis))
    return "the torque about the centre of mass is not along the initial rate";
  if (!is_parallel(hub.I_PntC_L * axis, axis))
    return "rate and torque are not along a principal axis";
  return std::nullopt;
}

/// Is the torque of the loads about C zero, as far as rounding of their arms allows? Between
/// `start` and `end` nothing changes but the masses, which are linear in time; the torque times the
/// mass is too, so that zero at both ends is zero between them.
bool balanced(const Model& model, double start, double end) {
  return std::ranges::all_of(std::array{start, end}, [&](double time) {
    const Vector3d c = hub_properties(model, time).r_CL_L;
    const double size = load_force(model, start).norm() * (1.0 + c.norm());
    return load_torque(model, start, c).norm() <= kParallel * size;
  });
}

bool always_balanced(const Model& model) {
  const std::vector<double> times = phases(model);
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!balanced(model, times[i - 1], times[i])) return false;
  return true;
}

Reason torque_free_inapplicable(const Model& model, GravityLaw law) {
  if (const Reason turned = turned_from_outside(model, law)) return turned;
  if (!always_balanced(model)) return "the loads have a torque about the centre of mass";
  return std::nullopt;
}

Reason tsiolkovsky_inapplicable(const Model& model, GravityLaw law) {
  if (model.simulation.translation) return "a point mass has no propellant";
  if (law != GravityLaw::kNone) return "gravity bends the path";
  if (const Reason moving = not_rigid(model)) return moving;
  if (std::ranges::none_of(
          model.tanks, [&](const Tank& tank) { return drains(tank, model.simulation.duration); }))
    return "no tank drains";
  if (!model.initial.omega_BN_B.isZero(0.0)) return "the vehicle turns, and its thrust with it";
  if (!always_balanced(model))
    return "the thrust is not through the centre of mass all the time, so it turns the vehicle";
  return std::nullopt;
}

}  // namespace

bool all_mass_at_one_point(const Model& model) {
  std::vector<Vector3d> positions;
  if (!collect_fixed(model, positions)) return false;
  return std::all_of(positions.begin(), positions.end(),
                     [&](const Vector3d& r) { return r == positions.front(); });
}

MassProperties hub_properties(const Model& model, double time) {
  MassProperties hub;
  for (MassElement element : model.assembly.links[0].elements) {
    if (element.tank >= 0) {
      const double share = model.tanks[static_cast<std::size_t>(element.tank)].share(time);
      element.mass *= share;
      element.I_PntE_L *= share;
    }
    hub = hub + properties_of(element);
  }
  return hub;
}

Vector3d load_force(const Model& model, double time) {
  const Inputs inputs = inputs_at(model, time);
  Vector3d force = Vector3d::Zero();
  for (int load = 0; load < inputs.layout.loads; ++load)
    force += inputs.vector(inputs.layout.force(load));
  return force;
}

Vector3d load_torque(const Model& model, double time, const Vector3d& r_CB_B) {
  const Inputs inputs = inputs_at(model, time);
  Vector3d torque = Vector3d::Zero();
  for (int i = 0; i < inputs.layout.loads; ++i) {
    const std::optional<Vector3d>& r_FB_B = model.loads[static_cast<std::size_t>(i)].r_FL_L;
    torque += inputs.vector(inputs.layout.torque(i));
    if (r_FB_B) torque += (*r_FB_B - r_CB_B).cross(inputs.vector(inputs.layout.force(i)));
  }
  return torque;
}

std::vector<double> phases(const Model& model) {
  std::vector<double> times = input_events(model);
  times.insert(times.begin(), 0.0);
  times.push_back(model.simulation.duration);
  return times;
}

std::string_view reference_name(ReferenceKind kind) {
  switch (kind) {
    case ReferenceKind::kKepler:
      return "kepler";
    case ReferenceKind::kSpinUp:
      return "spin_up";
    case ReferenceKind::kTorqueFree:
      return "torque_free";
    case ReferenceKind::kTsiolkovsky:
      return "tsiolkovsky";
    case ReferenceKind::kStored:
      break;
  }
  return "stored";
}

std::optional<std::string> inapplicable(ReferenceKind kind, const Model& model, GravityLaw law) {
  switch (kind) {
    case ReferenceKind::kKepler:
      return kepler_inapplicable(model, law);
    case ReferenceKind::kSpinUp:
      return spin_up_inapplicable(model, law);
    case ReferenceKind::kTorqueFree:
      return torque_free_inapplicable(model, law);
    case ReferenceKind::kTsiolkovsky:
      return tsiolkovsky_inapplicable(model, law);
    case ReferenceKind::kStored:
      break;
  }
  if (model.stored.states.empty()) return "the spec has no section `stored`";
  return std::nullopt;
}

std::optional<std::string> inapplicable(ReferenceKind kind, const Model& model) {
  const std::optional<std::string> of_bsm = inapplicable(kind, model, model.gravity.bsm);
  return of_bsm ? of_bsm : inapplicable(kind, model, model.gravity.mujoco);
}

}  // namespace twincraft
