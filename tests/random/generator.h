// Vehicles that nobody would think of, over the whole language: every component on every other,
// skew axes, unequal chains, branches, every law of gravity and every way to say where it starts.
// All of them are valid specs, and all of their engines are the same machine. Left out is what
// makes MuJoCo inexact on purpose: `frame: inertial`, whose rounding the bounds here would not
// bear, and the idealisations of engines.mujoco.
#pragma once

#include "tests/random/values.h"

namespace twincraft::random_vehicles {

/// The spec of vehicle `seed`, the same on every machine.
Json random_spec(std::uint64_t seed);

}  // namespace twincraft::random_vehicles
