// See simulation.h. Tested by tests/compiler/simulation_test.cpp.
#include "compiler/spec/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

constexpr double kMostSteps = 1e12;
constexpr double kMostSamples = 1e7;
// What an engine's samples may take: some gigabytes, of a machine that runs two engines [B].
constexpr double kMostSampleBytes = 6e9;
constexpr double kSamples = 200.0;               // of a run without `record`
constexpr double kWholeStepsTolerance = 1.0e-9;  // relative: durations are written in decimals

const Table<StepRule>& rule_table() {
  static const Table<StepRule> table{
      "step rule",
      "A step that follows a component's own period.",
      {
          required("per_period", &StepRule::per_period, number(Range::kPositive),
                   "Steps in one period."),
          required("of", &StepRule::of, reference_to("oscillator"),
                   "Whose period counts. A panel: its segment's, 2 pi sqrt((I + m d^2)/k), with "
                   "several stiffnesses the shortest. A particle: 2 pi sqrt(m/k). A pendulum: "
                   "2 pi sqrt(L/a), a the thrust at t = 0 over the vehicle's mass. Where dampers "
                   "are faster than springs, the step also stays below 1.8 time constants of the "
                   "fastest one, as no longer step is stable."),
          optional("maximum", &StepRule::maximum, maybe(quantity("s", Range::kPositive)),
                   "The step is never longer; default no limit."),
      }};
  return table;
}

const Table<AbsoluteRelative>& parts_table() {
  static const Table<AbsoluteRelative> table{
      "tolerance parts",
      "The error allowed is absolute + relative * size of the block.",
      {
          optional("absolute", &AbsoluteRelative::absolute, number(Range::kNotNegative),
                   "In SI units of the block."),
          optional("relative", &AbsoluteRelative::relative, number(Range::kNotNegative),
                   "As a part of the block's size."),
      }};
  return table;
}

Kind<ToleranceSpec> tolerance() {
  return either(is_section, object(parts_table()), number(Range::kPositive));
}

struct Block {
  const char* key;
  ToleranceSpec BlockTolerancesSpec::*spec;
  Tolerance BlockTolerances::*plan;
  const char* doc;
};

constexpr Block kBlocks[] = {
    {"position", &BlockTolerancesSpec::position, &BlockTolerances::position, "Of B [m]."},
    {"velocity", &BlockTolerancesSpec::velocity, &BlockTolerances::velocity, "Of B [m/s]."},
    {"attitude", &BlockTolerancesSpec::attitude, &BlockTolerances::attitude,
     "Of the attitude's parameters [1]."},
    {"rate", &BlockTolerancesSpec::rate, &BlockTolerances::rate, "Of the body rate [rad/s]."},
    {"joint", &BlockTolerancesSpec::joint, &BlockTolerances::joint,
     "Of joint coordinates [rad] or [m]."},
    {"joint_rate", &BlockTolerancesSpec::joint_rate, &BlockTolerances::joint_rate,
     "Of joint rates [rad/s] or [m/s]."},
    {"wheel", &BlockTolerancesSpec::wheel, &BlockTolerances::wheel, "Of wheel speeds [rad/s]."},
};

const Table<BlockTolerancesSpec>& blocks_table() {
  const auto fields = [] {
    std::vector<Field<BlockTolerancesSpec>> all;
    for (const Block& block : kBlocks) {
      all.push_back(optional(block.key, block.spec, tolerance(), block.doc));
    }
    return all;
  };
  static const Table<BlockTolerancesSpec> table{
      "block tolerances",
      "Error control per block of the state: a number for both parts, or the parts.",
      std::span<const Field<BlockTolerancesSpec>>(fields())};
  return table;
}

// Every explicit method here is stable up to a step of 2 time constants of a damper; less a tenth,
// because the rate that counts is the whole vehicle's.
constexpr double kMostDecay = 1.8;

const Oscillator* find(const std::vector<Oscillator>& oscillators, const std::string& name) {
  const auto found = std::find_if(oscillators.begin(), oscillators.end(),
                                  [&](const Oscillator& each) { return each.name == name; });
  return found == oscillators.end() ? nullptr : &*found;
}

double step_of_rule(const StepRule& rule, const Oscillator& oscillator) {
  double step = oscillator.period.value() / rule.per_period;
  if (oscillator.decay > 0.0) step = std::min(step, kMostDecay / oscillator.decay);
  return rule.maximum ? std::min(*rule.maximum, step) : step;
}

