// A propellant tank. What is in it is the bulk, a solid of the tank's shape about its centre, and
// the slosh masses that name the tank. Thrusters that draw from it shrink all of them in fixed
// proportion; the shape of the bulk stays. `depletion` says what the propellant takes along. Tested
// by tests/compiler/propellant_test.cpp.
#pragma once

#include <optional>

#include "compiler/components/section.h"

namespace twincraft {

struct SphereSpec : Written {
  double radius = 0.0;  // [m]
};

struct CylinderSpec : Written {
  double radius = 0.0;                // [m]
  double length = 0.0;                // [m]
  Vector3d axis = Vector3d::UnitZ();  // unit, mount axes
};

/// Exactly one of them.
struct TankShapeSpec : Written {
  std::optional<SphereSpec> sphere;
  std::optional<CylinderSpec> cylinder;
};

struct DepletionSpec : Written {
  LeavingMomentum momentum = LeavingMomentum::kNone;
};

struct TankSpec : Written {
  std::string name;
  std::string mount = "hub";
  Vector3d position = Vector3d::Zero();  // [m] centre, mount axes
  TankShapeSpec shape;
  double propellant = 0.0;        // [kg] everything in it, slosh included
  std::optional<double> density;  // [kg/m^3]
  DepletionSpec depletion;
};

const Table<TankSpec>& tank_table();

double volume(const TankShapeSpec& shape);  // [m^3]

/// Of a solid of this shape and mass [kg] about its centre, mount axes [kg m^2].
Matrix3d solid_inertia(const TankShapeSpec& shape, double mass);

/// Where slosh is mounted and placed that may leave that to its tank. @param tank null: it has none
std::string mount_with(const TankSpec* tank, const std::optional<std::string>& mount);
Vector3d position_with(const TankSpec* tank, const std::optional<Vector3d>& position);  // [m]

/// Mount, and no more propellant than the tank holds.
void check(const TankSpec& tank, const Context& context, Diagnostics& diagnostics);

/// What is drawn from the tanks, and what sloshes in them, is there; not asked after an error.
void check_together(const std::vector<TankSpec>& tanks, const Context& context,
                    Diagnostics& diagnostics);

/// The bulk: what does not slosh. The thrusters that draw from it make its flow.
void lower(const TankSpec& tank, const Vehicle& vehicle, ModelBuilder& builder);

double mass_of(const TankSpec& tank);

}  // namespace twincraft
