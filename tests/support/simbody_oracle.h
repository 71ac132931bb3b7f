// A third dynamics engine, for tests: the analytic half of a model as a Simbody multibody system.
// Shares with ours the model and nothing else: kinematics, articulated bodies and the places where
// forces act are Simbody's. Wheels are bodies that spin, not gyrostats.
#pragma once

#include "runtime/compare/random_state.h"

namespace twincraft::test {

/// (v_B in N, omega in B, joint rates, wheel rates) differentiated at `state`, with the inputs and
/// the masses of `state.time` and this law of gravity.  @pre not a point mass
Eigen::VectorXd simbody_accelerations(const Model& model, GravityLaw law, const RandomState& state);

}  // namespace twincraft::test
