// A run reduced to the numbers that a campaign asks of it, sample by sample. No more than a few
// numbers are kept of each; settling times keep those samples that could still decide them.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compiler/ir/campaign.h"
#include "runtime/campaign/signal_reader.h"

namespace twincraft {

/// Between samples every signal is taken to be straight.
/// - max, min, max_abs, max_norm, final: of the samples alone.
/// - mean, rms: the trapezoidal rule over time, of the signal and of its square.
/// - settling_time: from when on the signal stays within `within` of its last value, the ends of
///   that band included. At the latest that is the last sample.
/// - first_crossing: when it first has the value `level`, from either side. Never: nothing.
/// Times [s] are those of the samples.
class Reduction {
 public:
  static std::unique_ptr<Reduction> make(const OutputPlan& plan);
  virtual ~Reduction() = default;

  /// @param time  [s] no earlier than that of the call before
  virtual void take(double time, double value) = 0;
  /// Nothing before the first sample.
  virtual std::optional<double> result() const = 0;
};

/// All outputs of one run.
class OutputReducer {
 public:
  /// @throws std::invalid_argument  an output is of a signal that the model does not have
  OutputReducer(const Model& model, std::span<const OutputPlan> outputs);

  /// The samples in the order of time, the last state at their end. A state that comes twice
  /// changes nothing.
  void take(const Observation& sample);
  /// SI, one per output. Nothing: never reached, or not a finite number.
  std::vector<std::optional<double>> results() const;

 private:
  struct Output {
    SignalReader signal;
    std::unique_ptr<Reduction> reduction;
  };
  std::vector<Output> outputs_;
};

}  // namespace twincraft
