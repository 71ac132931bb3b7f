// See dense_oracle.h.
#include "tests/support/dense_oracle.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace twincraft::test {
namespace {

using Partial = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Kinematics of one link: pose, rate, partial rates, and accelerations at zero qDDot.
struct LinkKinematics {
  Matrix3d dcm_BL = Matrix3d::Identity();
  Vector3d omega = Vector3d::Zero(), alpha0 = Vector3d::Zero(), a0 = Vector3d::Zero();
  Vector3d s = Vector3d::Zero();
  Partial d_omega, d_v;
};

LinkKinematics moved(const LinkKinematics& parent, const Joint& joint, double q, double q_dot,
                     Eigen::Index column) {
  LinkKinematics link = parent;
  link.s = parent.dcm_BL * joint.dcm_PL0 * joint.axis_L;
  Vector3d d = parent.dcm_BL * joint.r_HP_P;
  link.dcm_BL = parent.dcm_BL * joint.dcm_PL0;
  if (joint.kind == JointKind::kHinge) {
    link.dcm_BL = link.dcm_BL * Eigen::AngleAxisd(q, joint.axis_L).toRotationMatrix();
    link.omega += q_dot * link.s;
    link.alpha0 += parent.omega.cross(q_dot * link.s);
    link.d_omega.col(column) += link.s;
  } else {
    d += q * link.s;
    link.a0 += 2.0 * parent.omega.cross(q_dot * link.s);
    link.d_v.col(column) += link.s;
  }
  link.d_v -= tilde(d) * parent.d_omega;
  link.a0 += parent.alpha0.cross(d) + parent.omega.cross(parent.omega.cross(d));
  return link;
}

}  // namespace

Eigen::VectorXd dense_accelerations(const Assembly& assembly, const OracleState& state,
                                    const std::vector<Vector3d>& force_L,
                                    const std::vector<Vector3d>& torque_L) {
  const auto links = static_cast<Eigen::Index>(assembly.links.size());
  const Eigen::Index n = 5 + links + static_cast<Eigen::Index>(assembly.rotors.size());
  std::vector<LinkKinematics> kinematics(assembly.links.size());
  kinematics[0].omega = state.omega_BN_B;
  kinematics[0].d_omega = Partial::Zero(3, n);
  kinematics[0].d_v = Partial::Zero(3, n);
  kinematics[0].d_v.leftCols<3>().setIdentity();
  kinematics[0].d_omega.middleCols<3>(3).setIdentity();

  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd Q = Eigen::VectorXd::Zero(n);
  for (std::size_t i = 0; i < assembly.links.size(); ++i) {
    const Link& link = assembly.links[i];
    if (i > 0) {
      const double q = state.q[i - 1];
      const double q_dot = state.q_dot[i - 1];
      kinematics[i] = moved(kinematics[static_cast<std::size_t>(link.parent)], link.joint, q, q_dot,
                            5 + static_cast<Eigen::Index>(i));
      Q[5 + static_cast<Eigen::Index>(i)] += link.joint.effort.at(0.0) -
                                             link.joint.stiffness * (q - link.joint.rest) -
                                             link.joint.damping * q_dot;
    }
    const LinkKinematics& k = kinematics[i];
    Q += k.d_v.transpose() * (k.dcm_BL * force_L[i]) +
         k.d_omega.transpose() * (k.dcm_BL * torque_L[i]);
    for (const MassElement& e : link.elements) {
      const Vector3d r = k.dcm_BL * e.r_EL_L;
      const Matrix3d I = k.dcm_BL * e.I_PntE_L * k.dcm_BL.transpose();
      const Partial d_v = k.d_v - tilde(r) * k.d_omega;
      const Vector3d a0 = k.a0 + k.alpha0.cross(r) + k.omega.cross(k.omega.cross(r));
      M += e.mass * d_v.transpose() * d_v + k.d_omega.transpose() * I * k.d_omega;
      Q -= d_v.transpose() * (e.mass * a0) +
           k.d_omega.transpose() * (I * k.alpha0 + k.omega.cross(I * k.omega));
    }
  }
  for (std::size_t r = 0; r < assembly.rotors.size(); ++r) {
    const Rotor& rotor = assembly.rotors[r];
    const LinkKinematics& k = kinematics[static_cast<std::size_t>(rotor.link)];
    const Vector3d axis = k.dcm_BL * rotor.axis_L;
    const Eigen::Index column = 5 + links + static_cast<Eigen::Index>(r);
    // The mount's tensor already turns with the mount; the spin adds Js (OmegaDot g + omega x
    // Omega g) there and the row of the wheel itself.
    const Eigen::VectorXd along = k.d_omega.transpose() * axis;
    M.col(column) += rotor.spin_inertia * along;
    M.row(column) += rotor.spin_inertia * along.transpose();
    M(column, column) += rotor.spin_inertia;
    const Vector3d h = rotor.spin_inertia * state.rotor_speed[r] * axis;
    Q -= k.d_omega.transpose() * k.omega.cross(h);
    Q[column] += rotor.torque.at(0.0) - rotor.spin_inertia * axis.dot(k.alpha0);
  }
  return M.ldlt().solve(Q);
}

