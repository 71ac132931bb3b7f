// A rigid body on a joint: the general link of a vehicle, in chains and branches of any axes. At
// zero coordinate its frame sits at the joint, turned from its parent's by `orientation`. A
// revolute joint turns the body by the right hand about `axis`, a prismatic one moves it along
// `axis`, a fixed one holds it: then it has no coordinate, and is carried as part of what it is
// fixed to. Bodies may be written in any order.
// Tested by tests/compiler/body_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/components/attitude.h"
#include "compiler/components/section.h"

namespace twincraft {

enum class JointType { kRevolute, kPrismatic, kFixed };

/// Units are those of an angle for a revolute joint and of a length for a prismatic one. A fixed
/// joint has a position alone.
struct JointSpec : Written {
  JointType type = JointType::kRevolute;
  Vector3d position = Vector3d::Zero();  // [m] parent axes
  Vector3d axis = Vector3d::UnitZ();     // unit, body axes
  double stiffness = 0.0;                // [N m/rad] or [N/m]
  double damping = 0.0;                  // [N m s/rad] or [N s/m]
  double rest = 0.0;                     // [rad] or [m]
  double coordinate = 0.0;               // initial `angle` [rad] or `displacement` [m]
  double rate = 0.0;                     // [rad/s] or [m/s]
  Schedule effort;                       // `torque` [N m] or `force` [N] of the parent on the body
};

struct BodySpec : Written {
  std::string name;
  std::string parent = "hub";
  JointSpec joint;
  std::optional<AttitudeSpec> orientation;     // body to parent axes; absent: not turned
  double mass = 0.0;                           // [kg]
  Vector3d center_of_mass = Vector3d::Zero();  // [m] from the joint, body axes
  Matrix3d inertia = Matrix3d::Zero();         // [kg m^2] about its centre of mass, body axes
};

const Table<BodySpec>& body_table();

/// It has no coordinate.
bool is_fixed(const BodySpec& body);

/// Parent, orientation, mass and inertia.
void check(const BodySpec& body, const Context& context, Diagnostics& diagnostics);

/// Report bodies that carry one another in a circle, each circle once.
void check_together(const std::vector<BodySpec>& bodies, const Context& context,
                    Diagnostics& diagnostics);

/// A link with its mass, or a fixed body, for each: parents before children and a branch in one
/// piece, otherwise as written. @pre every parent is the hub or a body, and there is no circle
void lower_mounts(const std::vector<BodySpec>& bodies, ModelBuilder& builder);

/// What the body adds to the coordinates; nothing when it is fixed.
void lower(const BodySpec& body, const Vehicle& vehicle, ModelBuilder& builder);

Coordinates coordinates_of(const BodySpec& body);
double mass_of(const BodySpec& body);
inline std::string_view depth_key(const BodySpec&) { return "parent"; }

}  // namespace twincraft
