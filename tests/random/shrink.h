// A counterexample as small as it gets: components and keys are taken out and numbers made simple
// for as long as the same check fails.
#pragma once

#include <functional>

#include "tests/random/values.h"

namespace twincraft::random_vehicles {

/// @param still_fails  whether a candidate has the fault that is hunted
/// @return a spec that fails and of which no part can be left out, or the best after many trials
Json shrink(Json spec, const std::function<bool(const Json&)>& still_fails);

}  // namespace twincraft::random_vehicles
