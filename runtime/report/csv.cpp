// Columns are listed once, header and value together. Tested by tests/runtime/report_test.cpp.
#include "runtime/report/csv.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <functional>

#include "runtime/report/printed_time.h"

namespace twincraft {
namespace {

/// A failed run may end in a sample that is no number.
void append_cell(double value, std::string& text) {
  if (!std::isfinite(value)) {
    text += fmt::format("{}", value);
    return;
  }
  std::array<char, 32> digits{};  // shortest(), without a string for each of millions
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

}  // namespace

void CsvLines::add_vector(const std::string& name, const std::string& unit,
                          Vector3d Observation::*vector, std::vector<Column>& columns) {
  for (int i = 0; i < 3; ++i)
    columns.push_back({fmt::format("{}.{} [{}]", name, "xyz"[i], unit),
                       [vector, i](const Observation& sample) { return (sample.*vector)[i]; }});
}

void CsvLines::add_quaternion(std::vector<Column>& columns) {
  columns.push_back({"q_BN.w [1]", [](const Observation& sample) { return sample.q_BN.w(); }});
  for (int i = 0; i < 3; ++i)
    columns.push_back({fmt::format("q_BN.{} [1]", "xyz"[i]),
                       [i](const Observation& sample) { return sample.q_BN.vec()[i]; }});
}

void CsvLines::add_coordinate(const Coordinate& coordinate, std::vector<Column>& columns) {
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

std::vector<CsvLines::Column> CsvLines::columns_of(const Model& model) {
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

CsvLines::CsvLines(const Model& model) : columns_(columns_of(model)) {}

std::string CsvLines::header() const {
  std::string text;
  for (const Column& column : columns_) (text += column.header) += ',';
  text.back() = '\n';
  return text;
}

void CsvLines::append(const Observation& sample, std::string& text) const {
  for (const Column& column : columns_) {
    append_cell(column.value(sample), text);
    text += ',';
  }
  text.back() = '\n';
}

std::string trajectory_csv(const Model& model, const Trajectory& trajectory) {
  const CsvLines lines(model);
  std::string text = lines.header();
  for (const Observation& sample : trajectory.samples) lines.append(sample, text);
  return text;
}

}  // namespace twincraft
