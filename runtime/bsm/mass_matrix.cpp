// See mass_matrix.h. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/mass_matrix.h"

namespace twincraft::bsm {

namespace {

/// How a link moves with each coordinate that moves it: the hub's six, its ancestors' joints and
/// its own, in hub axes. The others' columns would be zero.
struct Partials {
  std::vector<Eigen::Index> columns;  // of the mass matrix
  Eigen::Matrix3Xd omega, v;          // a column for each of them
};

Partials of_hub(const Matrix3d& dcm_NB) {
  Partials hub{{0, 1, 2, 3, 4, 5}, Eigen::Matrix3Xd::Zero(3, 6), Eigen::Matrix3Xd::Zero(3, 6)};
  hub.v.leftCols<3>() = dcm_NB.transpose();
  hub.omega.rightCols<3>().setIdentity();
  return hub;
}

/// @param column  the link's own joint
Partials of_link(const Partials& parent, Eigen::Index column, JointKind kind, const Vector3d& axis,
                 const Vector3d& r_LP) {
  const Eigen::Index inherited = parent.omega.cols();
  Partials link{parent.columns, Eigen::Matrix3Xd::Zero(3, inherited + 1),
                Eigen::Matrix3Xd::Zero(3, inherited + 1)};
  link.columns.push_back(column);
  link.omega.leftCols(inherited) = parent.omega;
  link.v.leftCols(inherited) = parent.v - tilde(r_LP) * parent.omega;
  (kind == JointKind::kHinge ? link.omega : link.v).col(inherited) = axis;
  return link;
}

/// As many as links, the hub first.
std::vector<Partials> partials_of(const Tree& tree, const Motion& motion, const Matrix3d& dcm_NB) {
  std::vector<Partials> all{of_hub(dcm_NB)};
  for (std::size_t i = 1; i < tree.links.size(); ++i) {
    const LinkConstants& link = tree.links[i];
    const auto p = static_cast<std::size_t>(link.parent);
    all.push_back(of_link(all[p], 5 + static_cast<Eigen::Index>(i), link.kind,
                          motion.poses[p].dcm_WL * link.axis_P,
                          motion.poses[i].r_LB_W - motion.poses[p].r_LB_W));
  }
  return all;
}

}  // namespace

Eigen::MatrixXd dense_mass_matrix(const Tree& tree, const Motion& motion, const Matrix3d& dcm_NB) {
  const auto links = static_cast<Eigen::Index>(tree.links.size());
  const auto rotors = static_cast<Eigen::Index>(tree.rotors.size());
  const Eigen::Index n = 5 + links + rotors;
  const std::vector<Partials> partials = partials_of(tree, motion, dcm_NB);

  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const LinkConstants& link = tree.links[i];
    const Matrix3d& dcm = motion.poses[i].dcm_WL;
    const auto& [columns, omega, v] = partials[i];
    const Eigen::MatrixXd coupling = omega.transpose() * tilde(dcm * link.first_moment) * v;
    M(columns, columns) += link.mass * v.transpose() * v + coupling + coupling.transpose() +
                           omega.transpose() * (dcm * link.J_L * dcm.transpose()) * omega;
  }
  for (Eigen::Index k = 0; k < rotors; ++k) {
    const RotorConstants& rotor = tree.rotors[static_cast<std::size_t>(k)];
    const auto i = static_cast<std::size_t>(rotor.link);
    const Eigen::RowVectorXd turn =
        (motion.poses[i].dcm_WL * rotor.axis_L).transpose() * partials[i].omega;
    std::vector<Eigen::Index> columns = partials[i].columns;
    columns.push_back(5 + links + k);
    Eigen::RowVectorXd spin(turn.size() + 1);
    spin << turn, 1.0;
    M(columns, columns) += rotor.spin_inertia * spin.transpose() * spin;
  }
  return M;
}

}  // namespace twincraft::bsm
