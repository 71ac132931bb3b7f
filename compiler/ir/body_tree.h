// The MuJoCo half: the tree of bodies that is printed as MJCF, in MJCF's own terms. Bodies come in
// the order of the file, parents before children; bodies[0] is the hub and has the free joint.
// Tested by tests/compiler/model_builder_test.cpp and verify_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/ir/assembly.h"
#include "compiler/ir/mass.h"

namespace twincraft {

struct TreeJoint {
  std::string name;
  JointKind kind = JointKind::kHinge;
  Vector3d axis = Vector3d::UnitZ();  // body axes
  double stiffness = 0.0;
  double damping = 0.0;
  double springref = 0.0;
};

/// What a body looks like to someone; the dynamics do not know it.
struct Look {
  enum class Form { kBox, kSphere, kCylinder };
  enum class Part { kBody, kPanel, kTank, kSlosh };
  Form form = Form::kBox;
  Part part = Part::kBody;
  Vector3d half = Vector3d::Zero();            // [m] half sides; radius; radius and half length
  Vector3d pos = Vector3d::Zero();             // [m] its middle, body axes
  Quaterniond quat = Quaterniond::Identity();  // of the shape to the body; a cylinder is along z
};

struct TreeBody {
  std::string name;
  int parent = -1;
  // The link of the analytic half it stands for; of a welded body the link that carries it; of a
  // wheel -1.
  int link = -1;
  Vector3d pos = Vector3d::Zero();             // [m] in the parent's axes
  Quaterniond quat = Quaterniond::Identity();  // body to parent
  std::vector<TreeJoint> joints;               // none: welded. The hub's free joint is implied.
  MassProperties inertial;  // about its own centre of mass, body axes, as emitted
  int tank = -1;            // Model::tanks entry that scales the inertial; -1: it is fixed
  // [kg m^2] isotropic and counted in `inertial`: an inertia that MuJoCo is given and the analytic
  // half does not have. It scales with the mass.
  double token_inertia = 0.0;
  // What gravity pulls on: the ledger's elements on this body plus token masses that were added on
  // top. A token mass taken back out of its mount is no element.
  std::vector<MassElement> elements;
  // Nothing: the box that its inertia suggests.
  std::optional<Look> look = {};
};

/// A wheel of the tree: a body with one hinge whose motor torque is an input.
struct TreeWheel {
  std::string joint;  // also the motor's name
  int rotor = 0;      // index in Assembly::rotors
  int body = -1;      // index in BodyTree::bodies
  // [m] the wheel's centre in its mount's axes, where the wheel's body is a token that sits at the
  // mount's centre of mass; nothing: the body is at the wheel's centre.
  std::optional<Vector3d> center = {};
};

struct BodyTree {
  std::vector<TreeBody> bodies;
  std::vector<TreeWheel> wheels;
};

/// Where a body sits: on its own link, or fixed on the link that carries it. A wheel counts as
/// fixed: its centre stays in place and its tensor does not see its spin.
struct Seat {
  int link = 0;
  Matrix3d dcm_LS = Matrix3d::Identity();  // body to link components
  Vector3d r_SL_L = Vector3d::Zero();      // [m] the body's origin from the link's
};

/// One per body.
std::vector<Seat> seats_of(const BodyTree& tree);

/// How many bodies deep each one hangs below the hub.
std::vector<int> depths_of(const BodyTree& tree);

/// Principal inertia of a body as MuJoCo is told it. MuJoCo 3 and later take an inertial for turned
/// like its body where all components of `quat` are within 1e-6 of the identity's, and for placed
/// like it, too, where those of `pos` are within 1e-6 m of zero: small turns and offsets are lost.
/// Where that would drop anything, the axes are named in another order, y z x. That is the same
/// tensor to the bit and a turn by 120 deg, which nobody takes for none.
PrincipalInertia told_inertia(const MassProperties& inertial);

/// An element of a body, in the axes of the link that carries it.
MassElement seated(const MassElement& element, const Seat& seat);

}  // namespace twincraft
