// One function per block of the table; a block without rows is left out.
// Tested by tests/runtime/report_test.cpp.
#include "runtime/report/table.h"

#include <fmt/color.h>
#include <fmt/format.h>

#include <algorithm>

#include "runtime/report/verdict_words.h"
#include "runtime/report/words.h"

namespace twincraft {
namespace {

constexpr std::string_view kRow = "{:<{}} {:<14} {:<11} {:<16} {}";
constexpr std::size_t kLabelWidth = 20;

std::string row(std::string_view label, std::string_view a, std::string_view b, std::string_view c,
                std::string_view d = "", std::size_t label_width = kLabelWidth) {
  std::string line = fmt::format(fmt::runtime(kRow), label, label_width, a, b, c, d);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string indented(std::string_view label) { return fmt::format("  {}", label); }

std::string paint(std::string_view text, fmt::color color, bool colour) {
  return colour ? fmt::format(fmt::fg(color), "{}", text) : std::string(text);
}

/// @param holds  what was compared is the whole run, and it is resolved: else nothing is ok
std::string result_words(std::optional<bool> pass, bool holds, bool colour) {
  if (!pass || (*pass && !holds)) return "";
  return *pass ? paint("ok", fmt::color::green, colour)
               : paint("EXCEEDED", fmt::color::red, colour);
}

bool holds_good(const Member& member) {
  const Verdict verdict = member.verdict();
  return verdict != Verdict::kFailed && verdict != Verdict::kInterrupted &&
         verdict != Verdict::kUnresolved;
}

/// The mass is worth a line only when someone judges it or the engines differ.
bool is_worth_showing(const Metric& metric) {
  return metric.key != "mass_kg" || metric.tolerance || metric.maximum != 0.0;
}

}  // namespace

std::string heading(const Model& model) {
  const std::string depletion = depletion_words(model);
  return fmt::format("{}   {}   {}\n{}{}\n", model.name, vehicle_words(model), plan_words(model),
                     depletion, depletion.empty() ? "" : "\n");
}

std::string difference_block(std::string_view heading, std::span<const DifferenceRow> rows,
                             bool holds, bool colour) {
  std::size_t width = kLabelWidth;
  for (const DifferenceRow& each : rows) width = std::max(width, indented(each.words.label).size());
  std::string text = row(heading, "maximum", "at", "tolerance", "", width);
  for (const auto& [metric, words] : rows) {
    const std::string tolerance =
        metric.tolerance ? fmt::format("{:g} {}", *metric.tolerance, words.unit) : "-";
    text += row(indented(words.label), quantity(metric.maximum, words.unit),
                fmt::format("{:.2f} s", metric.at), tolerance,
                result_words(metric.pass(), holds, colour), width);
  }
  return text;
}

std::string agreement_block(const ReportedMember& member, bool colour) {
  if (!member.result.comparison) return {};
  std::vector<DifferenceRow> rows;
  for (const Metric& metric : member.result.comparison->metrics)
    if (is_worth_showing(metric))
      rows.push_back({metric, words_of(metric.key, member.bundle.model)});
  return difference_block("agreement", rows, holds_good(member.result), colour);
}

namespace {

/// Empty for a reference that judges nothing.
std::string tolerance_words(const Deviation& deviation, std::string_view unit, bool holds,
                            bool colour) {
  if (!deviation.tolerance) return {};
  return fmt::format("{:<14} {}", fmt::format("{:g} {}", *deviation.tolerance, unit),
                     result_words(deviation.pass(), holds, colour));
}

std::string reference_label(const ReferenceRun& run, const Deviation& deviation,
                            const Model& model) {
  const std::string label = words_of(deviation.metric, model).label;
  // A reference speaks of its own point where a metric speaks of the hub.
  const std::string what = label.starts_with("hub ") ? label.substr(4) : label;
  return indented(run.name + " " + what);
}

std::string reference_block(const ReportedMember& member, bool colour) {
  if (member.result.references.empty()) return {};
  const Model& model = member.bundle.model;
  std::size_t width = kLabelWidth;
  for (const ReferenceRun& run : member.result.references)
    for (const Deviation& deviation : run.deviations)
      width = std::max(width, reference_label(run, deviation, model).size());
  std::string text = row("reference", "maximum", "at", "engine", "", width);
  for (const ReferenceRun& run : member.result.references)
    for (const Deviation& deviation : run.deviations) {
      const std::string unit = words_of(deviation.metric, model).unit;
      text += row(reference_label(run, deviation, model), quantity(deviation.max, unit),
                  fmt::format("{:.2f} s", deviation.at), engine_label(run.engine),
                  tolerance_words(deviation, unit, holds_good(member.result), colour), width);
    }
  return text;
}

std::string conservation_block(const ReportedMember& member, bool colour) {
  const Member& result = member.result;
  if (result.conservation.empty()) return {};
  const auto any_judged = std::ranges::any_of(
      result.conservation, [](const Balance& balance) { return balance.tolerance.has_value(); });
  std::string text =
      row("conservation", kEngines[0].label, kEngines[1].label, any_judged ? "tolerance" : "");
  for (const Balance& balance : result.conservation) {
    const BalanceRow& of = *find_balance(balance.key);
    const auto cell = [&](const EngineRun& run) -> std::string {
      if (run.trajectory.samples.empty()) return "-";
      return quantity(run.conservation.*of.imbalance, "");
    };
    text += row(indented(of.label), cell(result.engines[0]), cell(result.engines[1]),
                balance.tolerance ? fmt::format("{:g} relative", *balance.tolerance) : "relative",
                result_words(balance.pass(), holds_good(result), colour));
  }
  if (member.bundle.model.simulation.translation) return text;
  const auto own = [](const EngineRun& run) -> std::string {
    return run.trajectory.samples.empty() ? "-" : quantity(run.own_energy.relative, "");
  };
  return text + row(indented("own motion"), own(result.engines[0]), own(result.engines[1]),
                    "drift over exchanged energy");
}

std::string scatter_words(const EngineTiming& timing) {
  if (!(timing.spread() > kScattered)) return {};
  return fmt::format("trials scatter by {:.0f} %: no ratio", 100.0 * timing.spread());
}

std::string cost_block(const Member& result) {
  if (!result.timing || !result.timing->complete() || result.timing->engines.empty()) return {};
  std::string text = row("cost", "per step", "whole run", "evaluations");
  const std::optional<double> ratio = result.timing->ratio();
  for (const EngineTiming& timing : result.timing->engines) {
    const EngineKind kind = engine_of(timing.name);
    const bool is_mujoco = kind == EngineKind::kMujoco;
    const EngineRun& run = result.engines[static_cast<std::size_t>(kind)];
    text += row(indented(engine_label(timing.name)), duration(timing.per_step()),
                duration(timing.median()), fmt::format("{}", run.trajectory.counts.evaluations),
                is_mujoco && ratio ? fmt::format("{:.3g}x", 1.0 / *ratio) : scatter_words(timing));
  }
  text += fmt::format(
      "  median of {} timed trials per engine after the run; `--no-timing` skips them\n",
      result.timing->planned_trials);
  return text;
}

std::vector<std::string> remarks_of(const Member& result) {
  return result.resolution ? result.resolution->remarks : std::vector<std::string>();
}

}  // namespace

std::string report_table(const ReportedMember& member, bool colour) {
  std::string text = heading(member.bundle.model);
  text += agreement_block(member, colour);
  text += reference_block(member, colour);
  text += conservation_block(member, colour);
  text += cost_block(member.result);
  for (const std::string& remark : remarks_of(member.result)) text += "note: " + remark + "\n";
  return text + "\n" + verdict_line(member.result, colour) + "\n";
}

}  // namespace twincraft
