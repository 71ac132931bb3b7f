// One spec written as two files, the second of which extends the first.
#pragma once

#include "tests/random/values.h"

namespace twincraft::random_vehicles {

struct Parts {
  Json base;  // lacks half of the spec and is wrong about some of the rest
  Json rest;  // what is missing or wrong in the base
};

/// @param spec  as the compiler resolved it
/// The parts merge into `spec` again, key by key and member by member.
Parts deal(const Json& spec);

}  // namespace twincraft::random_vehicles
