// Could the step of a run be too long? Bounds on what the rules of resolution can find, for the
// many members of a campaign: of the modes at the start, of what inputs and tanks change, of the
// last and the fastest sample, and of how fast the vehicle turns and flies around a planet. They
// cost about a hundredth of a judgement. Tested by tests/runtime/screen_test.cpp.
#pragma once

#include <vector>

#include "compiler/ir/model.h"
#include "runtime/engine/observation.h"
#include "runtime/integrate/step_control.h"
#include "runtime/linear/motion_record.h"

namespace twincraft {

class ResolutionScreen {
 public:
  /// @param model  outlives it
  explicit ResolutionScreen(const Model& model);

  /// Every sample of the run, in the order of time. @pre there is one before passes()
  void see(const Observation& sample);

  /// True: modes, turning and orbit, or the errors that an adaptive method accepted, are well
  /// inside the limits of their rules. False says nothing yet: judge_resolution() does.
  /// @param last      sample of the run
  /// @param accepted  of an adaptive method
  bool passes(const Observation& last, const AcceptedErrors& accepted) const;

 private:
  bool passes_accepted(const AcceptedErrors& accepted) const;
  bool passes_modes(const Observation& last) const;
  bool passes_motion() const;

  const Model& model_;
  Observation fastest_;      // the one that turns fastest
  double turning_ = -1.0;    // [rad/s] of hub or hinge
  double orbit_rate_ = 0.0;  // [rad/s]
  std::vector<Extent> joints_;
};

}  // namespace twincraft
