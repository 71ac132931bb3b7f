// Two trajectories compared, or two folders of them, in process: what `scsim compare A B` does but
// read flags and print.  Tested by tests/runtime/compare_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/compare/verdict.h"
#include "runtime/delivery/exit_code.h"
#include "runtime/delivery/trajectory_difference.h"

namespace twincraft {

struct CompareRequest {
  std::string a, b;               // two CSV files, or two folders of them
  const Model* spec = nullptr;    // whose coordinates and tolerances count; null: no spec
  std::string spec_name = {};     // what the verdict calls it
  CompareProgress progress = {};  // of each pair of files
};

/// A comparison that has ended, whatever came of it.
class CompareRun {
 public:
  /// In two folders, a pair for each name that both have, there or in a folder in them.
  const std::vector<TrajectoryDifference>& pairs() const { return pairs_; }
  /// Files that could not be compared. Others of two folders are compared all the same.
  const std::vector<FileFault>& faults() const { return faults_; }
  Verdict verdict() const;
  int exit_code() const;

  /// What scsim prints on standard output: nothing without a pair.
  std::string text(bool colour = false) const;

 private:
  friend CompareRun compare_files(const CompareRequest& request);
  CompareRun() = default;
  std::string verdict_line(bool colour) const;

  std::string a_, b_;
  std::optional<std::string> spec_name_;
  std::vector<TrajectoryDifference> pairs_;
  std::vector<FileFault> faults_;
  std::vector<std::string> only_a_, only_b_;  // files of folders that have no partner
};

/// Reads, compares and judges. Nothing is interpolated: only times that both have are compared.
CompareRun compare_files(const CompareRequest& request);

}  // namespace twincraft
