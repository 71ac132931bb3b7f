// The vehicles of these tests.
#pragma once

#include <string>

#include "runtime/api/include/twincraft/simulation.h"

namespace twincraft::test {

inline std::string file(const std::string& path) {
  return std::string(TWINCRAFT_ROOT) + "/" + path;
}

/// Wheels, two panels; a torque by schedule.
inline Model quickstart() { return Model::load(file("models/quickstart.yaml")); }
/// Every kind of input, on mounts that are turned.
inline Model ports() { return Model::load(file("tests/components/vehicles/ports.yaml")); }
/// Tanks that drain by schedule, slosh, orbit.
inline Model burn() { return Model::load(file("tests/components/vehicles/burn.yaml")); }

}  // namespace twincraft::test
