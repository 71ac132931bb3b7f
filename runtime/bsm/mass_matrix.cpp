// See mass_matrix.h. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/mass_matrix.h"

namespace twincraft::bsm {

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
