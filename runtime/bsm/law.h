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
//   hub           solve 6x6: Schur complement of M, two 3x3 blocks                 (hub_equation.h)
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

  static constexpr int kNumbers = 6 + 6 + 9 + 3 + 3;

  /// Add a child's law, or begin with it where it is the first. It moves from the child's origin to
  /// the parent's, d away: a' = a_P + omegaDot_P x d and n_P = n + d x f give H_P = H + d~ M and
  /// J_P = J + Z + Z^T with Z^T = (H + H_P) / 2 d~^T, here column by column of H. Inlined, or the
  /// child's law would pass through memory.
  template <bool kIsFirst>
  [[gnu::always_inline]] void take(const Law& child, const Vec<S>& d) {
    const auto put = [](auto& to, const auto& value) {
      if constexpr (kIsFirst)
        to = value;
      else
        to += value;
    };
    put(f0, child.f0);
    put(n0, plus_cross(child.n0, d, child.f0));
    put(M, child.M);
    const Vec<S> half = S(0.5) * d;
    Sym<S> j = child.J;
    Vec<S> column = plus_cross(child.H.x, d, child.M.column_x());
    Vec<S> both = child.H.x + column;
    put(H.x, column);
    j.yy = j.yy + d.z * both.y;
    j.zz = j.zz - d.y * both.z;
    j.xy = j.xy + half.z * both.x;
    j.xz = j.xz - half.y * both.x;
    j.yz = j.yz + half.z * both.z - half.y * both.y;
    column = plus_cross(child.H.y, d, child.M.column_y());
    both = child.H.y + column;
    put(H.y, column);
    j.xx = j.xx - d.z * both.x;
    j.zz = j.zz + d.x * both.z;
    j.xy = j.xy - half.z * both.y;
    j.xz = j.xz + half.x * both.x - half.z * both.z;
    j.yz = j.yz + half.x * both.y;
    column = plus_cross(child.H.z, d, child.M.column_z());
    both = child.H.z + column;
    put(H.z, column);
    j.xx = j.xx + d.y * both.x;
    j.yy = j.yy - d.x * both.y;
    j.xy = j.xy + half.y * both.y - half.x * both.x;
    j.xz = j.xz + half.y * both.z;
    j.yz = j.yz - half.x * both.z;
    put(J, j);
  }

  /// Add those in the lanes of another, which are about the same origin: see gathered(). Two
  /// neighbours at once: half of the loads and stores.
  template <bool kIsFull, class Lanes>
  void add_gathered(const Law<Lanes>& law) {
    S* to = numbers();
    const Lanes* from = law.numbers();
    constexpr int kLast = kNumbers - 1;
    static_assert(kLast % 2 == 0);
#pragma GCC unroll 16
    for (int i = 0; i < kLast; i += 2) add_two_gathered<kIsFull>(to + i, from[i], from[i + 1]);
    to[kLast] += gathered<S, Lanes>(from[kLast], kIsFull);
  }

 private:
  template <KernelScalar>
  friend struct Law;

  /// All of them, one after another.
  S* numbers() { return &J.xx; }
  const S* numbers() const { return &J.xx; }
};
static_assert(sizeof(Law<double>) == Law<double>::kNumbers * sizeof(double));

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
