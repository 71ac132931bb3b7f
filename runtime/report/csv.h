// A trajectory as comma-separated values: the same columns for either engine, so that two files can
// be compared line by line.  Tested by tests/runtime/report_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "compiler/ir/signals.h"
#include "runtime/report/printed_time.h"
#include "runtime/simulate/propagate.h"

namespace twincraft {

/// As the shortest text that reads back; `nan`, `inf`, `-inf`.
void append_number(double value, std::string& text);

/// Lines of a file as samples come; doubles read back exactly.
/// Names of coordinates begin with a letter (the compiler saw to it), so no cell is a formula.
class CsvLines {
 public:
  explicit CsvLines(const Model& model);

  std::string header() const;  // `name [unit]` of every column
  void append(const Observation& sample, std::string& text) const;
  std::size_t columns() const;

 private:
  std::vector<OutputSignal> outputs_;
  PrintedTime printed_time_;
};

/// A header and one line per sample.
std::string trajectory_csv(const Model& model, const Trajectory& trajectory);

}  // namespace twincraft
