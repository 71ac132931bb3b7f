// Gravity and loads: one source for both engines. The engine says where its links are, in whatever
// axes W it works in (B for the analytic engine, N for MuJoCo); this room answers with a wrench on
// each link about the hub origin B.
//
// In the falling frame the hub's own gravitational acceleration g(r_B) is not applied as forces
// but returned, and the elements feel only the difference g(r_i) - g(r_B), evaluated without
// cancellation (Battin's form). A uniform field then leaves no rounding in the joints.
// Tested by tests/runtime/forces_test.cpp.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "compiler/ir/inputs.h"
#include "compiler/ir/model.h"
#include "runtime/forces/elements.h"

namespace twincraft {

struct LinkPose {
  Matrix3d dcm_WL;  // link to working axes
  Vector3d r_LB_W;  // [m] link origin from the hub origin
};

/// How a link moves, with the velocity of the hub origin B taken as zero: on orbit the difference
/// of two true velocities would lose four digits.
struct LinkRate {
  Vector3d omega_LN_W;  // [rad/s] inertial
  Vector3d v_LB_W;      // [m/s] of the link's origin, in axes that do not turn
};

struct Wrench {
  Vector3d force_W = Vector3d::Zero();        // [N]
  Vector3d torque_PntB_W = Vector3d::Zero();  // [N m]
};

/// What wrenches come to: their sum, and what they do to links that move like this [W].
struct WrenchSums {
  Wrench all;
  double power = 0.0;
};
WrenchSums sum_up(std::span<const Wrench> wrenches, std::span<const LinkPose> links,
                  std::span<const LinkRate> rates);

/// Of the part of some wrenches that has no potential: what it does to links that move as in
/// LinkRate, and the force that a common velocity adds the rest for.
struct Work {
  double power = 0.0;                         // [W]
  Vector3d force_W = Vector3d::Zero();        // [N]
  Vector3d torque_PntB_W = Vector3d::Zero();  // [N m]

  Work& operator+=(const Work& more) {
    power += more.power;
    force_W += more.force_W;
    torque_PntB_W += more.torque_PntB_W;
    return *this;
  }
};

enum class FieldFrame { kFalling, kInertial };

class ForceModel {
 public:
  /// @param elements  what gravity pulls on, per link; those without mass are left out
  ForceModel(const Model& model, GravityLaw law,
             const std::vector<std::vector<MassElement>>& elements, FieldFrame frame);

  void hold(const Inputs& inputs);

  /// Let elements of tanks have these parts of their mass and inertia; one share per tank.
  void set_shares(std::span<const double> shares);

  /// No link feels anything now: apply() leaves the wrenches as they are. Gravity may still make
  /// the vehicle fall as a whole.
  bool is_idle() const { return !gravity_acts_ && acting_loads_.empty(); }
  /// Nothing but loads at places of the hub: no other link is asked for, and in axes that turn with
  /// the hub their wrench is the same until the next hold().
  bool acts_on_hub_alone() const { return acts_on_hub_alone_; }

  /// Set the wrench of every link, unless idle.
  /// @param rates  of the links, for what is returned; empty: no work is asked for
  /// @return of loads and gravity-gradient torques
  Work apply(const Vector3d& r_BN_W, std::span<const LinkPose> links,
             std::span<const LinkRate> rates, std::span<Wrench> wrenches) const;

  /// The common acceleration [m/s^2] of the falling frame in N, to be added to the hub's; zero in
  /// the inertial frame or without gravity. In N because turning a vector of orbital size into W
  /// and back would cost its last digit.
  Vector3d fall(const Vector3d& r_BN_N, const Matrix3d& dcm_NW,
                std::span<const LinkPose> links) const;

  /// Of gravity [J]: -sum mu m/r; of the total mass at C for kSystemCom.
  double potential(const Vector3d& r_BN_W, std::span<const LinkPose> links) const;

  /// How fast potential() changes because elements of tanks lose mass [W].
  double potential_rate(const Vector3d& r_BN_W, std::span<const LinkPose> links,
                        std::span<const double> share_rates) const;

 private:
  using Element = Elements::Placed;
  struct HeldLoad {
    int link;
    bool pushes;  // has a force
    bool at_system_com;
    Vector3d force_L, torque_L, r_FL_L;
  };

  /// fall() depends on where the links are.
  bool falls_as_a_whole() const {
    return law_ == GravityLaw::kSystemCom && frame_ == FieldFrame::kFalling;
  }
  Vector3d center_of_mass(std::span<const LinkPose> links) const;               // r_CB_W
  static Vector3d place_of(const Element& e, std::span<const LinkPose> links);  // r_EB_W
  // @param rates  empty: no work is asked for
  void apply_gravity(const Vector3d& r_BN_W, std::span<const LinkPose> links,
                     std::span<const LinkRate> rates, std::span<Wrench> wrenches, Work& work) const;
  void apply_loads(std::span<const LinkPose> links, std::span<Wrench> wrenches) const;
  Work work_of_loads(std::span<const LinkPose> links, std::span<const LinkRate> rates) const;
  struct ActingLoad {
    Vector3d torque_W, force_W, r_FB_W;
  };
  ActingLoad acting(const HeldLoad& load, std::span<const LinkPose> links) const;

  double mu_;
  GravityLaw law_;
  FieldFrame frame_;
  bool gravity_acts_ = false;    // links feel more than the common fall
  bool needs_elements_ = false;  // gravity or a load at the centre of mass asks where they are
  Elements elements_;
  double mass_ = 0.0;
  std::vector<Load> loads_;
  std::vector<HeldLoad> acting_loads_;
  bool acts_on_hub_alone_ = false;
};

/// g(r) of a point mass [m/s^2].
inline Vector3d point_gravity(double mu, const Vector3d& r) {
  const double r2 = r.squaredNorm(), inverse_r2 = 1.0 / r2;
  // As in Field: the root and the quotient do not wait for each other.
  return r * (-(mu * inverse_r2 * inverse_r2) * std::sqrt(r2));
}

}  // namespace twincraft
