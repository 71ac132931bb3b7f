// The MuJoCo half: the tree of bodies that is printed as MJCF, in MJCF's own terms. Bodies come in
// the order of the file, parents before children; bodies[0] is the hub and has the free joint.
#pragma once

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

struct TreeBody {
  std::string name;
  int parent = -1;
  int link = -1;                    // the link of the analytic half it stands for; wheels: -1
  Vector3d pos = Vector3d::Zero();  // [m] in the parent's axes
  Quaterniond quat = Quaterniond::Identity();  // body to parent
  std::vector<TreeJoint> joints;               // none: welded. The hub's free joint is implied.
  MassProperties inertial;  // about its own centre of mass, body axes, as emitted
  // What gravity pulls on: the ledger's elements on this body plus token masses that were added on
  // top. A token mass taken back out of its mount is no element.
  std::vector<MassElement> elements;
};

/// A wheel of the tree: a body with one hinge whose motor torque is an input.
struct TreeWheel {
  std::string joint;  // also the motor's name
  int rotor = 0;      // index in Assembly::rotors
};

struct BodyTree {
  std::vector<TreeBody> bodies;
  std::vector<TreeWheel> wheels;
};

}  // namespace twincraft