/// @return whether the rule gives a step
bool check_rule(const StepRule& rule, const std::vector<Oscillator>& oscillators,
                Diagnostics& diagnostics) {
  const Oscillator* oscillator = find(oscillators, rule.of);
  if (oscillator == nullptr) {
    std::vector<std::string> names;
    for (const Oscillator& candidate : oscillators) names.push_back(candidate.name);
    const std::string near = nearest(rule.of, names);
    Diagnostic& unknown =
        diagnostics.error(Code::kUnknownComponent, rule.span_of("of"),
                          fmt::format("`{}` is no panel, particle or pendulum", rule.of));
    if (!near.empty()) unknown.with_hint(fmt::format("did you mean `{}`?", near));
    return false;
  }
  if (oscillator->period) return true;
  diagnostics
      .error(Code::kNoPeriod, rule.span_of("of"),
             fmt::format("{} has no period: {}", oscillator->who, oscillator->lack))
      .with_note(oscillator->span, fmt::format("{} is here", oscillator->who));
  return false;
}

void check_step(const SimulationSpec& simulation, double step, Diagnostics& diagnostics) {
  const Span span = simulation.span_of("step");
  const double steps = simulation.duration / step;
  if (step > simulation.duration) {
    diagnostics
        .error(Code::kStepTooLong, span,
               fmt::format("a step of {} s is longer than the duration of {} s", shortest(step),
                           shortest(simulation.duration)))
        .with_note(simulation.span_of("duration"), "`duration` is written here");
    return;
  }
  if (steps > kMostSteps) {
    diagnostics.error(
        Code::kTooManySteps, span,
        fmt::format("a step of {} s makes {:.3g} steps of the duration of {} s, more "
                    "than {:g}",
                    shortest(step), steps, shortest(simulation.duration), kMostSteps));
    return;
  }
  if (std::abs(steps - std::round(steps)) <= kWholeStepsTolerance * steps) return;
  const std::string message =
      fmt::format("a step of {} s does not divide the duration of {} s: the last step is shortened",
                  shortest(step), shortest(simulation.duration));
  // Nobody chose the very value that a rule gives, so it is no reason to warn.
  if (std::holds_alternative<StepRule>(simulation.step)) {
    diagnostics.note(Code::kStepDoesNotDivide, span, message);
  } else {
    diagnostics.warning(Code::kStepDoesNotDivide, span, message);
  }
}

/// A sample holds the whole state: some fifty numbers, and two of each joint.
void check_record(const SimulationSpec& simulation, double step, int coordinates,
                  Diagnostics& diagnostics) {
  if (!simulation.record) return;
  const double sample_bytes = 400.0 + 16.0 * coordinates;
  const double most = std::min(kMostSamples, std::floor(kMostSampleBytes / sample_bytes));
  const double samples = simulation.duration / std::max(*simulation.record, step);
  if (samples <= most) return;
  diagnostics
      .error(Code::kTooManySteps, simulation.span_of("record"),
             fmt::format("{:.3g} samples would be recorded, more than {:.3g}", samples, most))
      .with_hint(
          fmt::format("raise `record` to {:.3g} s or more", 1.01 * simulation.duration / most));
}

Tolerance parts(const ToleranceSpec& spec) {
  if (const double* both = std::get_if<double>(&spec)) return {*both, *both};
  const AbsoluteRelative& written = std::get<AbsoluteRelative>(spec);
  return {written.absolute, written.relative};
}

void check_tolerance(const ToleranceSpec& spec, Span span, Diagnostics& diagnostics) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const Tolerance tolerance = parts(spec);
  if (tolerance.absolute == 0.0 && tolerance.relative == 0.0) {
    diagnostics.error(Code::kToleranceTooSmall, span, "a tolerance of zero can never be met");
  } else if (tolerance.relative > 0.0 && tolerance.relative < kEpsilon) {
    diagnostics.error(Code::kToleranceTooSmall, span,
                      fmt::format("a relative tolerance of {} is below the rounding of doubles, {}",
                                  shortest(tolerance.relative), shortest(kEpsilon)));
  }
}

