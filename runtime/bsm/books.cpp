// See books.h. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/books.h"

namespace twincraft::bsm {
namespace {

/// How an element moves, with the velocity of B taken as zero.
struct MovingElement {
  double mass;
  Vector3d r_EB, v_E, spin;  // [m], [m/s], [kg m^2/s] angular momentum about its own centre
  double spin_energy;        // [J]
};

MovingElement moving(const Elements::Placed& element, const Motion& motion) {
  const LinkPose& pose = motion.poses[element.link];
  const LinkRate& rate = motion.rates[element.link];
  const Vector3d r_EL = pose.dcm_WL * element.r_EL_L();
  const Vector3d omega_L = pose.dcm_WL.transpose() * rate.omega_LN_W;
  const Vector3d spin_L = element.I_PntE_L() * omega_L;
  return {element.mass, pose.r_LB_W + r_EL, rate.v_LB_W + rate.omega_LN_W.cross(r_EL),
          pose.dcm_WL * spin_L, 0.5 * omega_L.dot(spin_L)};
}

/// What a link's loss is more than that of a point at its origin.
void add_extended(const Draining& draining, const LinkPose& pose, const LinkRate& rate,
                  std::span<const double> share_rates, const Vector3d& r_LC, const Vector3d& v_LC,
                  Leaving& leaving) {
  Vector3d moment_L = Vector3d::Zero();  // [kg m/s]
  Matrix3d J_L = Matrix3d::Zero();       // [kg m^2/s]
  for (const Draining::Part& part : draining.parts) {
    moment_L += share_rates[part.tank] * part.full.first_moment;
    J_L += share_rates[part.tank] * part.full.J_L;
  }
  const Vector3d& omega = rate.omega_LN_W;
  const Vector3d moment = pose.dcm_WL * moment_L;
  const Vector3d spin = pose.dcm_WL * (J_L * (pose.dcm_WL.transpose() * omega));
  const Vector3d turning = omega.cross(moment);
  leaving.momentum_B += turning;
  leaving.H_PntC_B += r_LC.cross(turning) + moment.cross(v_LC) + spin;
  leaving.kinetic += 0.5 * omega.dot(spin) + rate.v_LB_W.dot(turning);
}

}  // namespace

Center center_of(const Tree& tree, const Motion& motion) {
  Center center;
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const LinkConstants& link = tree.links[i];
    const LinkPose& pose = motion.poses[i];
    const LinkRate& rate = motion.rates[i];
    center.mass += link.mass;
    center.r_CB_B += link.mass * pose.r_LB_W;
    center.v_CB_B += link.mass * rate.v_LB_W;
    if (link.first_moment.isZero(0.0)) continue;  // such as a slosh particle
    const Vector3d moment = pose.dcm_WL * link.first_moment;
    center.r_CB_B += moment;
    center.v_CB_B += rate.omega_LN_W.cross(moment);
  }
  center.r_CB_B /= center.mass;
  center.v_CB_B /= center.mass;
  return center;
}

Totals sum_up(const Motion& motion, const Elements& elements, const Tree& tree,
              std::span<const double> rotor_speed) {
  Totals totals;
  Vector3d momentum_B = Vector3d::Zero();
  for (const Elements::Placed& element : elements) {
    const MovingElement e = moving(element, motion);
    totals.mass += e.mass;
    totals.r_CB_B += e.mass * e.r_EB;
    momentum_B += e.mass * e.v_E;
  }
  totals.r_CB_B /= totals.mass;
  totals.v_CB_B = momentum_B / totals.mass;
  for (const Elements::Placed& element : elements) {
    const MovingElement e = moving(element, motion);
    const Vector3d v_EC = e.v_E - totals.v_CB_B;
    const Vector3d H = (e.r_EB - totals.r_CB_B).cross(e.mass * v_EC) + e.spin;
    totals.H_PntC_B += H;
    totals.H_scale += H.norm();
    totals.momentum_scale += e.mass * e.v_E.norm();
    totals.kinetic += 0.5 * e.mass * v_EC.squaredNorm() + e.spin_energy;
  }
  // The elements carry a wheel's whole tensor at the mount's rate; its own spin comes on top.
  for (std::size_t k = 0; k < tree.rotors.size(); ++k) {
    const RotorConstants& rotor = tree.rotors[k];
    const auto i = static_cast<std::size_t>(rotor.link);
    const Vector3d axis = motion.poses[i].dcm_WL * rotor.axis_L;
    const double spin = rotor.spin_inertia * rotor_speed[k];
    totals.H_PntC_B += spin * axis;
    totals.H_scale += std::abs(spin);
    totals.kinetic += spin * (axis.dot(motion.rates[i].omega_LN_W) + 0.5 * rotor_speed[k]);
  }
  return totals;
}

