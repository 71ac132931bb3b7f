// A reference held against a run while it is flown: samples are judged a batch at a time, so that
// none has to be kept.
#pragma once

#include <vector>

#include "runtime/reference/reference.h"

namespace twincraft {

class RunningDeviations {
 public:
  RunningDeviations(ReferenceKind kind, const Model& model);

  void take(const Observation& sample);

  /// As deviations() of all samples at once.
  std::vector<Deviation> result();

 private:
  void judge();

  ReferenceKind kind_;
  const Model& model_;
  std::vector<Observation> batch_;  // the first sample of all, then those not yet judged
  std::size_t filled_ = 0;          // entries of the batch that count
  bool judged_ = false;             // something was
  std::vector<Deviation> found_;
};

}  // namespace twincraft
