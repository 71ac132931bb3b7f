// A trajectory as comma-separated values: the same columns for either engine, so that two files can
// be compared line by line.  Tested by tests/runtime/report_test.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compiler/ir/model.h"
#include "runtime/simulate/propagate.h"

namespace twincraft {

/// Lines of a file as samples come; doubles read back exactly.
/// Names of coordinates begin with a letter (the compiler saw to it), so no cell is a formula.
class CsvLines {
 public:
  explicit CsvLines(const Model& model);

  std::string header() const;  // `name [unit]` of every column
  void append(const Observation& sample, std::string& text) const;
  std::size_t columns() const { return columns_.size(); }

 private:
  struct Column {
    std::string header;
    std::function<double(const Observation&)> value;
  };
  static std::vector<Column> columns_of(const Model& model);
  static void add_vector(const std::string& name, const std::string& unit,
                         Vector3d Observation::*vector, std::vector<Column>& columns);
  static void add_quaternion(std::vector<Column>& columns);
  static void add_coordinate(const Coordinate& coordinate, std::vector<Column>& columns);

  std::vector<Column> columns_;
};

/// A header and one line per sample.
std::string trajectory_csv(const Model& model, const Trajectory& trajectory);

}  // namespace twincraft
