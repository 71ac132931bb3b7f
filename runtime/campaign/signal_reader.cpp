#include "runtime/campaign/signal_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace twincraft {

SignalReader::SignalReader(const Model& model, std::string_view name) {
  for (OutputSignal& output : outputs_of(model)) {
    if (output.name == name) {
      count_ = output.size();
      output_ = std::move(output);
      return;
    }
    for (std::size_t i = 0; i < output.size(); ++i)
      if (output.component(i) == name) {
        first_ = i;
        output_ = std::move(output);
        return;
      }
  }
  throw std::invalid_argument(fmt::format("no output is called `{}`", name));
}

double SignalReader::operator()(const Observation& seen) const {
  if (count_ == 1) return value_of(output_, first_, seen);
  double squares = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const double value = value_of(output_, i, seen);
    squares += value * value;
  }
  return std::sqrt(squares);
}

}  // namespace twincraft
