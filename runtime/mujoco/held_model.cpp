// See held_model.h.
#include "runtime/mujoco/held_model.h"

namespace twincraft {
namespace {

using Point = Eigen::Map<const Vector3d>;

Quaterniond turn(const double* q) { return {q[0], q[1], q[2], q[3]}; }

/// Where a body is fixed on its link.
struct BodySeat {
  std::size_t link = 0;
  Matrix3d dcm_LS = Matrix3d::Identity();
  Vector3d r_SL_L = Vector3d::Zero();  // [m]
  double reach = 0.0;                  // [m]
};

/// The link that a joint moves; -1 for the hub's and for wheels'.
std::vector<int> links_of_joints(const mjModel& loaded, const TreeMap& map) {
  std::vector<int> links(static_cast<std::size_t>(loaded.njnt), -1);
  for (std::size_t i = 0; i < map.joint_dof.size(); ++i)
    links[static_cast<std::size_t>(loaded.dof_jntid[map.joint_dof[i]])] = static_cast<int>(i) + 1;
  return links;
}

MassProperties mass_of(const mjModel& loaded, int body, const BodySeat& seat) {
  const Matrix3d axes = seat.dcm_LS * turn(loaded.body_iquat + 4 * body).toRotationMatrix();
  const Vector3d moments = Point(loaded.body_inertia + 3 * body);
  return {loaded.body_mass[body], seat.r_SL_L + seat.dcm_LS * Point(loaded.body_ipos + 3 * body),
          axes * moments.asDiagonal() * axes.transpose()};
}

/// The body fixed on its parent, as every body is whose joints stand still.
BodySeat on_parent(const mjModel& loaded, int body, const BodySeat& parent) {
  const Point pos(loaded.body_pos + 3 * body);
  return {parent.link, parent.dcm_LS * turn(loaded.body_quat + 4 * body).toRotationMatrix(),
          parent.r_SL_L + parent.dcm_LS * pos, parent.reach + pos.norm()};
}

}  // namespace

HeldMachine held_by(const mjModel& loaded, const TreeMap& map) {
  HeldMachine machine;
  machine.links.resize(map.link_body.size());
  const std::vector<int> links = links_of_joints(loaded, map);
  std::vector<BodySeat> seats(static_cast<std::size_t>(loaded.nbody));
  for (int body = kHubBody; body < loaded.nbody; ++body) {
    BodySeat& seat = seats[static_cast<std::size_t>(body)];
    if (body > kHubBody)
      seat = on_parent(loaded, body, seats[static_cast<std::size_t>(loaded.body_parentid[body])]);
    const int first = loaded.body_jntadr[body];
    for (int joint = first; joint < first + loaded.body_jntnum[body]; ++joint) {
      const int link = links[static_cast<std::size_t>(joint)];
      if (link < 0) continue;
      HeldLink& held = machine.links[static_cast<std::size_t>(link)];
      held.r_HP_P = seat.r_SL_L;
      held.reach = seat.reach;
      held.dcm_PL0 = seat.dcm_LS;
      held.axis_L = Point(loaded.jnt_axis + 3 * joint);
      held.stiffness = loaded.jnt_stiffness[joint];
      held.damping = loaded.dof_damping[loaded.jnt_dofadr[joint]];
      held.rest = loaded.qpos_spring[loaded.jnt_qposadr[joint]];
      seat = {.link = static_cast<std::size_t>(link)};
    }
    MassProperties& mass = machine.links[seat.link].mass;
    mass = mass + mass_of(loaded, body, seat);
  }
  for (const int dof : map.wheel_dof) {
    const int body = loaded.dof_bodyid[dof];
    const Vector3d axis = Point(loaded.jnt_axis + 3 * loaded.dof_jntid[dof]);
    const MassProperties own = mass_of(loaded, body, {});
    machine.wheels.push_back(
        {seats[static_cast<std::size_t>(body)].dcm_LS * axis, axis.dot(own.I_PntC_L * axis)});
  }
  return machine;
}

}  // namespace twincraft
