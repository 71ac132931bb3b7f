// Vehicles that differ in their numbers, flown by the analytic engine and sampled as a recorded run
// is: side by side in lanes where their structure lets them. Which of them fly together makes no
// difference to any. Tested by tests/runtime/fleet_test.cpp.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "compiler/ir/bundle.h"
#include "runtime/bsm/kernel.h"
#include "runtime/engine/observation.h"
#include "runtime/integrate/step_control.h"

namespace twincraft {

/// One of them. What it refers to must outlive the flight.
struct FleetMember {
  const Bundle* bundle = nullptr;
  /// Takes one sample after another, a few at a time; false: it need not fly on, and gets no more.
  std::function<bool(const Observation& sample)> take;
};

struct FleetEnd {
  Observation last = {};         // of all samples; zeros: it failed before the first
  std::string failure = {};      // numerical: what, when and which coordinate; empty: none
  bool is_interrupted = false;   // by `stop`
  AcceptedErrors accepted = {};  // of an adaptive method, up to there
};

struct FleetOptions {
  const std::atomic<bool>* stop = nullptr;  // set by a signal handler
  bsm::InstructionSet instructions = bsm::fastest_instruction_set(bsm::Use::kBatch);
};

/// Flies each to the end of its plan, or to where it has failed or need not fly on.
/// @return in the order of `members`
std::vector<FleetEnd> fly_fleet(std::span<const FleetMember> members,
                                const FleetOptions& options = {});

}  // namespace twincraft
