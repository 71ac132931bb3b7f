// See books.h. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/books.h"

namespace twincraft::bsm {
namespace {

using namespace TWINCRAFT_KERNEL;

MovingElement moving(const Elements::Placed& element, const Motion& motion) {
  const LinkPose& pose = motion.poses[element.link];
  const LinkRate& rate = motion.rates[element.link];
  const bool on_hub = element.link == 0;  // whose axes are the working axes
  const Vector3d r_EL = on_hub ? element.r_EL_L() : Vector3d(pose.dcm_WL * element.r_EL_L());
  const Vector3d v_E = rate.v_LB_W + rate.omega_LN_W.cross(r_EL);
  if (element.is_point) return {element.mass, pose.r_LB_W + r_EL, v_E, Vector3d::Zero(), 0.0};
  const Vector3d& omega = rate.omega_LN_W;
  const Matrix3d& dcm = pose.dcm_WL;
  const Vector3d omega_L = on_hub ? omega : Vector3d(dcm.transpose() * omega);
  const Vector3d spin_L = eigen(element.I * vec(omega_L));
  const Vector3d spin = on_hub ? spin_L : Vector3d(dcm * spin_L);
  return {element.mass, pose.r_LB_W + r_EL, v_E, spin, 0.5 * omega_L.dot(spin_L)};
}

}  // namespace

Totals sum_up(const Motion& motion, const Elements& elements, const Tree& tree,
              std::span<const double> rotor_speed, std::vector<MovingElement>& all) {
  Totals totals;
  Vector3d momentum_B = Vector3d::Zero();
  all.clear();
  for (const Elements::Placed& element : elements) {
    const MovingElement& e = all.emplace_back(moving(element, motion));
    totals.mass += e.mass;
    totals.r_CB_B += e.mass * e.r_EB;
    momentum_B += e.mass * e.v_E;
  }
  totals.r_CB_B /= totals.mass;
  totals.v_CB_B = momentum_B / totals.mass;
  for (const MovingElement& e : all) {
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
