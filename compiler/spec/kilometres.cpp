// See kilometres.h. Tested by tests/compiler/initial_test.cpp.
#include "compiler/spec/kilometres.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

constexpr double kGravitation = 6.6743e-11;  // [m3/(kg s2)]
constexpr double kKilometre = 1000.0;        // [m]

struct Body {
  const char* name;
  double mu;  // [km3/s2], as tables print it
};

constexpr std::array kBodies{Body{"the Sun", 1.32712440e11}, Body{"Mercury", 22031.87},
                             Body{"Venus", 324858.59},       Body{"the Earth", 398600.44},
                             Body{"the Moon", 4902.80},      Body{"Mars", 42828.37},
                             Body{"Jupiter", 1.26686534e8},  Body{"Saturn", 3.7931206e7},
                             Body{"Uranus", 5.793951e6},     Body{"Neptune", 6.835100e6}};

const Body* body_of(double mu) {
  constexpr double kSame = 1.0e-3;  // values of different sources, with and without moons
  const auto found = std::ranges::find_if(
      kBodies, [mu](const Body& body) { return std::abs(mu / body.mu - 1.0) < kSame; });
  return found == kBodies.end() ? nullptr : &*found;
}

/// Radius [m] of a ball of this gravity and density [kg/m3].
double radius_of(double mu, double density) {
  return std::cbrt(3.0 * mu / (4.0 * std::numbers::pi * kGravitation * density));
}

/// How far out the vehicle starts [m]; 0: nowhere yet.
double distance_of(const InitialSpec& initial) {
  return initial.orbit ? initial.orbit->semi_major_axis : initial.position.norm();
}

/// All of a value is written in plain numbers.
bool is_bare(const Node* node) {
  if (node == nullptr || node->is_map()) return false;
  return std::ranges::all_of(scalars_of(*node),
                             [](const Node* each) { return is_bare_number(*each); });
}

/// The first that is not zero, which needs no unit. @pre one is not
const Node& first_number(const Node& written) {
  const std::vector<const Node*> scalars = scalars_of(written);
  const auto found = std::ranges::find_if(
      scalars, [](const Node* each) { return parse_number(each->scalar).value != 0.0; });
  return **found;
}

/// @return whether there was something to warn of
bool warn_of_mu(const GravitySpec& gravity, double distance, Diagnostics& diagnostics) {
  constexpr double kLargestSmallBody = 1.0e13;  // [m3/s2]; of moons and less
  constexpr double kFarOut = 100.0;             // radii; no small body holds an orbit there
  const Node& mu = *gravity.node->find("mu");
  const ReadContext context{diagnostics, "`mu` of gravity"};
  if (!is_bare_number(mu)) return false;
  const std::string read = fmt::format("{} m3/s2", shortest(gravity.mu));
  if (const Body* body = body_of(gravity.mu)) {
    warn_of_bare_number(
        mu, fmt::format("{} is read, and {} has {:.7g} km3/s2", read, body->name, body->mu),
        "km3/s2", "m3/s2", context);
    return true;
  }
  if (gravity.mu > kLargestSmallBody || distance < kFarOut * radius_of(gravity.mu, 2000.0))
    return false;
  warn_of_bare_number(mu,
                      fmt::format("{} makes an orbit at {:.6g} km one of {:.3g} m/s", read,
                                  distance / kKilometre, std::sqrt(gravity.mu / distance)),
                      "km3/s2", "m3/s2", context);
  return true;
}

/// `written` is a length from the centre.
void warn_of_length(const Node* written, const char* where, double length, double mu,
                    Diagnostics& diagnostics) {
  constexpr double kSmallestPlanet = 1.0e10;  // [m3/s2]; below it metres may be meant
  const double ball = radius_of(mu, 8000.0);  // of iron: what has this gravity is larger
  if (!is_bare(written) || mu < kSmallestPlanet || length == 0.0 || length > ball) return;
  warn_of_bare_number(first_number(*written),
                      fmt::format("{:.6g} m from the centre is inside a body of this `mu`, which "
                                  "has a radius of {:.2g} km or more",
                                  length, ball / kKilometre),
                      "km", "m", {diagnostics, where});
}

/// Metres per second where kilometres per second make an orbit.
void warn_of_speed(const InitialSpec& initial, double mu, Diagnostics& diagnostics) {
  const Node* written = initial.node == nullptr ? nullptr : initial.node->find("velocity");
  const double speed = initial.velocity.norm();
  const double circular = std::sqrt(mu / initial.position.norm());
  const double part = speed * kKilometre / circular;
  if (!is_bare(written) || part < 0.3 || part > 3.0) return;
  warn_of_bare_number(
      first_number(*written),
      fmt::format("{:.4g} m/s, where a circular orbit has {:.4g} m/s", speed, circular), "km/s",
      "m/s", {diagnostics, "`velocity` of initial"});
}

}  // namespace

void warn_of_kilometres(const InitialSpec& initial, const GravitySpec& gravity,
                        Diagnostics& diagnostics) {
  const double distance = distance_of(initial);
  if (warn_of_mu(gravity, distance, diagnostics)) return;
  if (initial.orbit) {
    warn_of_length(initial.orbit->node->find("semi_major_axis"), "`semi_major_axis` of orbit",
                   distance, gravity.mu, diagnostics);
    return;
  }
  if (initial.node == nullptr) return;
  warn_of_length(initial.node->find("position"), "`position` of initial", distance, gravity.mu,
                 diagnostics);
  warn_of_speed(initial, gravity.mu, diagnostics);
}

}  // namespace twincraft
