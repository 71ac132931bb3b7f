// Which program, on which machine, made a report: what someone needs to judge its timings and to
// make it again.  Tested by tests/runtime/report_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "runtime/bsm/processor.h"

namespace twincraft {

struct Provenance {
  std::string program;   // `scsim 0.1.0`
  std::string git;       // `git describe` when built; empty outside a repository
  std::string compiler;  // `GNU 12.2.0`
  std::string flags;     // ours, as configured
  std::string mujoco;    // of the library that was loaded
  std::string eigen;
  std::string instructions;  // the set that the analytic engine ran: `x86-64`, `AVX2`, `AVX-512`
  std::string instructions_reason;                  // why it and no other of those
  std::vector<std::string> instructions_available;  // that the processor has
  std::string cpu;                                  // empty when the system does not say
  int cores = 0;
  double load_average = 0.0;  // over the last minute; negative when the system does not say
};

/// Of a run whose analytic engine has these instructions.
Provenance provenance(const bsm::Choice& instructions = bsm::choose(bsm::Use::kOne));

}  // namespace twincraft
