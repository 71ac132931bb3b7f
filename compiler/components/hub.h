// The hub: the rigid body that moves freely and carries everything else. B is a point fixed in it,
// not its centre of mass. Tested by tests/compiler/hub_test.cpp.
#pragma once

#include "compiler/components/model_builder.h"
#include "compiler/schema/table.h"

namespace twincraft {

struct HubSpec : Written {
  double mass = 0.0;                           // [kg]
  Matrix3d inertia = Matrix3d::Zero();         // [kg m^2] bare hub about its own centre of mass
  Vector3d center_of_mass = Vector3d::Zero();  // [m] from B
};

const Table<HubSpec>& hub_table();

/// The inertia must be some body's.
void check(const HubSpec& hub, Diagnostics& diagnostics);

/// One link and its bare mass; wheels and tanks add theirs themselves.
void lower(const HubSpec& hub, ModelBuilder& builder);

}  // namespace twincraft