void check_tolerances(const SimulationSpec& simulation, Diagnostics& diagnostics) {
  if (const double* all = std::get_if<double>(&simulation.tolerance)) {
    check_tolerance(*all, simulation.span_of("tolerance"), diagnostics);
    return;
  }
  const auto& blocks = std::get<BlockTolerancesSpec>(simulation.tolerance);
  for (const Block& block : kBlocks) {
    check_tolerance(blocks.*block.spec, blocks.span_of(block.key), diagnostics);
  }
}

BlockTolerances tolerances(const SimulationSpec& simulation) {
  const auto* blocks = std::get_if<BlockTolerancesSpec>(&simulation.tolerance);
  BlockTolerances plan;
  for (const Block& block : kBlocks) {
    plan.*block.plan = blocks != nullptr ? parts(blocks->*block.spec)
                                         : parts(std::get<double>(simulation.tolerance));
  }
  return plan;
}

/// The shortest whole number of steps that makes no more than kSamples records.
double default_record(double step, double duration) {
  return step * std::max(1.0, std::ceil(duration / kSamples / step * (1.0 - kWholeStepsTolerance)));
}

}  // namespace

const Table<SimulationSpec>& simulation_table() {
  static const Table<SimulationSpec> table{
      "simulation",
      "How the run is made, the same for both engines.",
      {
          optional("mode", &SimulationSpec::mode,
                   one_of<SimulationMode>({{"full", SimulationMode::kFull},
                                           {"translation", SimulationMode::kTranslation}}),
                   "`full`: translation, rotation and all coordinates. `translation`: the hub as a "
                   "point mass without attitude, its axes along those of N; it carries nothing but "
                   "loads, whose forces act on it."),
          optional("integrator", &SimulationSpec::integrator,
                   one_of<Method>({{"euler", Method::kEuler},
                                   {"rk2", Method::kRk2},
                                   {"rk4", Method::kRk4},
                                   {"rkf45", Method::kRkf45},
                                   {"rkf78", Method::kRkf78}}),
                   "`rkf45` and `rkf78` choose their steps by `tolerance`, the others are fixed."),
          required(
              "step", &SimulationSpec::step,
              either(is_section, object(rule_table()), quantity("s", Range::kPositive)),
              "The fixed step, or the interval at which an adaptive method is sure to land; or "
              "a rule for it."),
          optional("tolerance", &SimulationSpec::tolerance,
                   either(is_section, object(blocks_table()), number(Range::kPositive)),
                   "Of adaptive methods: one number, absolute and relative alike, or per block."),
          required("duration", &SimulationSpec::duration, quantity("s", Range::kPositive),
                   "From t = 0."),
          optional("record", &SimulationSpec::record, maybe(quantity("s", Range::kPositive)),
                   "Interval of recorded samples; below `step` every step is recorded. Default: "
                   "whole steps, about 200 samples."),
          optional("resolution", &SimulationSpec::judges_resolution,
                   one_of<bool>({{"judge", true}, {"report", false}}),
                   "`judge` (default): a step or tolerance that does not resolve the vehicle's own "
                   "motion makes the verdict `unresolved`, whatever the engines agree on. "
                   "`report`: it is said and does not touch the verdict."),
      }};
  return table;
}

double step_of(const SimulationSpec& simulation, const std::vector<Oscillator>& oscillators) {
  const StepRule* rule = std::get_if<StepRule>(&simulation.step);
  if (rule == nullptr) return std::get<double>(simulation.step);
  return step_of_rule(*rule, *find(oscillators, rule->of));
}

void check(const SimulationSpec& simulation, const std::vector<Oscillator>& oscillators,
           int coordinates, Diagnostics& diagnostics) {
  check_tolerances(simulation, diagnostics);
  const StepRule* rule = std::get_if<StepRule>(&simulation.step);
  if (rule != nullptr && !check_rule(*rule, oscillators, diagnostics)) return;
  const double step = step_of(simulation, oscillators);
  check_step(simulation, step, diagnostics);
  check_record(simulation, step, coordinates, diagnostics);
}

SimulationPlan lower(const SimulationSpec& simulation, const std::vector<Oscillator>& oscillators) {
  SimulationPlan plan;
  plan.translation = simulation.mode == SimulationMode::kTranslation;
  plan.method = simulation.integrator;
  plan.step = step_of(simulation, oscillators);
  plan.duration = simulation.duration;
  plan.record = simulation.record.value_or(default_record(plan.step, plan.duration));
  plan.tolerance = tolerances(simulation);
  plan.judges_resolution = simulation.judges_resolution;
  return plan;
}

}  // namespace twincraft
