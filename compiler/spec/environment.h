// What surrounds the vehicle: deep space, or one attracting point mass at the inertial origin.
// Tested by tests/compiler/engines_test.cpp.
#pragma once

#include <optional>

#include "compiler/ir/model.h"
#include "compiler/schema/table.h"

namespace twincraft {

struct GravitySpec : Written {
  double mu = 0.0;  // [m^3/s^2]
  GravityLaw application = GravityLaw::kBodyCom;
};

struct EnvironmentSpec : Written {
  std::optional<GravitySpec> gravity;  // absent: deep space
};

const Table<EnvironmentSpec>& environment_table();

/// The words for where gravity acts.
Kind<GravityLaw> gravity_law();

}  // namespace twincraft
