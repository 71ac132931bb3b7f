// Back-substitution as a recursion over the tree: every body is the hub of its children.
//
// All vectors are in hub axes. For each link, about its own origin (its joint H), the force f and
// torque n that its parent must supply are linear in the accelerations of that point:
//     n = J omegaDot + H  a + n0          [J H; H^T M] symmetric, 6x6
//     f = H^T omegaDot + M a + f0
// For a bare rigid link J is its inertia about H, H = m c~, M = m 1, and
//     n0 = omega x (J omega + h) + u_rotors,  f0 = omega x (omega x m c)
// with h the momentum of its rotors (gyrostat).
//
//   leaf -> hub   eliminate the joint's own acceleration from s.n = u (hinge) or s.f = u (slide),
//                 move what is left to the parent's origin, add it to the parent      (limb.h)
//   hub           solve 6x6: Schur complement of M, two 3x3 blocks                 (vehicle.h)
//   hub -> leaf   each joint recovers its acceleration from its parent's
//
// One effector on the hub gives the published contributions A, B, C, D, vT, vR. Tails of the tree
// whose hinges are parallel take the same steps in the plane (chain.h). Rates enter only through
// omega and offsets between neighbouring joints, so neither the orbital velocity nor the distance
// to the hub ever costs a digit. Gravity is felt in a frame that falls with the hub
// (runtime/forces/field.h). Tested by tests/runtime/bsm_test.cpp (dense oracle, published blocks).
#pragma once

#include "runtime/scalar/linear.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

using namespace ::twincraft::TWINCRAFT_KERNEL;

/// The force and torque a subtree asks of its parent, about its origin.
///   n = J omegaDot + H a + n0,  f = H^T omegaDot + M a + f0
template <KernelScalar S>
struct Law {
  Sym<S> J, M;    // [kg m^2], [kg]
  Mat<S> H;       // [kg m]
  Vec<S> n0, f0;  // [N m], [N]

  /// The same about the parent's origin, d away.
  Law moved(const Vec<S>& d) const {
    const Arm arm = arm_of(d);
    Law law{J, M, {H.x + arm.K.x, H.y + arm.K.y, H.z + arm.K.z}, n0 + arm.n, f0};
    law.J.add_twice_symmetric(arm.Z_T);
    return law;
  }

  /// Add a child's law, moved to the parent's origin, d away.
  void add_moved(const Law& child, const Vec<S>& d) {
    const Arm arm = child.arm_of(d);
    J += child.J;
    J.add_twice_symmetric(arm.Z_T);
    H += child.H;
    H += arm.K;
    M += child.M;
    n0 += child.n0 + arm.n;
    f0 += child.f0;
  }
  Law& operator+=(const Law& o) {
    J += o.J;
    H += o.H;
    M += o.M;
    n0 += o.n0;
    f0 += o.f0;
    return *this;
  }

 private:
  /// What moving by d adds: a' = a_P + omegaDot_P x d and n_P = n + d x f give H_P = H + K with
  /// K = d~ M, and J_P = J + Z + Z^T with Z^T = (H + K / 2) d~^T.
  struct Arm {
    Mat<S> K, Z_T;
    Vec<S> n;
  };
  Arm arm_of(const Vec<S>& d) const {
    const Mat<S> K{cross(d, M.column_x()), cross(d, M.column_y()), cross(d, M.column_z())};
    Mat<S> G = K;
    G.x = H.x + S(0.5) * K.x;
    G.y = H.y + S(0.5) * K.y;
    G.z = H.z + S(0.5) * K.z;
    return {K, {cross(d, G.row_x()), cross(d, G.row_y()), cross(d, G.row_z())}, cross(d, f0)};
  }
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
