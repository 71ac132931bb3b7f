// What a campaign requires of the outputs of a member, and when a member stops early, in words that
// go into its `reason`.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/ir/campaign.h"
#include "runtime/campaign/signal_reader.h"

namespace twincraft {

/// A column of results and what is required of it.
struct OutputColumn {
  std::string name, unit;              // SI
  std::string meaning;                 // `maximum of omega_BN_B.x`
  std::optional<double> below, above;  // SI

  bool is_required() const { return below || above; }
  bool operator==(const OutputColumn&) const = default;
};
OutputColumn column_of(const OutputPlan& plan);

/// Of a member that was flown. A value must be less than `below` and greater than `above`; one that
/// was never reached, nothing, counts as infinitely late. NaN holds no requirement.
bool holds(const OutputColumn& output, std::optional<double> value);

/// `wing_peak 5.2 rad is not below 5 rad`; of several that are broken with `; ` between them.
/// Empty: all hold. @param values  one per output
std::string broken_requirements(std::span<const OutputColumn> outputs,
                                std::span<const std::optional<double>> values);

/// Tells a member when to stop.
class StopWatch {
 public:
  /// @throws std::invalid_argument  a stop is of a signal that the model does not have
  StopWatch(const Model& model, std::span<const StopPlan> stops);

  /// Why the member stops at this sample: `stopped at 12.5 s: omega_BN_B.x 1.2 rad/s is above 1
  /// rad/s`. Empty: it goes on. A value on its bound is not beyond it.
  std::string reason(const Observation& sample) const;

 private:
  struct Stop {
    StopPlan plan;
    SignalReader signal;
  };
  std::vector<Stop> stops_;
};

}  // namespace twincraft
