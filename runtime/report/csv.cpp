// Columns are listed once, header and value together. Tested by tests/runtime/report_test.cpp.
#include "runtime/report/csv.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "compiler/ir/number.h"
#include "runtime/report/printed_time.h"

namespace twincraft {
namespace {

struct Column {
  std::string header;
  std::function<double(const Observation&)> value;
};

void add_vector(const std::string& name, const std::string& unit, Vector3d Observation::*vector,
                std::vector<Column>& columns) {
  for (int i = 0; i < 3; ++i)
    columns.push_back({fmt::format("{}.{} [{}]", name, "xyz"[i], unit),
                       [vector, i](const Observation& sample) { return (sample.*vector)[i]; }});
}

void add_quaternion(std::vector<Column>& columns) {
  columns.push_back({"q_BN.w [1]", [](const Observation& sample) { return sample.q_BN.w(); }});
  for (int i = 0; i < 3; ++i)
    columns.push_back({fmt::format("q_BN.{} [1]", "xyz"[i]),
                       [i](const Observation& sample) { return sample.q_BN.vec()[i]; }});
}

void add_coordinate(const Coordinate& coordinate, std::vector<Column>& columns) {
  if (coordinate.kind == Coordinate::Kind::kWheel) {
    const auto wheel = static_cast<std::size_t>(coordinate.index);
    columns.push_back({coordinate.name + ".rate [rad/s]",
                       [wheel](const Observation& sample) { return sample.wheel_rate[wheel]; }});
    return;
  }
  const auto joint = static_cast<std::size_t>(coordinate.index - 1);
  const std::string unit = coordinate.is_length() ? "m" : "rad";
  columns.push_back({fmt::format("{}.position [{}]", coordinate.name, unit),
                     [joint](const Observation& sample) { return sample.joint_position[joint]; }});
  columns.push_back({fmt::format("{}.rate [{}/s]", coordinate.name, unit),
                     [joint](const Observation& sample) { return sample.joint_rate[joint]; }});
}

std::vector<Column> columns_of(const Model& model) {
  std::vector<Column> columns;
  columns.push_back({"t [s]", [printed = PrintedTime(model.simulation.step)](
                                  const Observation& sample) { return printed(sample.time); }});
  add_vector("r_BN_N", "m", &Observation::r_BN_N, columns);
  add_vector("v_BN_N", "m/s", &Observation::v_BN_N, columns);
  add_quaternion(columns);
  add_vector("omega_BN_B", "rad/s", &Observation::omega_BN_B, columns);
  add_vector("r_CN_N", "m", &Observation::r_CN_N, columns);
  add_vector("v_CN_N", "m/s", &Observation::v_CN_N, columns);
  for (const Coordinate& coordinate : model.coordinates) add_coordinate(coordinate, columns);
  columns.push_back({"mass [kg]", [](const Observation& sample) { return sample.mass; }});
  return columns;
}

/// A failed run may end in a sample that is no number.
std::string cell(double value) {
  return std::isfinite(value) ? shortest(value) : fmt::format("{}", value);
}

}  // namespace

std::string trajectory_csv(const Model& model, const Trajectory& trajectory) {
  const std::vector<Column> columns = columns_of(model);
  std::string text;
  const auto separator = [&](const Column& column) {
    return &column == &columns.back() ? '\n' : ',';
  };
  for (const Column& column : columns) (text += column.header) += separator(column);
  for (const Observation& sample : trajectory.samples)
    for (const Column& column : columns) (text += cell(column.value(sample))) += separator(column);
  return text;
}

}  // namespace twincraft
