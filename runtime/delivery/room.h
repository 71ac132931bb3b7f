// Whether the machine has room for a run, asked before it starts.
// Tested by tests/agreement/stream_test.cpp.
#pragma once

#include <string>

#include "runtime/delivery/spec_run.h"

namespace twincraft {

/// Reports, at `simulation.record`, that this run keeps more than is sensible. @return whether it
/// fits
bool check_memory(const CompiledSpec& compiled, const RunRequest& request,
                  Diagnostics& diagnostics);

/// The same of so many trajectories at a time.
bool check_memory(const CompiledSpec& compiled, double trajectories, Diagnostics& diagnostics);

/// Empty, or that the disk has no room for the files of this run.
std::string check_disk(const CompiledSpec& compiled, const RunRequest& request);

}  // namespace twincraft
