// The force and torque law of a subtree about its origin; see recursion.h for its equations.
// Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/bsm/sym3.h"

namespace twincraft::bsm {

/// n = J omegaDot + H a + n0,  f = H^T omegaDot + M a + f0
struct Law {
  Sym3 J, M;        // [kg m^2], [kg]
  Matrix3d H;       // [kg m]
  Vector3d n0, f0;  // [N m], [N]
};

}  // namespace twincraft::bsm
