// A spec flown, in process: all that `scsim SPEC [-o DIR]` does but read flags and print. Keeps no
// state of the process and sets no signal handler, so that any number of runs may go on at once.
// The file to read first in this room.  Tested by tests/runtime/delivery_test.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compiler/ir/engine_kind.h"
#include "runtime/delivery/compiled_spec.h"
#include "runtime/delivery/exit_code.h"
#include "runtime/study/results.h"

namespace twincraft {

struct RunRequest {
  /// What is flown, timed and told meanwhile. `keep_samples` and `side_by_side` are fly()'s to set.
  RunOptions options;
  int jobs = 1;         // members of a study at a time; from 2 on the engines of a single run, too
  std::string folder;   // files are written here while it is flown; empty: nowhere
  bool netcdf = false;  // trajectories as netCDF, too. @pre has_netcdf()
  // Keep what trajectory(), json() and save() need: the first member's samples in memory, the files
  // of a study in a folder of its own under the system's temporary directory.
  bool keeps_results = false;
  std::string program = {};  // that the report names; empty: `scsim VERSION`
  /// A member of a study has been flown. They come in their order, one call at a time.
  std::function<void(std::size_t index, const ReportedMember& member)> finished = {};

  /// The targets that the spec is to be compiled to.
  Wanted wanted() const { return wanted_by_run(keeps_results || !folder.empty()); }
};

/// A run that has ended, whatever came of it.
class SpecRun {
 public:
  SpecRun(SpecRun&& other) noexcept;
  SpecRun& operator=(SpecRun&& other) noexcept;
  ~SpecRun();

  /// It was stopped before its first member had been flown: there is no report.
  bool empty() const;
  std::size_t members() const;  // that were flown
  /// Of its samples the last alone; trajectory() has them. @pre not empty(), as of text() and
  /// json()
  const Report& report() const;
  Verdict verdict() const;
  /// What scsim exits with; kExitInterrupted for any signal.
  int exit_code() const;
  /// What failed, a line each: what scsim says on standard error.
  std::vector<std::string> failures() const;
  /// Empty, or why the files of RunRequest::folder are not all written.
  const std::string& error() const;

  /// What scsim prints on standard output.
  std::string text(bool colour = false) const;
  /// The bytes of report.json. @pre it was flown with a folder or with `keeps_results`
  /// @throws std::runtime_error when a study's files cannot be read again
  std::string json() const;
  /// Of the first member, with all its samples; none of an engine that was skipped.
  /// @pre it was flown with `keeps_results`, and is not empty()
  const Trajectory& trajectory(EngineKind engine) const;

  /// The files of `scsim SPEC -o folder`, byte for byte. The folder is made when it is missing;
  /// what an earlier run left in it goes.
  /// @return empty, or what went wrong, in scsim's words. @pre it was flown with `keeps_results`
  std::string save(const std::string& folder) const;

 private:
  struct Parts;
  friend SpecRun fly(CompiledSpec compiled, const RunRequest& request);
  explicit SpecRun(std::unique_ptr<Parts> parts);

  std::string save_single(const std::string& folder) const;
  std::string save_study(const std::string& folder) const;

  std::unique_ptr<Parts> parts_;
};

/// Flies a spec, or all members of its study, in the engines that are asked for. What a run may
/// meet is part of the result: failed engines, a stop, files that cannot be written.
/// @param compiled  of at least `request.wanted()`
SpecRun fly(CompiledSpec compiled, const RunRequest& request);

/// What is sure to be written into a folder: the report and the first member's trajectories.
std::vector<std::string> first_paths(const std::string& folder);

/// Of a run of these options.
Provenance provenance_of(const RunOptions& options, const std::string& program = {});

}  // namespace twincraft
