// Ctrl-C and its kin: the first SIGINT or SIGTERM asks the run to stop and keep what it has, the
// second one ends the program at once.  Tested by tests/agreement/scsim_test.cpp.
#pragma once

#include <atomic>

namespace twincraft {

/// From now on a first SIGINT or SIGTERM only sets the flag that is returned.
const std::atomic<bool>& watch_for_interrupts();

/// The exit code that says which signal came (130, 143); 0 when none did.
int interrupt_exit_code();

}  // namespace twincraft
