// What matter can be: inertia tensors that some distribution of positive mass has.
// Tested by tests/compiler/hub_test.cpp.
#pragma once

#include <string>

#include "compiler/diag/diagnostics.h"
#include "compiler/ir/mass.h"

namespace twincraft {

/// How far principal moments may break the triangle inequality by rounding, relative.
inline constexpr double kTriangleTolerance = 1.0e-9;

/// MuJoCo loads a moving body when mass [kg] and principal moments [kg m^2] are above this.
inline constexpr double kMujocoMinimum = 1.0e-15;

/// How a symmetric tensor fares as an inertia [kg m^2].
enum class Physicality {
  kPhysical,
  kOnEdge,            // breaks the triangle inequality within the tolerance: a flat plate, rounded
  kNotPositive,       // some principal moment is not above kMujocoMinimum
  kTriangleViolated,  // the largest principal moment exceeds the sum of the others
};
Physicality physicality(const Matrix3d& I);

/// Report a mass [kg] too small for MuJoCo; the schema has refused zero and less.
void check_mass(double mass, Span span, const std::string& whose, Diagnostics& diagnostics);

/// Report a tensor that no body has (error) or that MuJoCo needs nudged (note).
/// @param whose  for messages: "panel `wing_p`"
void check_inertia(const Matrix3d& I, Span span, const std::string& whose,
                   Diagnostics& diagnostics);

}  // namespace twincraft
