// See physical.h. Tested by tests/compiler/hub_test.cpp.
#include "compiler/components/physical.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

/// Principal moments, smallest first.
Vector3d sorted_moments(const Matrix3d& I) {
  Vector3d moments = principal_inertia(I).moments;
  std::sort(moments.begin(), moments.end());
  return moments;
}

/// To twelve digits: what comes after them is rounding of the eigenvalues.
std::string list(const Vector3d& v) {
  return fmt::format("[{:.12g}, {:.12g}, {:.12g}]", v[0], v[1], v[2]);
}

}  // namespace

Physicality physicality(const Matrix3d& I) {
  const Vector3d moments = sorted_moments(I);
  if (!(moments[0] > kMujocoMinimum)) return Physicality::kNotPositive;
  const double excess = moments[2] - (moments[0] + moments[1]);
  if (excess > kTriangleTolerance * moments[2]) return Physicality::kTriangleViolated;
  return excess > 0.0 ? Physicality::kOnEdge : Physicality::kPhysical;
}

void check_mass(double mass, Span span, const std::string& whose, Diagnostics& diagnostics) {
  if (mass > kMujocoMinimum) return;
  diagnostics.error(
      Code::kMassTooSmall, span,
      fmt::format("a mass of {} kg for {} is below the least that MuJoCo loads, {} kg",
                  shortest(mass), whose, shortest(kMujocoMinimum)));
}

void check_inertia(const Matrix3d& I, Span span, const std::string& whose,
                   Diagnostics& diagnostics) {
  const auto message = [&](const char* fault) {
    return fmt::format("inertia of {} {}: principal moments {} kg m2", whose, fault,
                       list(sorted_moments(I)));
  };
  switch (physicality(I)) {
    case Physicality::kPhysical:
      return;
    case Physicality::kOnEdge:
      diagnostics.note(Code::kInertiaOnEdge, span,
                       message("breaks the triangle inequality by rounding"));
      return;
    case Physicality::kNotPositive:
      diagnostics.error(Code::kInertiaNotPositive, span, message("is not positive definite"))
          .with_hint("check the signs; off the diagonal stand minus the products of inertia");
      return;
    case Physicality::kTriangleViolated:
      diagnostics.error(Code::kInertiaTriangle, span, message("violates the triangle inequality"))
          .with_hint("no mass distribution has a moment larger than the sum of the other two");
      return;
  }
}

}  // namespace twincraft
