// What a component may add to the model. Each call adds to both halves at once, so that no
// component can forget one; the ledger entries and names pass through here and nowhere else.
//
// Wheels are where the halves differ. The analytic half carries a wheel's mass and tensor on its
// mount. MuJoCo needs a body with a mass, so the tree gives the wheel its own tensor and a token
// mass. The mount carries all the mass that the spec gives mount and wheel, less the token, so that
// mount and wheel together are the spec's vehicle exactly. A spinning mass m at a distance r from
// the vehicle's centre of mass would round as m r^2 Omega^2 in MuJoCo; a token does not. The token
// sits at the mount's centre of mass: its place plays no part in the motion, and taking it out
// there moves neither the mount's centre of mass nor its principal axes, by amounts that MuJoCo 3
// would ignore. Only with `compensate: false` is the token of a massless wheel on top, in its
// place. For gravity a massless wheel's tensor adds to the first element of its mount in both
// halves: mount and massless wheel are one rigid body. A wheel with mass is an element of its own.
//
// Fixed bodies are the other difference. The analytic half knows none: what is put on one is put on
// the link that carries it, in that link's axes. The tree welds a body of its own.
// Tested by tests/compiler/model_builder_test.cpp.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compiler/ir/model.h"

namespace twincraft {

/// A place for components: a body of the tree and the link that carries it in the assembly. What is
/// added there is given in the body's axes, which are the link's unless the body is fixed on it.
struct Mount {
  int link = 0;
  int body = 0;
  Matrix3d dcm_LM = Matrix3d::Identity();  // body to link components
  Vector3d r_ML_L = Vector3d::Zero();      // [m] the body's origin from the link's

  /// A point given in the body's axes [m], from the link's origin in the link's.
  Vector3d point_on_link(const Vector3d& r_PM_M) const { return r_ML_L + dcm_LM * r_PM_M; }
};

/// Bodies nested below the hub that MuJoCo's XML reader still loads: tinyxml2 stops at an element
/// depth of 100, and mujoco, worldbody, hub and the last body's joint take the others.
inline constexpr int kMaximumTreeDepth = 95;
/// Joints and wheels that MuJoCo's XML reader still loads: a keyframe has at most 1000 numbers of
/// position, and the hub has seven.
inline constexpr int kMaximumTreeCoordinates = 993;

class ModelBuilder {
 public:
  explicit ModelBuilder(EngineControls controls);

  /// The hub; called once, first.
  void add_hub();

  /// A link on a joint, in both halves. The joint's name is the link's.
  Mount add_link(const Mount& parent, const std::string& name, const Joint& joint);

  /// A spherical pendulum: two hinges that share an origin. The first link has no mass, and its
  /// damping is that of linear drag on the bob; the second carries the bob. The tree has one body
  /// `name` with both joints, whose dampings are those of small angles.
  struct Pendulum {
    int phi_link = 0;
    Mount bob;
  };
  Pendulum add_pendulum(const Mount& parent, const std::string& name, const Joint& phi,
                        const Joint& theta);

  /// A body without a coordinate, in both halves. Its origin is at `r_MP_P` [m] in its parent's
  /// axes; `dcm_PM` takes its components to its parent's.
  Mount add_fixed_body(const Mount& parent, const std::string& name, const Vector3d& r_MP_P,
                       const Matrix3d& dcm_PM);

  /// Where a named component can be mounted on. @pre a link or fixed body of that name was added
  Mount find_mount(const std::string& name) const;

  /// Put mass on a mount, in both halves. @pre the mount's first element has a positive mass
  void add_mass(const Mount& mount, const MassElement& element);

  /// Say what the body of a mount looks like, where its component knows.
  void draw(const Mount& mount, const Look& look);

  /// Give the tree body of a mount an inertia [kg m^2] that the analytic half does not have.
  void add_token_inertia(const Mount& mount, double inertia);

  /// @return its index, for MassElement::tank
  int add_tank(Tank tank);
  /// @pre a tank of that name was added
  int find_tank(const std::string& name) const;

  const EngineControls& controls() const { return model_.engines; }

  /// A balanced wheel: gyrostat of its mount here, a body with a hinge there. `element` is the
  /// wheel's mass (zero: counted in the mount's), place and tensor in mount axes; `rotor.link` is
  /// set here.
  /// @pre the mount has mass of its own. @return the index of the rotor
  int add_wheel(const Mount& mount, const Rotor& rotor, const MassElement& element);

  /// @param index     the link of a joint coordinate, the rotor of a wheel
  /// @param position  initial [rad] or [m]; a wheel has none
  /// @param rate      initial [rad/s] or [m/s]
  void add_coordinate(Coordinate::Kind kind, const std::string& name, int index, double position,
                      double rate);
  /// `load` says what it is in the mount's axes, about its origin; what it is on its link is set
  /// here.
  void add_load(const Mount& mount, Load load);
  /// `nozzle.r_PL_L` is in the mount's axes, from its origin; `nozzle.link` is set here. Left out
  /// where the propellant of its tank takes no momentum along. @pre the tank was added
  /// @return its index; -1: left out
  int add_nozzle(const Mount& mount, Nozzle nozzle);

  /// Forces that follow the motion of links: a component adds its own, in link axes.
  Forces& forces() { return model_.forces; }

  /// Everything collected, with the tree's inertials formed from the ledger.
  Model build() &&;

 private:
  struct CarriedWheel {
    Mount mount;
    MassElement element;
    int body = 0;  // of the tree
    bool massless() const { return element.mass == 0.0; }
  };

  /// A massless wheel whose token is not taken out of the mount.
  bool is_on_top(const CarriedWheel& wheel) const;
  void form_inertials();
  void form_streams();
  void take_tokens_out();
  void carry_wheel_tensors();
  void refuse_deep_chains();
  void refuse_many_coordinates();

  Model model_;
  std::map<std::string, Mount> mounts_;
  std::vector<CarriedWheel> wheels_;  // in the order of the tree's
};

}  // namespace twincraft
