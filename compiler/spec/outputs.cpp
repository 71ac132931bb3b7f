// See outputs.h.
#include "compiler/spec/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "compiler/ir/signals.h"
#include "compiler/spec/as_written.h"

namespace twincraft {
namespace {

/// Columns that every table of members has.
constexpr std::array<std::string_view, 4> kTaken{"member", "verdict", "reason", "seconds"};

const char* const kOfTheSignal = "quantity of the signal";

const Table<RequireSpec>& require_table() {
  static const Table<RequireSpec> table{
      "requirement",
      "What a number must be. A member that breaks it is named with its reason, and the run exits "
      "with 1; its verdict is not touched.",
      {
          optional("below", &RequireSpec::below, maybe(any_quantity("quantity of the output")),
                   "It must be smaller."),
          optional("above", &RequireSpec::above, maybe(any_quantity("quantity of the output")),
                   "It must be larger."),
      }};
  return table;
}

Kind<Reduce> reduction() {
  return one_of<Reduce>({{"max", Reduce::kMax},
                         {"min", Reduce::kMin},
                         {"max_abs", Reduce::kMaxAbs},
                         {"max_norm", Reduce::kMaxNorm},
                         {"final", Reduce::kFinal},
                         {"mean", Reduce::kMean},
                         {"rms", Reduce::kRms},
                         {"settling_time", Reduce::kSettlingTime},
                         {"first_crossing", Reduce::kFirstCrossing}});
}

bool is_time(Reduce reduce) {
  return reduce == Reduce::kSettlingTime || reduce == Reduce::kFirstCrossing;
}

struct Found {
  std::string unit;
  bool is_vector = false;
};

/// Of outputs_of(): a number, or a vector by its own name.
std::optional<Found> find_signal(const std::string& name, Span span, const Model& model,
                                 Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const OutputSignal& signal : outputs_of(model)) {
    if (signal.name == name) return Found{signal.unit, signal.size() > 1};
    known.push_back(signal.name);
    for (std::size_t i = 0; i < signal.size() && signal.size() > 1; ++i) {
      if (signal.component(i) == name) return Found{signal.unit, false};
      known.push_back(signal.component(i));
    }
  }
  const std::string near = nearest(name, known);
  diagnostics
      .error(Code::kOutputSignal, span,
             fmt::format("{} is no output of this vehicle", in_backticks(name)))
      .with_hint(near.empty() ? "outputs are the columns of bsm.csv, without their units"
                              : fmt::format("did you mean `{}`?", near));
  return std::nullopt;
}

bool check_shape(const OutputSpec& output, const Found& signal, Diagnostics& diagnostics) {
  const bool wants_vector = output.reduce == Reduce::kMaxNorm;
  if (wants_vector == signal.is_vector) return true;
  diagnostics
      .error(Code::kOutputSignal, output.span_of("of"),
             wants_vector ? fmt::format("`{}` is one number, `max_norm` takes a vector", output.of)
                          : fmt::format("`{}` is a vector, which only `max_norm` takes", output.of))
      .with_hint(wants_vector ? "`max_abs` takes the largest magnitude of a number"
                              : fmt::format("name one of its numbers, such as `{}.x`", output.of));
  return false;
}

/// A key that one reduction needs and the others do not have.
void check_own_key(const OutputSpec& output, const char* key, bool is_needed,
                   Diagnostics& diagnostics) {
  if (output.has(key) == is_needed) return;
  const std::string who = fmt::format("output `{}`", output.name);
  if (is_needed)
    diagnostics.error(Code::kMissingKey, output.span(),
                      fmt::format("`{}` is missing in {}", key, who));
  else
    diagnostics.error(Code::kOutputForm, output.span_of(key),
                      fmt::format("`{}` says nothing about the reduction of {}", key, who));
}

/// The quantity under `key`, nothing when it is not written or has a fault.
std::optional<double> bound(const std::optional<Node>& written, const char* key,
                            const std::string& unit, const std::string& whose,
                            Diagnostics& diagnostics) {
  if (!written) return std::nullopt;
  ReadContext context{diagnostics, fmt::format("`{}` of {}", key, whose)};
  return read_quantity(*written, unit, {}, context);
}

void check_bounds(const std::optional<double>& below, const std::optional<double>& above,
                  const Written& where, const std::string& whose, Diagnostics& diagnostics) {
  if (!where.has("below") && !where.has("above")) {
    diagnostics.error(Code::kMissingKey, where.span(), fmt::format("{} has no bound", whose))
        .with_hint("write `below`, `above` or both");
  }
  if (!below || !above || *above < *below) return;
  diagnostics.error(Code::kOutputForm, where.span_of("above"),
                    fmt::format("nothing is above and below the bounds of {}", whose));
}

/// Under a name of its own.
void check_name(const OutputSpec& output, const std::vector<OutputSpec>& outputs,
                Diagnostics& diagnostics) {
  if (std::ranges::find(kTaken, output.name) != kTaken.end())
    diagnostics.error(Code::kOutputForm, output.span_of("name"),
                      fmt::format("`{}` is a column that every table has", output.name));
  const auto first = std::ranges::find(outputs, output.name, &OutputSpec::name);
  if (&*first == &output) return;
  diagnostics
      .error(Code::kOutputForm, output.span_of("name"),
             fmt::format("two outputs are called `{}`", output.name))
      .with_note(first->span_of("name"), "the first is here");
}

OutputPlan plan_of(const OutputSpec& output, const Found& signal, Diagnostics& diagnostics) {
  const std::string whose = fmt::format("output `{}`", output.name);
  OutputPlan plan;
  plan.name = output.name;
  plan.signal = output.of;
  plan.reduce = output.reduce;
  plan.unit = is_time(output.reduce) ? "s" : signal.unit;
  plan.within = bound(output.within, "within", signal.unit, whose, diagnostics).value_or(0.0);
  plan.level = bound(output.level, "level", signal.unit, whose, diagnostics).value_or(0.0);
  if (output.within && plan.within < 0.0)
    diagnostics.error(Code::kOutOfRange, output.span_of("within"),
                      fmt::format("`within` of {} is negative", whose));
  if (!output.require) return plan;
  plan.below = bound(output.require->below, "below", plan.unit, whose, diagnostics);
  plan.above = bound(output.require->above, "above", plan.unit, whose, diagnostics);
  check_bounds(plan.below, plan.above, *output.require, fmt::format("`require` of {}", whose),
               diagnostics);
  return plan;
}

}  // namespace

