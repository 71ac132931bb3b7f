// See study.h. Tested by tests/compiler/study_test.cpp.
#include "compiler/spec/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compiler/ir/number.h"
#include "compiler/spec/as_written.h"

namespace twincraft {
namespace {

Kind<Method> method() {
  return one_of<Method>({{"euler", Method::kEuler},
                         {"rk2", Method::kRk2},
                         {"rk4", Method::kRk4},
                         {"rkf45", Method::kRkf45},
                         {"rkf78", Method::kRkf78}});
}

const Table<SweepSpec>& sweep_table() {
  static const Table<SweepSpec> table{
      "sweep",
      "A spec path and the values it takes.",
      {
          required("set", &SweepSpec::set, text(),
                   "The path, as in `--set`: `panels.*.segments`, `engines.mujoco.wheel_mass`."),
          required("values", &SweepSpec::values, list_of(any_value(), 1),
                   "Each as it would be written at that path."),
      }};
  return table;
}

const Table<ConfigurationSpec>& configuration_table() {
  static const Table<ConfigurationSpec> table{
      "configuration",
      "An integrator and the steps or tolerances it is run at.",
      {
          required("integrator", &ConfigurationSpec::integrator, method(), "As in `simulation`."),
          optional("step", &ConfigurationSpec::step, maybe(quantity("s", Range::kPositive)),
                   "Of an adaptive method: the interval at which it is sure to land. Default: "
                   "the spec's."),
          required("set", &ConfigurationSpec::set, text(),
                   "What is varied: `simulation.step` of a fixed-step method, "
                   "`simulation.tolerance` of an adaptive one."),
          required("values", &ConfigurationSpec::values, list_of(any_value(), 1),
                   "One run each, with every engine."),
      }};
  return table;
}

const Table<TightRunSpec>& tight_run_table() {
  static const Table<TightRunSpec> table{
      "reference run",
      "The run whose final state is the truth for its own engine.",
      {
          optional("integrator", &TightRunSpec::integrator, method(), "As in `simulation`."),
          optional("step", &TightRunSpec::step, maybe(quantity("s", Range::kPositive)),
                   "Default: the spec's."),
          optional("tolerance", &TightRunSpec::tolerance, number(Range::kPositive),
                   "Absolute and relative."),
      }};
  return table;
}

const Table<FloorCheckSpec>& floor_check_table() {
  static const Table<FloorCheckSpec> table{
      "floor check",
      "The reference once more at another tolerance: their difference is the floor below which an "
      "error means nothing.",
      {optional("tolerance", &FloorCheckSpec::tolerance, number(Range::kPositive),
                "Absolute and relative.")}};
  return table;
}

const Table<WorkPrecisionSpec>& work_precision_table() {
  static const Table<WorkPrecisionSpec> table{
      "work-precision study",
      "What accuracy costs: the error of every configuration's final state against its own "
      "engine's reference, beside the evaluations and the time it took. Members are not judged by "
      "`agreement`.",
      {
          required("configurations", &WorkPrecisionSpec::configurations,
                   list_of(object(configuration_table()), 1), "What is compared."),
          optional("reference", &WorkPrecisionSpec::reference, object(tight_run_table()),
                   "The truth."),
          optional("check", &WorkPrecisionSpec::check, object(floor_check_table()),
                   "How far the truth can be trusted."),
      }};
  return table;
}

std::vector<std::string> study_path(const std::string& set, Span span, Diagnostics& diagnostics) {
  std::vector<std::string> path = parse_path(set, span, diagnostics);
  if (!path.empty() && (path.front() == "study" || path.front() == "format")) {
    diagnostics.error(Code::kStudyPath, span, fmt::format("a study cannot set `{}`", path.front()));
    return {};
  }
  return path;
}

Node scalar_node(std::string text, Span span) {
  Node node;
  node.kind = Node::Kind::kScalar;
  node.span = span;
  node.scalar = std::move(text);
  return node;
}

Override override_of(const char* key, Node value, Span span) {
  return {{"simulation", key}, std::move(value), span};
}

/// A value of `spec` as a change of `simulation`: as written where it was, else the default.
Override from_spec(const Written& spec, const char* key, const std::string& fallback) {
  const bool written = spec.has(key);
  Node value = written ? *spec.node->find(key) : scalar_node(fallback, spec.span());
  const Span span = value.span;
  return override_of(key, std::move(value), span);
}

std::vector<Override> tight_run(const WorkPrecisionSpec& study) {
  const TightRunSpec& reference = study.reference;
  std::vector<Override> run{from_spec(reference, "integrator", "rkf78")};
  if (reference.step) run.push_back(from_spec(reference, "step", {}));
  run.push_back(from_spec(reference, "tolerance", shortest(reference.tolerance)));
  return run;
}

/// Every run of a work-precision study: the configurations, the reference, the check.
std::vector<std::vector<Override>> runs_of(const WorkPrecisionSpec& study,
                                           Diagnostics& diagnostics) {
  std::vector<std::vector<Override>> runs;
  for (const ConfigurationSpec& configuration : study.configurations) {
    const Span span = path_span(configuration);
    const std::vector<std::string> path = study_path(configuration.set, span, diagnostics);
    if (path.empty()) continue;
    for (const Node& value : configuration.values) {
      runs.push_back({from_spec(configuration, "integrator", {})});
      if (configuration.step) runs.back().push_back(from_spec(configuration, "step", {}));
      runs.back().push_back({path, value, span});
    }
  }
  runs.push_back(tight_run(study));
  runs.push_back(tight_run(study));
  runs.back().back() = from_spec(study.check, "tolerance", shortest(study.check.tolerance));
  return runs;
}

/// Saturates, so that no product of lengths wraps around.
std::size_t product(const std::vector<SweepSpec>& sweeps) {
  std::size_t count = 1;
  for (const SweepSpec& sweep : sweeps)
    count = std::min(count * sweep.values.size(), kMaximumMembers + 1);
  return count;
}

std::vector<StudyMembers::Axis> axes_of(const std::vector<SweepSpec>& sweeps,
                                        Diagnostics& diagnostics) {
  std::vector<StudyMembers::Axis> axes;
  for (const SweepSpec& sweep : sweeps) {
    const Span span = path_span(sweep);
    std::vector<std::string> path = study_path(sweep.set, span, diagnostics);
    for (const StudyMembers::Axis& earlier : axes)
      if (!path.empty() && earlier.path == path)
        diagnostics.error(Code::kStudyPath, span, fmt::format("`{}` is swept twice", sweep.set))
            .with_note(earlier.span, "it is first swept here");
    axes.push_back({std::move(path), span, sweep.values});
  }
  return axes;
}

void check_lengths(const std::vector<SweepSpec>& sweeps, Diagnostics& diagnostics) {
  const SweepSpec& first = sweeps.front();
  for (const SweepSpec& sweep : sweeps) {
    if (sweep.values.size() == first.values.size()) continue;
    diagnostics
        .error(Code::kStudyUnequal, sweep.span_of("values"),
               fmt::format("`{}` takes {} values and `{}` {}: `zip` pairs them one to one",
                           sweep.set, sweep.values.size(), first.set, first.values.size()))
        .with_note(first.span_of("values"), "the first list is here")
        .with_hint("`combine: grid` runs every combination");
  }
}

/// Where the path to compare along stands among those that are swept.
std::optional<std::size_t> compared_path(const StudySpec& study, Diagnostics& diagnostics) {
  if (!study.compare) return std::nullopt;
  for (std::size_t i = 0; i < study.sweep.size(); ++i)
    if (study.sweep[i].set == *study.compare) return i;
  diagnostics
      .error(Code::kStudyCompare, study.span_of("compare"),
             fmt::format("`{}` is not swept", *study.compare))
      .with_hint("`compare` takes the `set` of one of the sweeps");
  return std::nullopt;
}

}  // namespace

const Table<StudySpec>& study_table() {
  static const Table<StudySpec> table =
      Table<StudySpec>{
          "study",
          "Many runs of this spec that differ in the values at a few paths. `scsim` runs all "
          "members; `sccompile` checks them (the first 10000, fewer of a large spec) and emits the "
          "spec itself.",
          {
              optional("sweep", &StudySpec::sweep, list_of(object(sweep_table()), 1),
                       "Paths and their values."),
              optional("combine", &StudySpec::combine,
                       one_of<Combine>({{"grid", Combine::kGrid}, {"zip", Combine::kZip}}),
                       "`grid`: every combination, the last path varies fastest. `zip`: the "
                       "first values together, then the second ones."),
              optional(
                  "compare", &StudySpec::compare, maybe(text()),
                  "One of the swept paths. Every member is also held, each engine against itself, "
                  "against the member that has the first value of this path and all else equal "
                  "(`zip`: against the first member). What should make no difference to the "
                  "motion then shows what it makes to an engine."),
              optional("work_precision", &StudySpec::work_precision,
                       maybe(object(work_precision_table())), "What accuracy costs."),
              optional("outputs", &StudySpec::outputs, list_of(object(output_table())),
                       "Of a sweep: numbers that are made of every member's flight."),
          }}
          .exactly_one_of({"sweep", "work_precision"})
          .at_most_one_of({"work_precision", "outputs"});
  return table;
}

std::vector<Override> StudyMembers::overrides(std::size_t index) const {
  if (plan.is_work_precision) return listed[index];
  std::vector<Override> changes(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    const Axis& axis = axes[i];
    const std::size_t count = axis.values.size();
    changes[i] = {axis.path, axis.values[plan.is_grid ? index % count : index], axis.span};
    if (plan.is_grid) index /= count;
  }
  return changes;
}

std::optional<StudyMembers> members_of(const StudySpec& study, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  StudyMembers members;
  if (study.work_precision) {
    members.listed = runs_of(*study.work_precision, diagnostics);
    members.plan.is_work_precision = true;
    members.plan.members = members.listed.size();
  } else {
    members.axes = axes_of(study.sweep, diagnostics);
    for (const SweepSpec& sweep : study.sweep) {
      members.plan.paths.push_back(sweep.set);
      members.plan.lengths.push_back(sweep.values.size());
    }
    members.plan.is_grid = study.combine == Combine::kGrid;
    if (!members.plan.is_grid) check_lengths(study.sweep, diagnostics);
    members.plan.members =
        members.plan.is_grid ? product(study.sweep) : study.sweep.front().values.size();
  }
  members.plan.compare = compared_path(study, diagnostics);
  if (members.plan.members > kMaximumMembers)
    diagnostics.error(Code::kStudyTooLarge, study.span_of("sweep"),
                      fmt::format("the study has more than {} members", kMaximumMembers));
  if (diagnostics.error_count() != errors_before) return std::nullopt;
  return members;
}

Setting setting_of(const Override& override) {
  const Json value = json_of(override.value);
  return {fmt::format("{}", fmt::join(override.path, ".")),
          override.value.is_scalar() ? override.value.scalar : value.dump()};
}

}  // namespace twincraft
