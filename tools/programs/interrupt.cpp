// See interrupt.h. Tested by tests/agreement/scsim_test.cpp.
#include "tools/programs/interrupt.h"

#include <csignal>

namespace twincraft {
namespace {

std::atomic<bool> stop{false};
volatile std::sig_atomic_t received = 0;
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler may touch nothing else

void on_signal(int signal) {
  received = signal;
  stop = true;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& watch_for_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  return stop;
}

int interrupt_exit_code() { return received == 0 ? 0 : 128 + received; }

}  // namespace twincraft
