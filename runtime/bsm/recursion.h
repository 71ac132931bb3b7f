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
//                 move what is left to the parent's origin, add it to the parent
//   hub           solve 6x6: Schur complement of M, two 3x3 blocks
//   hub -> leaf   each joint recovers its acceleration from its parent's
//
// One effector on the hub gives the published contributions A, B, C, D, vT, vR. Tails of the tree
// whose hinges are parallel take the same steps in the plane (planar_chain.h). Rates enter only
// through omega and offsets between neighbouring joints, so neither the orbital velocity nor the
// distance to the hub ever costs a digit. Tested by tests/runtime/bsm_test.cpp (dense oracle,
// published blocks).
#pragma once

#include <span>
#include <vector>

#include "runtime/bsm/planar_chain.h"
#include "runtime/forces/forces.h"

namespace twincraft::bsm {

/// What acts on the vehicle during an evaluation.
struct Inputs {
  std::span<const double> effort;        // [N m] or [N], one per link but the hub
  std::span<const double> motor_torque;  // [N m], one per rotor, on the rotor
};

/// Whether parallel-axis tails may take the planar path; the general one serves any tree.
enum class Chains { kPlanar, kGeneral };

class Recursion {
 public:
  explicit Recursion(const Assembly& assembly, Chains chains = Chains::kPlanar);

  /// Masses of what drains with the tanks, one share per tank, for the next move(). Full at first.
  void set_shares(std::span<const double> shares);

  /// Positions and rates of all links from q, qDot [rad, m] and omega_BN_B [rad/s].
  void move(std::span<const double> q, std::span<const double> q_dot, const Vector3d& omega_BN_B,
            std::span<const double> rotor_speed);

  /// Accelerations of the moved vehicle. Wrenches are about the hub origin B; an empty span: none.
  /// @param q_ddot [rad/s^2, m/s^2] and rotor_rate [rad/s^2] are written
  void accelerate(std::span<const double> q, std::span<const double> q_dot, const Inputs& inputs,
                  std::span<const Wrench> wrenches, std::span<double> q_ddot,
                  std::span<double> rotor_rate);

  const Vector3d& omega_dot_BN_B() const { return omega_dot_; }  // [rad/s^2]
  /// Inertial acceleration of B without what gravity gives the vehicle in common [m/s^2].
  const Vector3d& a_BN_B() const { return acceleration_; }

  const Tree& tree() const { return tree_; }
  /// How many links the planar path serves.
  std::size_t planar_links() const { return tree_.links.size() - 1 - singles_.size(); }
  /// Where the links are, after move(); planar chains are placed when first asked for.
  std::span<const LinkPose> poses();
  /// Rates in hub axes with the velocity of B taken as zero, after move(); a sweep of its own.
  void rates(std::span<const double> q_dot, std::span<LinkRate> rates);
  /// The hub's equation [A B; C D] (a, omegaDot) = (vT, vR) of the last accelerate(), as printed in
  /// the back-substitution papers, for comparison with their contribution blocks.
  struct HubEquation {
    Eigen::Matrix<double, 6, 6> matrix;
    Eigen::Matrix<double, 6, 1> right;
  };
  HubEquation hub_equation() const;

 private:
  struct Motion {
    Vector3d omega;           // [rad/s] inertial
    Vector3d axis;            // s, of the link's joint
    Vector3d r_HP;            // [m] link origin from its parent's
    Vector3d omega_bias;      // omegaDot = omegaDot_P + omega_bias + s qDDot (hinge)
    Vector3d a_bias;          // a = a_P + omegaDot_P x r_HP + a_bias + s qDDot (slide)
    Vector3d rotor_momentum;  // h [kg m^2/s]
    Vector3d moment;          // m c [kg m]
    Sym3 J;                   // bare link, about its origin
  };
  /// qDDot = gain - gain_n . omegaDot_P - gain_f . a', a' the parent's acceleration at the joint.
  struct Recovery {
    double gain;
    Vector3d gain_n, gain_f;
  };

  /// A chain and how it hangs on its mount, in hub axes.
  struct Tail {
    PlanarChain chain;
    Matrix3d dcm_WC;
    Vector3d r_HP;    // [m] root hinge from the mount's origin
    Vector3d a_bias;  // [m/s^2] of the root hinge
  };
  /// The hub equation's matrix, factored: Schur complement of M.
  struct HubFactors {
    explicit HubFactors(const Law& hub);
    Ldl3 M;
    Matrix3d coupling;  // M^-1 H^T
    Ldl3 schur;
  };

  void find_chains();
  void move_link(std::size_t i, double q, double q_dot);
  void hang(Tail& tail, std::span<const double> q, std::span<const double> q_dot);
  void add_rotor_momentum(std::span<const double> rotor_speed);
  void begin_law(std::size_t i);
  void apply(std::span<const Wrench> wrenches);
  void contribute(Tail& tail, std::span<const double> q, std::span<const double> q_dot,
                  std::span<const double> effort, std::span<const Wrench> wrenches);
  void eliminate(std::size_t i, double effort);
  static void hand_over(const Law& law, const Vector3d& d, Law& parent);
  void solve_hub(const HubFactors& factors);
  double recover(std::size_t i);
  void recover(const Tail& tail, std::span<double> q_ddot) const;

  Tree tree_;
  std::vector<std::size_t> singles_;  // links but the hub that are in no chain, in preorder
  std::vector<Tail> tails_;
  std::optional<HubFactors> rigid_hub_;  // of a vehicle without joints: factored once
  bool placed_ = false;                  // poses_ of the chains are up to date
  std::vector<LinkPose> poses_;
  std::vector<Motion> motions_;
  std::vector<Law> laws_;
  std::vector<Recovery> recoveries_;
  std::vector<Vector3d> omega_dots_, accelerations_;  // per link, of its origin
  std::vector<Wrench> chain_wrenches_;
  Vector3d omega_dot_, acceleration_;
};

}  // namespace twincraft::bsm
