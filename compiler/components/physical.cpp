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

/// Of a point mass, or a rod about its own axis.
void report_too_small(const Matrix3d& I, Span span, const std::string& whose,
                      Diagnostics& diagnostics) {
  diagnostics
      .error(Code::kInertiaNotPositive, span,
             fmt::format("inertia of {} is below the least that MuJoCo loads, {} kg m2: principal "
                         "moments {} kg m2",
                         whose, shortest(kMujocoMinimum), list(sorted_moments(I))))
      .with_hint("a point mass or a thin rod still needs a little, such as 1.0e-12 kg m2");
}

/// How much is lacking tells rounding from a mistake. @param moments  smallest first
void report_triangle(const Vector3d& moments, Span span, std::string message,
                     Diagnostics& diagnostics) {
  constexpr double kLooksRounded = 5.0e-3;  // three digits of a data sheet
  const double lacking = moments[2] - moments[0] - moments[1];
  const double part = lacking / moments[2];
  message += fmt::format("; the sum of the smaller two lacks {:.2g} kg m2 ({:.2g} %)", lacking,
                         100.0 * part);
  const bool rounded = part < kLooksRounded;
  diagnostics.error(Code::kInertiaTriangle, span, std::move(message))
      .with_hint(rounded
                     ? fmt::format("rounding? write more digits, or lower the largest moment "
                                   "to {:.9g}",
                                   moments[0] + moments[1])
                     : "no mass distribution has a moment larger than the sum of the other two");
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
  const Vector3d moments = sorted_moments(I);
  switch (physicality(I)) {
    case Physicality::kPhysical:
      return;
    case Physicality::kOnEdge:
      diagnostics.note(Code::kInertiaOnEdge, span,
                       message("breaks the triangle inequality by rounding"));
      return;
    case Physicality::kNotPositive:
      if (moments[0] >= -kMujocoMinimum) return report_too_small(I, span, whose, diagnostics);
      diagnostics.error(Code::kInertiaNotPositive, span, message("is not positive definite"))
          .with_hint("check the signs; off the diagonal stand minus the products of inertia");
      return;
    case Physicality::kTriangleViolated:
      return report_triangle(moments, span, message("violates the triangle inequality"),
                             diagnostics);
  }
}

}  // namespace twincraft
