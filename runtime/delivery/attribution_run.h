// Why the engines differ on a spec, in process: what `scsim attribute SPEC` does but read flags and
// print.  Tested by tests/agreement/attribution_test.cpp and tests/runtime/delivery_test.cpp.
#pragma once

#include <string>

#include "runtime/delivery/compiled_spec.h"
#include "runtime/study/results.h"

namespace twincraft {

struct AttributionRequest {
  RunOptions options = {};   // nothing is timed, and samples are kept
  int jobs = 1;              // variants at a time
  std::string program = {};  // that the report names; empty: `scsim VERSION`

  /// That are in memory at a time, of both engines: the run's own and a variant's per job.
  double trajectories() const { return 2.0 * (1.0 + jobs); }
};

/// The targets that an attribution needs, with a report or without.
Wanted wanted_by_attribution(bool reports);

/// An attribution that has ended, whatever came of it.
class AttributionRun {
 public:
  /// Of the spec itself, without its study.
  const Report& report() const { return report_; }
  /// There is an attribution, if only of some variants.
  bool attributed() const { return report_.attribution.has_value(); }
  /// Every variant was run to its end.
  bool complete() const { return attributed() && report_.attribution->complete; }
  /// Why it is not complete: what scsim says on standard error.
  const std::string& complaint() const { return complaint_; }
  /// What scsim exits with; kExitInterrupted for any signal.
  int exit_code() const { return code_; }

  /// What scsim prints on standard output: nothing unless attributed().
  std::string text(bool colour = false) const;
  /// The bytes of report.json.
  std::string json() const;
  /// report.json and report.html. @return empty, or what went wrong, in scsim's words
  std::string save(const std::string& folder) const;

 private:
  friend AttributionRun attribute(CompiledSpec compiled, const AttributionRequest& request);
  AttributionRun() = default;

  Report report_;
  bool has_study_ = false;
  std::string complaint_;
  int code_ = 0;
};

/// Flies a spec and its variants. What a run may meet is part of the result.
/// @param compiled  of at least wanted_by_attribution()
AttributionRun attribute(CompiledSpec compiled, const AttributionRequest& request);

}  // namespace twincraft
