// `scsim compare`: how far apart are two trajectories? Tested by tests/agreement/compare_test.cpp.
#pragma once

namespace twincraft {

/// @param argv  from the word `compare` on. @return the exit code
int compare_command(int argc, char** argv);

}  // namespace twincraft
