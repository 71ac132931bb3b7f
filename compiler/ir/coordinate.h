// The coordinates of a vehicle, and what each kind of them is, in one table. Whoever needs a unit,
// a word or a metric of a coordinate takes it from here.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace twincraft {

/// What a coordinate measures: units as in UDUNITS, and words for them.
struct CoordinateQuantity {
  std::string_view unit, rate_unit;  // `rad`, `rad/s`
  std::string_view position, rate;   // `angle`; no position: only the rate is known
};
inline constexpr CoordinateQuantity kAngle{"rad", "rad/s", "angle", "rate of the angle"};
inline constexpr CoordinateQuantity kTravel{"m", "m/s", "displacement", "speed"};
inline constexpr CoordinateQuantity kSpin{"", "rad/s", "", "spin relative to the mount"};

/// A coordinate of the vehicle, in the order of the spec. A hinge or slide is link `index` of the
/// assembly; a wheel is rotor `index`, rate only.
struct Coordinate {
  enum class Kind { kWheel, kPanel, kBodyAngle, kBodyDisplacement, kParticle, kPendulum };
  std::string name;  // `wing_p.1`, `rw_x`, `bob.phi`
  Kind kind = Kind::kPanel;
  int index = 0;

  constexpr const CoordinateQuantity& quantity() const;
  bool is_wheel() const { return kind == Kind::kWheel; }
  bool is_length() const { return quantity().unit == kTravel.unit; }
  /// Its entry in the vectors of joints, or in that of wheels.
  std::size_t entry() const { return static_cast<std::size_t>(is_wheel() ? index : index - 1); }
};

struct CoordinateKind {
  Coordinate::Kind kind;
  std::string_view word;       // in NAME.bsm.json
  std::string_view one, many;  // the components that have it, for people
  CoordinateQuantity quantity;
  std::string_view metric;  // key of the metric that compares it in the engines
};

/// In the order of Coordinate::Kind. Kinds of one component stand together.
inline constexpr std::array<CoordinateKind, 6> kCoordinateKinds{{
    {Coordinate::Kind::kWheel, "wheel", "wheel", "wheels", kSpin, "wheel_rate_rad_s"},
    {Coordinate::Kind::kPanel, "panel", "panel", "panels", kAngle, "joint_deg"},
    {Coordinate::Kind::kBodyAngle, "body_angle", "jointed body", "jointed bodies", kAngle,
     "joint_deg"},
    {Coordinate::Kind::kBodyDisplacement, "body_displacement", "jointed body", "jointed bodies",
     kTravel, "joint_m"},
    {Coordinate::Kind::kParticle, "particle", "slosh particle", "slosh particles", kTravel,
     "slosh_m"},
    {Coordinate::Kind::kPendulum, "pendulum", "slosh pendulum", "slosh pendulums", kAngle,
     "pendulum_deg"},
}};

constexpr const CoordinateKind& kind_of(const Coordinate& coordinate) {
  return kCoordinateKinds[static_cast<std::size_t>(coordinate.kind)];
}
constexpr const CoordinateQuantity& Coordinate::quantity() const { return kind_of(*this).quantity; }

}  // namespace twincraft