Vector3d random_vector(std::mt19937_64& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  return {uniform(random), uniform(random), uniform(random)};
}

namespace {

Matrix3d random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

MassElement random_element(std::mt19937_64& random, double mass) {
  std::uniform_real_distribution<double> uniform(0.5, 1.0);
  const Vector3d moments(uniform(random), uniform(random), uniform(random));
  const Matrix3d R = random_rotation(random);
  return {"element", mass * uniform(random), random_vector(random, 1.0),
          mass * R * moments.asDiagonal() * R.transpose()};
}

}  // namespace

Assembly random_assembly(std::mt19937_64& random, int joints, int rotors) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Assembly assembly;
  assembly.links.push_back({"hub", -1, {}, {random_element(random, 50.0)}});
  for (int i = 1; i <= joints; ++i) {
    Link link;
    link.parent = static_cast<int>(random() % static_cast<unsigned>(i));
    link.joint.kind = random() % 3 == 0 ? JointKind::kSlide : JointKind::kHinge;
    link.joint.r_HP_P = random_vector(random, 1.0);
    link.joint.dcm_PL0 = random_rotation(random);
    link.joint.axis_L = random_vector(random, 1.0).normalized();
    link.joint.stiffness = 10.0 * uniform(random);
    link.joint.damping = uniform(random);
    link.joint.rest = 0.1 * uniform(random);
    link.joint.effort = Schedule::constant(uniform(random));
    link.elements = {random_element(random, 5.0), random_element(random, 2.0)};
    assembly.links.push_back(link);
  }
  for (int k = 0; k < rotors; ++k) {
    const auto mount = static_cast<int>(random() % assembly.links.size());
    const Vector3d axis = random_vector(random, 1.0).normalized();
    const double Js = 0.1 + 0.1 * uniform(random);
    const Matrix3d I =
        Js * axis * axis.transpose() + 0.6 * Js * (Matrix3d::Identity() - axis * axis.transpose());
    assembly.links[static_cast<std::size_t>(mount)].elements.push_back(
        {"wheel", 0.0, Vector3d::Zero(), I});
    assembly.rotors.push_back({"wheel", mount, axis, Js, Schedule::constant(uniform(random))});
  }
  return assembly;
}

OracleState random_state(std::mt19937_64& random, const Assembly& assembly) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  OracleState state{random_vector(random, 0.5), {}, {}, {}};
  for (std::size_t i = 1; i < assembly.links.size(); ++i) {
    state.q.push_back(uniform(random));
    state.q_dot.push_back(uniform(random));
  }
  for (std::size_t k = 0; k < assembly.rotors.size(); ++k) {
    state.rotor_speed.push_back(100.0 * uniform(random));
  }
  return state;
}

}  // namespace twincraft::test
