// A flat plate in the flow of an atmosphere that turns with its planet, on a mount.
#pragma once

#include <string>

#include "compiler/components/section.h"

namespace twincraft {

struct PlateSpec : Written {
  std::string name;
  std::string mount = "hub";
  Vector3d position = Vector3d::Zero();  // [m] of its centre, mount axes
  Vector3d normal = Vector3d::UnitZ();   // mount axes
  double area = 0.0;                     // [m^2]
  double coefficient = 2.0;              // of the force along the normal
  double density = 0.0;                  // [kg/m^3] at t = 0
  double growth = 0.0;                   // [1/s] of the density, relative
  double turn = 0.0;                     // [rad/s] of the atmosphere about N's third axis
};

const Table<PlateSpec>& plate_table();
void check(const PlateSpec& plate, const Context& context, Diagnostics& diagnostics);
void lower(const PlateSpec& plate, const Vehicle& vehicle, ModelBuilder& builder);

}  // namespace twincraft
