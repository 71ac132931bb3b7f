// Decides how momentum and energy are added up: about the system centre of mass, and in the hub's
// co-moving frame until the last step, so that nothing small is lost beside orbital speed.
// Tested by tests/runtime/mujoco_test.cpp.
#include "runtime/mujoco/motion_sums.h"

#include "runtime/mujoco/tree_map.h"

namespace twincraft {
namespace {

using Point = Eigen::Map<const Vector3d>;

// Relative to the hub origin. cvel is (angular, linear) at the centre of mass of the whole tree.
Vector3d center_velocity(const mjData& data, int body) {
  const Vector3d omega = Point(data.cvel + 6 * body);
  const Point r_CB_W(data.subtree_com + 3 * kHubBody);
  const Vector3d v_B = Point(data.cvel + 6 * body + 3) - omega.cross(r_CB_W);
  return v_B + omega.cross(Point(data.xipos + 3 * body));
}

// I omega of one body about its own centre of mass, world axes.
Vector3d spin_momentum(const mjModel& model, const mjData& data, int body,
                       const Vector3d& omega_W) {
  using Rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  const Rotation dcm_WI(data.ximat + 9 * body);
  const Point moments(model.body_inertia + 3 * body);
  const Vector3d omega_I = dcm_WI.transpose() * omega_W;
  return dcm_WI * moments.cwiseProduct(omega_I);
}

}  // namespace

MotionSums sum_motion(const mjModel& model, const mjData& data, const Vector3d& v_BN_N) {
  MotionSums sums;
  Vector3d first_moment = Vector3d::Zero();  // [kg m] about the hub origin
  Vector3d momentum_B = Vector3d::Zero();    // [kg m/s] relative to the hub origin
  for (int body = kHubBody; body < model.nbody; ++body) {
    const double mass = model.body_mass[body];
    const Vector3d v_iB_N = center_velocity(data, body);
    sums.mass += mass;
    first_moment += mass * Point(data.xipos + 3 * body);
    momentum_B += mass * v_iB_N;
    sums.momentum_scale += mass * (v_BN_N.norm() + v_iB_N.norm());
  }
  sums.r_CB_N = first_moment / sums.mass;
  const Vector3d v_CB_N = momentum_B / sums.mass;
  sums.v_CN_N = v_BN_N + v_CB_N;
  sums.momentum = sums.mass * v_BN_N + momentum_B;

  double internal = 0.0;  // [J] about C
  for (int body = kHubBody; body < model.nbody; ++body) {
    const double mass = model.body_mass[body];
    const Vector3d omega = Point(data.cvel + 6 * body);
    const Vector3d r_iC_N = Point(data.xipos + 3 * body) - sums.r_CB_N;
    const Vector3d v_iC_N = center_velocity(data, body) - v_CB_N;
    const Vector3d spin = spin_momentum(model, data, body, omega);
    const Vector3d H_i = mass * r_iC_N.cross(v_iC_N) + spin;
    internal += 0.5 * (mass * v_iC_N.squaredNorm() + omega.dot(spin));
    sums.H_PntC_N += H_i;
    sums.H_scale += H_i.norm();
  }
  sums.own_kinetic = internal;
  sums.kinetic = 0.5 * sums.mass * sums.v_CN_N.squaredNorm() + internal;
  return sums;
}

// MuJoCo has the mass and first moment of every body about its reference point at hand: the last
// four numbers of cinert. That point is the centre of mass of the tree before it drained.
BodyCenter center_of(const mjModel& model, const mjData& data) {
  BodyCenter center;
  for (int body = kHubBody; body < model.nbody; ++body) {
    const Point moment(data.cinert + 10 * body + 6);
    const double mass = data.cinert[10 * body + 9];
    const Point omega(data.cvel + 6 * body), v(data.cvel + 6 * body + 3);
    center.mass += mass;
    center.r_CB_W += moment;
    center.v_CB_W += mass * v + omega.cross(moment);
  }
  center.r_CB_W /= center.mass;
  center.r_CB_W += Point(data.subtree_com + 3 * kHubBody) - Point(data.xpos + 3 * kHubBody);
  center.v_CB_W /= center.mass;
  return center;
}

// The motion of C drops out of the rate of H: neither the sum of m (r - r_C) nor that of m (v -
// v_C) is anything.
LeavingSums leaving(const mjModel& model, const mjData& data, const Vector3d& v_BN_W,
                    const BodyCenter& center, const Loss& loss) {
  const double mass_rate = loss.relative_rate * model.body_mass[loss.body];
  const Vector3d omega = Point(data.cvel + 6 * loss.body);
  const Vector3d v_iB_W = center_velocity(data, loss.body);
  const Vector3d v_iN_W = v_BN_W + v_iB_W, v_iC_W = v_iB_W - center.v_CB_W;
  const Vector3d r_iC_W = Point(data.xipos + 3 * loss.body) - center.r_CB_W;
  const Vector3d spin = loss.relative_rate * spin_momentum(model, data, loss.body, omega);
  return {0.5 * (mass_rate * v_iN_W.squaredNorm() + omega.dot(spin)),
          0.5 * (mass_rate * v_iC_W.squaredNorm() + omega.dot(spin)), mass_rate * v_iN_W,
          mass_rate * r_iC_W.cross(v_iC_W) + spin};
}

}  // namespace twincraft
