// `scsim attribute`: why do the engines differ? Tested by tests/agreement/attribution_test.cpp.
#pragma once

namespace twincraft {

/// @param argv  from the word `attribute` on. @return the exit code
int attribute_command(int argc, char** argv);

}  // namespace twincraft
