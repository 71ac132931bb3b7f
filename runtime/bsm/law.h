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
//                 move what is left to the parent's origin, where it is added       (limb.h)
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

  Law& operator+=(const Law& o) {
    J += o.J;
    M += o.M;
    H += o.H;
    n0 += o.n0;
    f0 += o.f0;
    return *this;
  }
  /// Move it from a child's origin to the parent's, d away: a' = a_P + omegaDot_P x d and
  /// n_P = n + d x f give H_P = H + d~ M and J_P = J + Z + Z^T with Z^T = (H + H_P) / 2 d~^T.
  [[gnu::always_inline]] void move(const Vec<S>& d) {
    Mat<S> both = H;  // H + H_P
    H = {plus_cross(H.x, d, M.column_x()), plus_cross(H.y, d, M.column_y()),
         plus_cross(H.z, d, M.column_z())};
    both += H;
    const Vec<S> half = S(0.5) * d;
    J.xx = J.xx + d.y * both.z.x - d.z * both.y.x;
    J.yy = J.yy + d.z * both.x.y - d.x * both.z.y;
    J.zz = J.zz + d.x * both.y.z - d.y * both.x.z;
    J.xy = J.xy + half.y * both.z.y - half.z * both.y.y + half.z * both.x.x - half.x * both.z.x;
    J.xz = J.xz + half.y * both.z.z - half.z * both.y.z + half.x * both.y.x - half.y * both.x.x;
    J.yz = J.yz + half.z * both.x.z - half.x * both.z.z + half.x * both.y.y - half.y * both.x.y;
    n0 = plus_cross(n0, d, f0);
  }
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
