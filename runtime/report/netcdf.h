// A trajectory as netCDF-4, for tools that want names, units and provenance with their numbers. The
// quantities are those of the CSV, vectors as one variable. Tested by
// tests/runtime/netcdf_test.cpp.
#pragma once

#include <string>

#include "runtime/report/report.h"

namespace twincraft {

/// The bytes of a file, a function of its arguments alone.
/// @throws std::runtime_error when the library fails
std::string trajectory_netcdf(const Bundle& bundle, const EngineRun& run,
                              const Provenance& provenance);

}  // namespace twincraft
