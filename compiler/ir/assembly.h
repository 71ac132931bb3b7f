// The analytic half: links joined by one-coordinate joints, and rotors. Every link is the hub of
// its children; links[0] is the spacecraft's hub and moves freely. Parents come before children.
#pragma once

#include <string>
#include <vector>

#include "compiler/ir/mass.h"
#include "compiler/ir/schedule.h"

namespace twincraft {

enum class JointKind { kHinge, kSlide };

/// The joint that carries a link. Joint frame and link frame share origin H; at coordinate zero the
/// link's axes are turned from its parent's by dcm_PL0. A hinge turns the link by +q about axis_L,
/// a slide moves it by +q along axis_L. Effort on the joint: u(t) - k (q - rest) - c qDot.
struct Joint {
  JointKind kind = JointKind::kHinge;
  Vector3d r_HP_P = Vector3d::Zero();       // [m] joint from the parent's origin, parent axes
  Matrix3d dcm_PL0 = Matrix3d::Identity();  // link to parent components at q = 0
  Vector3d axis_L = Vector3d::UnitZ();      // unit vector, link axes
  double stiffness = 0.0;                   // k [N m/rad] or [N/m]
  double damping = 0.0;                     // c [N m s/rad] or [N s/m]
  // Drag on the bob of a spherical pendulum: c is scaled by cos^2 of another link's coordinate.
  int damped_by_cosine_of = -1;  // index of that link; -1: c is constant
  double rest = 0.0;             // [rad] or [m]
  Schedule effort;               // u [N m] or [N]
};

struct Link {
  std::string name;                   // `hub`, `wing_p.1`
  int parent = -1;                    // index of the parent link; -1 for the hub only
  Joint joint;                        // unused for the hub
  std::vector<MassElement> elements;  // what the ledger puts on this link
};

/// A balanced wheel, as a gyrostat of its mount: its whole tensor is among the mount's elements,
/// only its spin relative to the mount is a state.
struct Rotor {
  std::string name;
  int link = 0;                         // the mount
  Vector3d axis_L = Vector3d::UnitZ();  // spin axis, mount axes, unit
  double spin_inertia = 0.0;            // Js [kg m^2]
  Schedule torque;                      // motor torque on the wheel [N m]
};

struct Assembly {
  std::vector<Link> links;
  std::vector<Rotor> rotors;
};

}  // namespace twincraft
