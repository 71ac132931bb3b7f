// How far MuJoCo's rounding may carry a run: no switch takes it away, so what it leaves can only be
// predicted. MuJoCo refers all inertias to the vehicle's centre of mass and rounds m r^2 of a body
// whose own inertia may be millions of times smaller. Tested by
// tests/agreement/attribution_test.cpp.
#pragma once

#include "compiler/ir/bundle.h"
#include "runtime/study/attribution.h"

namespace twincraft {

/// A bound on what it does to `subject` [SI] over the run of MuJoCo that `run` is: the largest
/// error of an acceleration, all one way, as a constant push (T^2/2, on a spring T/omega). Rounding
/// that changes its sign stays far below. 0 for the centre of mass, which internal forces do not
/// move.
/// @throws NumericalFailure
double mujoco_rounding(const Bundle& bundle, const Subject& subject, const Trajectory& run);

}  // namespace twincraft