const Table<OutputSpec>& output_table() {
  static const Table<OutputSpec> table{
      "output",
      "One number made of a signal over the run of the analytic engine: of its recorded samples "
      "and "
      "its last state.",
      {
          required("name", &OutputSpec::name, name(), "Of its column."),
          required("of", &OutputSpec::of, text(),
                   "The signal: a column of bsm.csv without its unit, such as `wing_p.1.position` "
                   "or `omega_BN_B.x`; with `max_norm` a vector, `omega_BN_B`."),
          required("reduce", &OutputSpec::reduce, reduction(),
                   "`max`, `min`, `max_abs`: extremes; `max_norm`: the largest length of a vector; "
                   "`final`: the last; `mean`, `rms`: over time; `settling_time`: from when on it "
                   "stays within `within` of its final value; `first_crossing`: when it first "
                   "passes `level`. What is never reached is an empty cell."),
          optional("within", &OutputSpec::within, maybe(any_quantity(kOfTheSignal)),
                   "Of `settling_time`."),
          optional("level", &OutputSpec::level, maybe(any_quantity(kOfTheSignal)),
                   "Of `first_crossing`."),
          optional("require", &OutputSpec::require, maybe(object(require_table())),
                   "What the number must be."),
      }};
  return table;
}

const Table<StopSpec>& stop_table() {
  static const Table<StopSpec> table{
      "stop",
      "Ends a member at the first sample in which a signal is beyond a bound.",
      {
          required("of", &StopSpec::of, text(), "The signal, one number."),
          optional("below", &StopSpec::below, maybe(any_quantity(kOfTheSignal)),
                   "It ends when the signal is smaller."),
          optional("above", &StopSpec::above, maybe(any_quantity(kOfTheSignal)),
                   "It ends when the signal is larger."),
      }};
  return table;
}

std::vector<OutputPlan> plan_of(const std::vector<OutputSpec>& outputs, const Model& model,
                                Diagnostics& diagnostics) {
  std::vector<OutputPlan> plans;
  for (const OutputSpec& output : outputs) {
    check_name(output, outputs, diagnostics);
    check_own_key(output, "within", output.reduce == Reduce::kSettlingTime, diagnostics);
    check_own_key(output, "level", output.reduce == Reduce::kFirstCrossing, diagnostics);
    const auto signal = find_signal(output.of, output.span_of("of"), model, diagnostics);
    if (!signal || !check_shape(output, *signal, diagnostics)) continue;
    plans.push_back(plan_of(output, *signal, diagnostics));
  }
  return plans;
}

std::vector<StopPlan> plan_of(const std::vector<StopSpec>& stops, const Model& model,
                              Diagnostics& diagnostics) {
  std::vector<StopPlan> plans;
  for (const StopSpec& stop : stops) {
    const auto signal = find_signal(stop.of, stop.span_of("of"), model, diagnostics);
    if (!signal) continue;
    if (signal->is_vector) {
      diagnostics
          .error(Code::kOutputSignal, stop.span_of("of"),
                 fmt::format("`{}` is a vector, a stop takes one number", stop.of))
          .with_hint(fmt::format("name one of its numbers, such as `{}.x`", stop.of));
      continue;
    }
    const std::string whose = fmt::format("the stop by `{}`", stop.of);
    StopPlan plan{.signal = stop.of,
                  .below = bound(stop.below, "below", signal->unit, whose, diagnostics),
                  .above = bound(stop.above, "above", signal->unit, whose, diagnostics)};
    check_bounds({}, {}, stop, whose, diagnostics);
    plans.push_back(std::move(plan));
  }
  return plans;
}

}  // namespace twincraft
