// Relative to what each number is physically comparable with.
#include "runtime/compare/held_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twincraft {
namespace {

/// Roundings of sums over welded bodies and of principal axes; of the larger terms, not the sum.
constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();

/// Nothing is infinitely far from anything else.
double relative(double difference, double scale) {
  if (difference == 0.0) return 0.0;
  return scale > 0.0 ? difference / scale : std::numeric_limits<double>::infinity();
}

double difference(double a, double b) {
  return relative(std::abs(a - b), std::max(std::abs(a), std::abs(b)));
}

double gyration(const MassProperties& body) {
  return body.mass > 0.0 ? std::sqrt(body.I_PntC_L.trace() / body.mass) : 0.0;
}

double center_difference(const MassProperties& a, const MassProperties& b) {
  if (a.mass == 0.0 && b.mass == 0.0) return 0.0;
  return relative((a.r_CL_L - b.r_CL_L).norm(), std::max(a.r_CL_L.norm(), gyration(a)));
}

/// In principal axes, where each entry is comparable with its own two moments, so that the smallest
/// moment of a rod counts. What rounding makes of the largest is no difference.
double inertia_difference(const MassProperties& a, const MassProperties& b) {
  const Matrix3d axes = principal_inertia(a.I_PntC_L).axes.toRotationMatrix();
  const Matrix3d in_a = axes.transpose() * a.I_PntC_L * axes;
  const Matrix3d in_b = axes.transpose() * b.I_PntC_L * axes;
  if (!in_a.allFinite() || !in_b.allFinite()) return std::numeric_limits<double>::infinity();
  const Vector3d moments = in_a.diagonal().cwiseMax(in_b.diagonal()).cwiseMax(0.0);
  const double trace = moments.sum();
  const double rounding = kRounding * (trace + a.r_CL_L.norm() * std::sqrt(a.mass * trace));
  double worst = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double beyond = std::max(0.0, std::abs(in_a(i, j) - in_b(i, j)) - rounding);
      worst = std::max(worst, relative(beyond, std::sqrt(moments[i] * moments[j])));
    }
  return worst;
}

/// Places that were added up of welded bodies' are rounded as those.
double place_difference(const HeldLink& a, const HeldLink& b) {
  constexpr double kOfReach = 1.0e-5;
  return relative((a.r_HP_P - b.r_HP_P).norm(),
                  std::max(a.r_HP_P.norm(), kOfReach * std::max(a.reach, b.reach)));
}

double axis_difference(const HeldLink& a, const HeldLink& b) {
  return std::max((a.axis_L - b.axis_L).norm(), (a.dcm_PL0 - b.dcm_PL0).cwiseAbs().maxCoeff());
}

double spring_difference(const HeldLink& a, const HeldLink& b) {
  return std::max({difference(a.stiffness, b.stiffness), difference(a.damping, b.damping),
                   difference(a.rest, b.rest)});
}

double wheel_difference(const HeldWheel& a, const HeldWheel& b) {
  return std::max((a.axis_L - b.axis_L).norm(), difference(a.spin_inertia, b.spin_inertia));
}

void keep(ProofLine& line, double difference, const std::string& where) {
  if (std::isnan(line.difference) || difference <= line.difference) return;
  line.difference = difference;
  line.where = where;
}

template <class Of>
ProofLine worst_link(const std::string& what, const Assembly& assembly, const HeldMachine& a,
                     const HeldMachine& b, std::size_t first, const Of& of) {
  ProofLine line{what, 0.0, {}};
  for (std::size_t i = first; i < a.links.size(); ++i)
    keep(line, of(a.links[i], b.links[i]), assembly.links[i].name);
  return line;
}

}  // namespace

std::vector<ProofLine> compare_held(const Assembly& assembly, const HeldMachine& a,
                                    const HeldMachine& b) {
  std::vector<ProofLine> lines;
  if (a.links.empty() || b.links.empty()) return lines;
  const auto add = [&](const char* what, std::size_t first, const auto& of) {
    lines.push_back(worst_link(what, assembly, a, b, first, of));
  };
  const auto of_mass = [](const auto& law) {
    return [law](const HeldLink& x, const HeldLink& y) { return law(x.mass, y.mass); };
  };
  add("masses of links", 0, of_mass([](const MassProperties& x, const MassProperties& y) {
        return difference(x.mass, y.mass);
      }));
  add("centres of mass of links", 0, of_mass(center_difference));
  add("inertias of links", 0, of_mass(inertia_difference));
  if (a.links.size() > 1) {
    add("places of joints", 1, place_difference);
    add("axes of joints", 1, axis_difference);
    add("springs and dampers", 1, spring_difference);
  }
  if (a.wheels.empty()) return lines;
  ProofLine wheels{"wheel axes and inertias", 0.0, {}};
  for (std::size_t i = 0; i < a.wheels.size(); ++i)
    keep(wheels, wheel_difference(a.wheels[i], b.wheels[i]), assembly.rotors[i].name);
  lines.push_back(wheels);
  return lines;
}

}  // namespace twincraft
