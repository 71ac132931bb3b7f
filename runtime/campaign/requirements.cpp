#include "runtime/campaign/requirements.h"

#include <fmt/format.h>

#include <limits>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

bool is_below(std::optional<double> bound, std::optional<double> value) {
  return !bound || value.value_or(kNever) < *bound;
}
bool is_above(std::optional<double> bound, std::optional<double> value) {
  return !bound || value.value_or(kNever) > *bound;
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit == "1" ? number : fmt::format("{} {}", number, unit);
}

/// `5.2 rad is not below 5 rad`: in six digits, unless these are the same for both.
std::string against(double value, std::string_view relation, double bound,
                    const std::string& unit) {
  std::string number = fmt::format("{:.6g}", value);
  if (number == fmt::format("{:.6g}", bound)) number = fmt::format("{}", value);
  return fmt::format("{} {} {}", with_unit(number, unit), relation,
                     with_unit(shortest(bound), unit));
}

std::string broken_bound(const OutputColumn& output, std::optional<double> value,
                         std::string_view relation, double bound) {
  if (value)
    return fmt::format("{} {}", output.name, against(*value, relation, bound, output.unit));
  return fmt::format("{} was never reached, so {} {}", output.name, relation,
                     with_unit(shortest(bound), output.unit));
}

/// What a reduction makes of its signal, to be read before the signal's name.
std::string_view words_of(Reduce reduce) {
  switch (reduce) {
    case Reduce::kMax:
      return "maximum of";
    case Reduce::kMin:
      return "minimum of";
    case Reduce::kMaxAbs:
      return "largest magnitude of";
    case Reduce::kMaxNorm:
      return "largest norm of";
    case Reduce::kFinal:
      return "last value of";
    case Reduce::kMean:
      return "mean over time of";
    case Reduce::kRms:
      return "root mean square over time of";
    case Reduce::kSettlingTime:
      return "settling time of";
    case Reduce::kFirstCrossing:
      break;
  }
  return "first crossing of";
}

}  // namespace

OutputColumn column_of(const OutputPlan& plan) {
  return {plan.name, plan.unit, fmt::format("{} {}", words_of(plan.reduce), plan.signal),
          plan.below, plan.above};
}

bool holds(const OutputColumn& output, std::optional<double> value) {
  return is_below(output.below, value) && is_above(output.above, value);
}

std::string broken_requirements(std::span<const OutputColumn> outputs,
                                std::span<const std::optional<double>> values) {
  std::string text;
  const auto add = [&text](const std::string& broken) {
    if (!text.empty()) text += "; ";
    text += broken;
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputColumn& output = outputs[i];
    if (!is_below(output.below, values[i]))
      add(broken_bound(output, values[i], "is not below", *output.below));
    if (!is_above(output.above, values[i]))
      add(broken_bound(output, values[i], "is not above", *output.above));
  }
  return text;
}

StopWatch::StopWatch(const Model& model, std::span<const StopPlan> stops) {
  for (const StopPlan& stop : stops) stops_.push_back({stop, SignalReader(model, stop.signal)});
}

std::string StopWatch::reason(const Observation& sample) const {
  const auto stopped = [&sample](const Stop& stop, double value, std::string_view relation,
                                 double bound) {
    return fmt::format("stopped at {:.6g} s: {} {}", sample.time, stop.plan.signal,
                       against(value, relation, bound, stop.signal.unit()));
  };
  for (const Stop& stop : stops_) {
    const double value = stop.signal(sample);
    if (stop.plan.above && value > *stop.plan.above)
      return stopped(stop, value, "is above", *stop.plan.above);
    if (stop.plan.below && value < *stop.plan.below)
      return stopped(stop, value, "is below", *stop.plan.below);
  }
  return {};
}

}  // namespace twincraft
