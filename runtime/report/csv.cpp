#include "runtime/report/csv.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

namespace twincraft {

/// A failed run may end in a sample that is no number.
void append_number(double value, std::string& text) {
  if (!std::isfinite(value)) {
    text += fmt::format("{}", value);
    return;
  }
  std::array<char, 32> digits{};  // shortest(), without a string for each of millions
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

CsvLines::CsvLines(const Model& model)
    : outputs_(outputs_of(model)), printed_time_(model.simulation.step) {}

std::string CsvLines::header() const {
  std::string text = "t [s]";
  for (const OutputSignal& output : outputs_)
    for (std::size_t i = 0; i < output.size(); ++i)
      text += fmt::format(",{} [{}]", output.component(i), output.unit);
  return text + '\n';
}

std::size_t CsvLines::columns() const {
  std::size_t columns = 1;
  for (const OutputSignal& output : outputs_) columns += output.size();
  return columns;
}

void CsvLines::append(const Observation& sample, std::string& text) const {
  append_number(printed_time_(sample.time), text);
  for (const OutputSignal& output : outputs_)
    for (std::size_t i = 0; i < output.size(); ++i) {
      text += ',';
      append_number(value_of(output, i, sample), text);
    }
  text += '\n';
}

std::string trajectory_csv(const Model& model, const Trajectory& trajectory) {
  const CsvLines lines(model);
  std::string text = lines.header();
  for (const Observation& sample : trajectory.samples) lines.append(sample, text);
  return text;
}

}  // namespace twincraft
