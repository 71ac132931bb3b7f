// Chains whose hinges are all parallel, such as every solar array: the recursion in the plane.
//
// In chain axes C = (x, s, z), fixed in the mount with s along the hinges, a link that is balanced
// about the plane (centre of mass in it, s a principal axis) moves as follows. Its in-plane
// acceleration and its spin about s know nothing of the rest, and eliminating the joint leaves a
// 2x2 mass instead of a 6x6 one:
//     tau = J alpha + h.a + tau0,  f = h alpha + M a + f0       about the link's own hinge
//     tau = u  gives  alpha = (u - tau0 - h.a) / J              (total spin: no parent in it)
// so the parent feels the torque u and the force (M - h h^T / J) a + f0 + h (u - tau0) / J. What is
// left, the force along s and the torques in the plane, is that of the locked chain and is summed,
// not eliminated. One chain is an effector of its mount with a law as in recursion.h.
//
// In-plane vectors are (x, z). Turning by Theta about s: (c x + s z, -s x + c z); s cross v is
// perp(v) = (v_z, -v_x). Angles and rates of links are absolute in the mount: Theta, ThetaDot;
// nu = omega_s + ThetaDot.
// Tested by tests/runtime/bsm_test.cpp (against the general recursion and the dense oracle).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/bsm/law.h"
#include "runtime/bsm/tree.h"
#include "runtime/forces/forces.h"

namespace twincraft::bsm {

using Vector2d = Eigen::Vector2d;

class PlanarChain {
 public:
  /// The whole subtree from link `first` on as a planar chain, if it is one: each link the only
  /// child of the one before, hinges parallel, everything balanced about their plane, no rotors,
  /// masses and dampings constant.
  static std::optional<PlanarChain> from(const Tree& tree, std::size_t first);

  std::size_t first() const { return first_; }
  std::size_t size() const { return links_.size(); }
  std::size_t mount() const { return mount_; }
  const Vector3d& r_HP_P() const { return r_HP_P_; }  // [m] root hinge, mount axes
  const Matrix3d& dcm_PC() const { return dcm_PC_; }  // chain to mount axes

  /// @param q, q_dot  of this chain's joints; omega_P_C [rad/s] of the mount, in chain axes
  void move(std::span<const double> q, std::span<const double> q_dot, const Vector3d& omega_P_C);

  /// The chain's law about its root hinge, in axes W. @param wrenches_C one per link about the root
  /// hinge, in chain axes; empty: none
  Law law(std::span<const double> q, std::span<const double> q_dot, std::span<const double> effort,
          std::span<const Wrench> wrenches_C, const Matrix3d& dcm_WC);

  /// Joint accelerations from the mount's: alpha_s about s [rad/s^2], and that of the root hinge,
  /// biases included, in chain axes [m/s^2].
  void recover(double alpha_s, const Vector3d& a_H_C, std::span<double> q_ddot) const;

  /// Where the links are, from the root hinge and in chain axes; for forces and observations.
  void place(std::span<LinkPose> poses_C) const;

 private:
  struct Plane {  // symmetric 2x2 in (x, z)
    double xx = 0.0, zz = 0.0, xz = 0.0;
    Vector2d operator*(const Vector2d& v) const {
      return {xx * v[0] + xz * v[1], xz * v[0] + zz * v[1]};
    }
    Sym3 in_axes(const Vector3d& x, const Vector3d& z) const {
      return Sym3::from_parallel(xx * x + xz * z, x) + Sym3::from_parallel(xz * x + zz * z, z);
    }
  };
  struct LinkConstants {
    double mass;
    Vector2d first_moment;  // [kg m] from the hinge, link at Theta = 0
    Vector2d next;          // [m] to the next hinge
    Plane G;                // [kg m^2] in-plane inertia about the hinge
    double J;               // [kg m^2] about s through the hinge
    double stiffness, damping, rest;
    Matrix3d dcm_CL;  // link to chain axes at Theta = 0
  };
  struct LinkMotion {
    double cosine, sine;  // of Theta
    double nu, theta_dot;
    Vector2d b, d;    // first moment and next hinge, turned
    Vector2d r;       // [m] hinge from the root hinge
    Vector2d d_bias;  // in-plane bias acceleration across d
    double a_s;       // bias acceleration of the hinge along s
    Plane G;
  };
  /// alpha = gain - gain_f . a
  struct Recovery {
    double gain;
    Vector2d gain_f;
  };

  static Vector2d perp(const Vector2d& v) { return {v[1], -v[0]}; }
  static Plane turned(const Plane& G, double c, double s);

  std::size_t first_ = 0, mount_ = 0;
  Vector3d r_HP_P_ = Vector3d::Zero();
  Matrix3d dcm_PC_ = Matrix3d::Identity();
  std::vector<LinkConstants> links_;
  std::vector<LinkMotion> motions_;
  std::vector<Recovery> recoveries_;
  Vector2d omega_ = Vector2d::Zero();  // in-plane rate of the mount
  Plane W_;                            // omega omega^T - omega^2 1
};

}  // namespace twincraft::bsm