// All totals are sums over what a link carries, in proportion to its mass, but for the motion of C;
// and at fixed motion that drops out of H, because neither sum of m (r - r_C) nor of m (v - v_C) is
// anything.
Leaving sum_up_leaving(const Motion& motion, const Tree& tree, std::span<const double> share_rates,
                       const Center& center) {
  Leaving leaving;
  for (const Draining& draining : tree.draining) {
    double mass = 0.0;  // [kg/s]
    for (const Draining::Part& part : draining.parts)
      mass += share_rates[part.tank] * part.full.mass;
    const LinkPose& pose = motion.poses[draining.link];
    const LinkRate& rate = motion.rates[draining.link];
    const Vector3d r_LC = pose.r_LB_W - center.r_CB_B, v_LC = rate.v_LB_W - center.v_CB_B;
    leaving.mass += mass;
    leaving.momentum_B += mass * rate.v_LB_W;
    leaving.H_PntC_B += r_LC.cross(mass * v_LC);
    leaving.kinetic += 0.5 * mass * rate.v_LB_W.squaredNorm();
    if (!draining.is_point) add_extended(draining, pose, rate, share_rates, r_LC, v_LC, leaving);
  }
  return leaving;
}

void fill_books(const Totals& totals, const Matrix3d& dcm_NB, Observation& o) {
  o.mass = totals.mass;
  o.r_CN_N = o.r_BN_N + dcm_NB * totals.r_CB_B;
  o.v_CN_N = o.v_BN_N + dcm_NB * totals.v_CB_B;
  o.momentum = totals.mass * o.v_CN_N;
  o.H_PntC_N = dcm_NB * totals.H_PntC_B;
  o.kinetic = 0.5 * totals.mass * o.v_CN_N.squaredNorm() + totals.kinetic;
  o.own_kinetic = totals.kinetic;
  o.momentum_scale = totals.momentum_scale + totals.mass * o.v_BN_N.norm();
  o.H_scale = totals.H_scale;
}

double spring_energy(const Tree& tree, std::span<const double> q) {
  double energy = 0.0;
  for (std::size_t i = 1; i < tree.links.size(); ++i) {
    const double stretch = q[i - 1] - tree.links[i].rest;
    energy += 0.5 * tree.links[i].stiffness * stretch * stretch;
  }
  return energy;
}

double joint_power(const Tree& tree, std::span<const double> q, std::span<const double> q_dot,
                   std::span<const double> effort) {
  double power = 0.0;
  for (std::size_t i = 1; i < tree.links.size(); ++i) {
    power += (effort[i - 1] - damping_of(tree.links[i], q) * q_dot[i - 1]) * q_dot[i - 1];
  }
  return power;
}

double motor_power(std::span<const double> rotor_speed, std::span<const double> torque) {
  double power = 0.0;
  for (std::size_t k = 0; k < torque.size(); ++k) power += torque[k] * rotor_speed[k];
  return power;
}

Eigen::MatrixXd dense_mass_matrix(const Tree& tree, const Motion& motion, const Matrix3d& dcm_NB) {
  const auto links = static_cast<Eigen::Index>(tree.links.size());
  const auto rotors = static_cast<Eigen::Index>(tree.rotors.size());
  const Eigen::Index n = 5 + links + rotors;
  using Partial = Eigen::Matrix<double, 3, Eigen::Dynamic>;

  // Partial velocities of every link in hub axes: columns v_B, omega, joints, wheels.
  std::vector<Partial> omega(tree.links.size(), Partial::Zero(3, n));
  std::vector<Partial> v(tree.links.size(), Partial::Zero(3, n));
  v.front().leftCols<3>() = dcm_NB.transpose();
  omega.front().middleCols<3>(3).setIdentity();
  for (Eigen::Index i = 1; i < links; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const LinkConstants& link = tree.links[k];
    const auto p = static_cast<std::size_t>(link.parent);
    const Vector3d d = motion.poses[k].r_LB_W - motion.poses[p].r_LB_W;
    const Vector3d axis = motion.poses[p].dcm_WL * link.axis_P;
    omega[k] = omega[p];
    v[k] = v[p] - tilde(d) * omega[p];
    (link.kind == JointKind::kHinge ? omega : v)[k].col(5 + i) += axis;
  }

  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const LinkConstants& link = tree.links[i];
    const Matrix3d& dcm = motion.poses[i].dcm_WL;
    const Eigen::MatrixXd coupling = omega[i].transpose() * tilde(dcm * link.first_moment) * v[i];
    M += link.mass * v[i].transpose() * v[i] + coupling + coupling.transpose() +
         omega[i].transpose() * (dcm * link.J_L * dcm.transpose()) * omega[i];
  }
  for (Eigen::Index k = 0; k < rotors; ++k) {
    const RotorConstants& rotor = tree.rotors[static_cast<std::size_t>(k)];
    const auto i = static_cast<std::size_t>(rotor.link);
    Eigen::RowVectorXd spin = (motion.poses[i].dcm_WL * rotor.axis_L).transpose() * omega[i];
    spin[5 + links + k] += 1.0;
    M += rotor.spin_inertia * spin.transpose() * spin;
  }
  return M;
}

}  // namespace twincraft::bsm
