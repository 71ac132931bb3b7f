// How one frame is turned from another, in any of the forms people write: quaternion, MRP,
// direction cosines, Euler angles, or two axes aligned with directions of the orbit. Tested by
// tests/compiler/initial_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "compiler/components/orbit.h"

namespace twincraft {

/// Intrinsic: `zyx` turns about z, then the new y, then the newest x.
struct EulerSpec : Written {
  std::string sequence;
  Vector3d angles = Vector3d::Zero();  // [rad] in the order of the sequence
};

/// A direction of the orbit of the point that `initial` places.
enum class OrbitDirection { kVelocity, kOrbitNormal, kRadial };

/// A body axis and where it shall point.
struct AlignSpec : Written {
  std::variant<std::string, Vector3d> axis{std::string("z")};  // `x`, `-y`, ... or B components
  std::variant<OrbitDirection, Vector3d> to{OrbitDirection::kVelocity};  // or N components
};

/// Exactly one is written.
struct AttitudeSpec : Written {
  std::optional<std::vector<double>> quaternion;          // scalar first, B to N
  std::optional<std::vector<double>> quaternion_to_body;  // scalar first, N to B
  std::optional<Vector3d> mrp;                            // sigma_BN
  std::optional<Matrix3d> dcm_BN;                         // N components to B
  std::optional<EulerSpec> euler;
  std::vector<AlignSpec> align;  // the first exact, the second as near as it can be
};

const Table<AttitudeSpec>& attitude_table();

/// @param point  what the directions of the orbit are taken from; null: there is no orbit
void check(const AttitudeSpec& attitude, const PointState* point, Diagnostics& diagnostics);

/// Takes B components to N, scalar not negative. @pre check passed
Quaterniond orientation(const AttitudeSpec& attitude, const PointState& point);

}  // namespace twincraft
