// See orbit.h. Tested by tests/compiler/initial_test.cpp.
#include "compiler/components/orbit.h"

#include <fmt/format.h>

#include <cmath>

#include "compiler/ir/number.h"
#include "compiler/schema/own_kind.h"

namespace twincraft {
namespace {

constexpr const char* kUnboundHint =
    "hyperbolic and parabolic orbits have no elements here yet; give `position` and `velocity`";

/// Positive; of a negative one check() knows what it means.
Kind<double> semi_major_axis() {
  const Kind<double> positive = quantity("m", Range::kPositive);
  return own_kind<double>({
      .text = positive.text(),
      .schema = positive.schema(),
      .read = [any = quantity("m")](const Node& node,
                                    ReadContext& context) { return any.read(node, context); },
      .write = [positive](const double& value) { return positive.write(value); },
      .numbers = positive.numbers(),
  });
}

}  // namespace

const Table<OrbitSpec>& orbit_table() {
  static const Table<OrbitSpec> table{
      "orbit",
      "Osculating elements of a bound orbit about the attracting body, in N.",
      {
          required("semi_major_axis", &OrbitSpec::semi_major_axis, semi_major_axis(),
                   "Half the long axis of the ellipse."),
          required("eccentricity", &OrbitSpec::eccentricity, number(Range::kNotNegative),
                   "0 for a circle, below 1."),
          required("inclination", &OrbitSpec::inclination, quantity("rad"),
                   "Of the orbit plane to the xy plane of N."),
          required("raan", &OrbitSpec::raan, quantity("rad"),
                   "Right ascension of the ascending node, from x of N."),
          required("argument_of_periapsis", &OrbitSpec::argument_of_periapsis, quantity("rad"),
                   "From the ascending node to periapsis."),
          required("true_anomaly", &OrbitSpec::true_anomaly, quantity("rad"),
                   "From periapsis to the vehicle at t = 0."),
      }};
  return table;
}

void check(const OrbitSpec& orbit, Diagnostics& diagnostics) {
  if (orbit.semi_major_axis == 0.0) {
    diagnostics.error(Code::kOutOfRange, orbit.span_of("semi_major_axis"),
                      "`semi_major_axis` of orbit is 0, but must be positive");
  } else if (orbit.semi_major_axis < 0.0) {
    diagnostics
        .error(Code::kOrbitNotBound, orbit.span_of("semi_major_axis"),
               fmt::format("the orbit is not bound: a semi-major axis of {} m, below 0, is that of "
                           "a hyperbola",
                           shortest(orbit.semi_major_axis)))
        .with_hint(kUnboundHint);
  } else if (!(orbit.eccentricity < 1.0)) {
    diagnostics
        .error(Code::kOrbitNotBound, orbit.span_of("eccentricity"),
               fmt::format("the orbit is not bound: eccentricity {} is not below 1",
                           shortest(orbit.eccentricity)))
        .with_hint(kUnboundHint);
  }
}

PointState state_of(const OrbitSpec& orbit, double mu) {
  const double e = orbit.eccentricity;
  const double p = orbit.semi_major_axis * (1.0 - e * e);  // [m] semi-latus rectum
  const double h = std::sqrt(mu * p);                      // [m^2/s] angular momentum per mass
  const double r = p / (1.0 + e * std::cos(orbit.true_anomaly));
  const double theta = orbit.argument_of_periapsis + orbit.true_anomaly;  // from the node
  const double cos_theta = std::cos(theta), sin_theta = std::sin(theta);
  const double cos_node = std::cos(orbit.raan), sin_node = std::sin(orbit.raan);
  const double cos_i = std::cos(orbit.inclination), sin_i = std::sin(orbit.inclination);
  const double s = e * std::sin(orbit.argument_of_periapsis) + sin_theta;
  const double c = e * std::cos(orbit.argument_of_periapsis) + cos_theta;

  PointState state;
  state.r_N = r * Vector3d(cos_theta * cos_node - cos_i * sin_theta * sin_node,
                           cos_theta * sin_node + cos_i * sin_theta * cos_node, sin_theta * sin_i);
  state.v_N = mu / h *
              Vector3d(-(cos_node * s + cos_i * c * sin_node),
                       -(sin_node * s - cos_i * c * cos_node), c * sin_i);
  return state;
}

}  // namespace twincraft
