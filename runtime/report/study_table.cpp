// See study_table.h: rows of cells, every column as wide as its widest cell.
// Tested by tests/runtime/sweep_test.cpp.
#include "runtime/report/study_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "runtime/report/columns.h"
#include "runtime/report/verdict_words.h"
#include "runtime/report/words.h"

namespace twincraft {
namespace {

/// A study of a million members is a file, not a page.
constexpr std::size_t kShownMembers = 200;

/// `step` of `simulation.step`.
std::string last_step(const std::string& path) { return path.substr(path.rfind('.') + 1); }

/// The last step of a path, or its last two where another path ends alike.
std::string column_name(const std::string& path, const std::vector<std::string>& paths) {
  const auto ends_alike = [&path](const std::string& other) {
    return other != path && last_step(other) == last_step(path);
  };
  const std::size_t dot = path.rfind('.');
  if (dot == std::string::npos || std::none_of(paths.begin(), paths.end(), ends_alike))
    return last_step(path);
  return path.substr(path.rfind('.', dot - 1) + 1);
}

/// As written; a long vector by its length.
std::string setting_cell(const Setting& setting) {
  const bool is_long = setting.text.size() > 24;
  return is_long && setting.value ? fmt::format("|{:.6g}|", *setting.value) : setting.text;
}

const Metric* find_metric(const Member& member, std::string_view key) {
  if (!member.comparison) return nullptr;
  for (const Metric& metric : member.comparison->metrics)
    if (metric.key == key) return &metric;
  return nullptr;
}

std::string metric_cell(const ReportedMember& member, const Metric* metric) {
  if (metric == nullptr) return "-";
  return quantity(metric->maximum, words_of(metric->key, member.bundle.model).unit);
}

/// What uses most of its tolerance, and how much of it: a metric of the agreement, a balance, or an
/// engine's deviation from a reference.
struct WorstPart {
  std::string label;
  double part = -1.0;

  void see(const std::string& what, double found, double tolerance) {
    const double candidate = found == 0.0 ? 0.0 : found / tolerance;
    if (std::isnan(part) || candidate <= part) return;
    part = candidate;
    label = what;
  }
};

std::string worst_cell(const ReportedMember& member) {
  WorstPart worst;
  for (const JudgedFigure& figure : member.result.judged())
    worst.see(figure.reference.empty() ? words_of(figure.key, member.bundle.model).label
                                       : figure.reference,
              figure.maximum, figure.tolerance);
  return worst.label.empty() ? "-" : fmt::format("{} {:.2g}", worst.label, worst.part);
}

std::string step_cell(const Member& member, std::string_view engine) {
  if (!member.timing || !member.timing->complete()) return "-";
  for (const EngineTiming& timing : member.timing->engines)
    if (timing.name == engine) return duration(timing.per_step());
  return "-";
}

std::string ratio_cell(const Member& member) {
  const std::optional<double> ratio = member.timing ? member.timing->ratio() : std::nullopt;
  return ratio ? fmt::format("{:.3g}x", 1.0 / *ratio) : "-";
}

std::string reference_cell(const ReportedMember& member, std::string_view engine) {
  for (const ReferenceRun& run : member.result.references)
    if (run.engine == engine && !run.deviations.empty()) {
      const Deviation& deviation = run.deviations.front();
      return quantity(deviation.max, words_of(deviation.metric, member.bundle.model).unit);
    }
  return "-";
}

/// Attitude of an engine against its own baseline; position where there is no attitude.
std::string against_cell(const ReportedMember& member, std::string_view engine) {
  if (!member.against) return "-";
  if (std::ranges::find(member.against->failed, engine) != member.against->failed.end())
    return "no baseline";
  for (const Baseline::OfEngine& of : member.against->engines) {
    if (of.engine != engine) continue;
    const Metric& metric = of.comparison.metrics.front();
    return quantity(metric.maximum, words_of(metric.key, member.bundle.model).unit);
  }
  return "-";
}

/// With a mark where it breaks what is required of it.
std::string output_cell(const ReportedMember& member, std::size_t i) {
  if (i >= member.outputs.size()) return "-";
  const OutputValue& output = member.outputs[i];
  const std::string value = output.value ? quantity(*output.value, output.unit) : "never";
  return output.holds ? value : value + " BROKEN";
}

/// The columns of a sweep: heading and what each member has in it.
struct Column {
  std::string heading;
  std::function<std::string(const ReportedMember&)> cell;
};

std::vector<Column> columns_of(const Report& report) {
  std::vector<Column> columns;
  for (const std::string& path : report.study->paths)
    columns.push_back(
        {column_name(path, report.study->paths), [path](const ReportedMember& member) {
           const Setting* setting = find_setting(member.settings, path);
           return setting != nullptr ? setting_cell(*setting) : std::string("-");
         }});
  columns.push_back({"attitude", [](const ReportedMember& member) {
                       return metric_cell(member, find_metric(member.result, "attitude_deg"));
                     }});
  columns.push_back({"system CoM", [](const ReportedMember& member) {
                       return metric_cell(member, find_metric(member.result, "com_position_m"));
                     }});
  if (report.study->compare)
    for (const EngineName& engine : kEngines)
      columns.push_back(
          {fmt::format("{} by itself", engine.label),
           [key = engine.key](const ReportedMember& member) { return against_cell(member, key); }});
  for (std::size_t i = 0; i < report.study->outputs.size(); ++i)
    columns.push_back({report.study->outputs[i].name,
                       [i](const ReportedMember& member) { return output_cell(member, i); }});
  if (report.summary()->is_judged()) columns.push_back({"worst, of tolerance", worst_cell});
  const std::vector<ReferenceRun>& references = report.members.front().result.references;
  if (!references.empty())
    for (const EngineName& engine : kEngines)
      columns.push_back({fmt::format("{} {}", engine.label, references.front().name),
                         [key = engine.key](const ReportedMember& member) {
                           return reference_cell(member, key);
                         }});
  if (report.members.front().result.timing) {
    for (const EngineName& engine : kEngines)
      columns.push_back(
          {fmt::format("{} step", engine.label), [key = engine.key](const ReportedMember& member) {
             return step_cell(member.result, key);
           }});
    columns.push_back(
        {"ratio", [](const ReportedMember& member) { return ratio_cell(member.result); }});
  }
  columns.push_back(
      {"verdict", [](const ReportedMember& member) { return verdict_cell(member.result); }});
  return columns;
}

std::string sweep_block(const Report& report) {
  const std::vector<Column> columns = columns_of(report);
  std::vector<Row> rows(1);
  for (const Column& column : columns) rows[0].push_back(column.heading);
  const std::size_t shown = std::min(report.members.size(), kShownMembers);
  for (std::size_t i = 0; i < shown; ++i) {
    rows.emplace_back();
    for (const Column& column : columns) rows.back().push_back(column.cell(report.members[i]));
  }
  std::string text = aligned(rows);
  const std::size_t all = report.summary()->members();
  if (shown < all) text += fmt::format("  ... and {} more, in report.json\n", all - shown);
  return text;
}

/// @param among_paths  several paths were swept, so it takes saying which one this is about
std::string trend_label(const Trend& trend, const Model& model, bool among_paths) {
  std::string label = engine_label(trend.engine);
  if (!trend.metric.empty()) {
    std::string metric = words_of(trend.metric, model).label;
    // A reference speaks of the system's centre of mass where a metric speaks of the hub.
    if (!trend.reference.empty() && metric.starts_with("hub ")) metric.erase(0, 4);
    label = trend.reference.empty()
                ? metric
                : fmt::format("{} {}, {}", trend.reference, metric, engine_label(trend.engine));
  }
  if (among_paths) label += fmt::format(" over {}", last_step(trend.path));
  for (const Setting& other : trend.others)
    label += fmt::format(", {} {}", last_step(other.path), other.text);
  return label;
}

/// Between two neighbours.
std::string exponent_cell(const Trend& trend, std::size_t i) {
  if (trend.is_rounding[i] || trend.is_rounding[i + 1]) return "rounding";
  return std::isnan(trend.exponents[i]) ? "-" : fmt::format("{:.2f}", trend.exponents[i]);
}

std::string trends_block(std::string_view title, const std::vector<Trend>& trends,
                         const Report& report) {
  if (trends.empty()) return {};
  std::vector<Row> rows;
  std::size_t longest = 0;
  for (const Trend& trend : trends) longest = std::max(longest, trend.exponents.size());
  for (const Trend& trend : trends) {
    rows.push_back(
        {trend_label(trend, report.members.front().bundle.model, report.study->paths.size() > 1)});
    for (std::size_t i = 0; i < trend.exponents.size(); ++i)
      rows.back().push_back(exponent_cell(trend, i));
    rows.back().resize(1 + longest);
  }
  return fmt::format("\n{}\n{}", title, aligned(rows));
}

std::string configuration_words(const std::vector<Setting>& settings) {
  std::string words;
  for (const Setting& setting : settings)
    if (setting.path.starts_with("simulation.")) {
      if (!words.empty()) words += ", ";
      const std::string key = last_step(setting.path);
      words += key == "integrator" ? setting.text : key + " " + setting.text;
    }
  return words;
}

std::string error_cell(const WorkPoint& point) {
  if (point.diverged) return "diverged";
  return quantity(point.error.attitude, "deg") + (point.on_frontier ? " *" : "");
}

std::string cost_cell(const WorkPoint& point) {
  if (point.diverged) return "-";
  return point.median ? duration(*point.median) : fmt::format("{} ev.", point.evaluations);
}

std::string work_precision_block(const Report& report) {
  const std::vector<EngineWork> engines = study_results(report).work_precision;
  if (engines.empty()) return "  no reference run ended well: there is nothing to hold against\n";
  const std::shared_ptr<const StudyRecord> all = report.summary();
  std::vector<Row> rows{{"configuration"}};
  for (const EngineWork& work : engines)
    for (const char* what : {"error", "cost"})
      rows[0].push_back(fmt::format("{} {}", engine_label(work.engine), what));
  const std::size_t configurations = engines.front().points.size();
  const std::size_t shown = std::min(configurations, kShownMembers);
  for (std::size_t i = 0; i < shown; ++i) {
    rows.push_back({configuration_words(all->points().all()[i].settings)});
    for (const EngineWork& work : engines) {
      rows.back().push_back(error_cell(work.points[i]));
      rows.back().push_back(cost_cell(work.points[i]));
    }
  }
  rows.push_back({"floor"});
  for (const EngineWork& work : engines) {
    rows.back().push_back(quantity(work.floor.attitude, "deg"));
    rows.back().push_back("");
  }
  std::string text = aligned(rows);
  if (shown < configurations)
    text += fmt::format("  ... and {} more, in report.json\n", configurations - shown);
  text += "\n  * on the engine's own frontier of cost and error\n";
  for (const std::string& sentence : idle_tolerances(engines.front(), all->points()))
    text += fmt::format("  {}\n", sentence);
  if (engines.size() != 2) return text;
  const Faster faster = compare_cost(engines[0], engines[1]);
  if (faster.of > 0)
    text += fmt::format("  BSM is faster in {} of {} configurations\n", faster.first, faster.of);
  return text;
}

}  // namespace

std::string member_line(std::size_t index, const ReportedMember& member, const StudyPlan& plan) {
  std::string words = plan.is_work_precision ? configuration_words(member.settings) : "";
  for (const std::string& path : plan.paths)
    if (const Setting* setting = find_setting(member.settings, path))
      words += fmt::format("{}{} {}", words.empty() ? "" : ", ", last_step(path),
                           setting_cell(*setting));
  const std::size_t width = fmt::formatted_size("{}", plan.members);
  std::string line = fmt::format("{:>{}} of {}  {}", index + 1, width, plan.members, words);
  if (const Metric* attitude = find_metric(member.result, "attitude_deg"))
    line += "  attitude " + metric_cell(member, attitude);
  return fmt::format("{}  {}", line, verdict_cell(member.result));
}

std::string study_table(const Report& report, bool colour) {
  const Model& model = report.members.front().bundle.model;
  const StudyPlan& plan = *report.study;
  std::string text = fmt::format("{}   {} of {} members\n\n", model.name,
                                 report.summary()->members(), plan.members);
  if (plan.is_work_precision) {
    text += work_precision_block(report);
  } else {
    text += sweep_block(report);
    const StudyResults results = study_results(report);
    text += trends_block("order in the step", results.convergence, report);
    text += trends_block("time of a step, exponent in the coordinates", results.scaling, report);
    text +=
        trends_block("difference of the engines, exponent in the value", results.slopes, report);
    if (results.left_out > 0)
      text += fmt::format("\n{} of {} members are left out of these: unresolved or failed\n",
                          results.left_out, report.summary()->members());
  }
  return text + "\n" + verdict_line(report, colour) + "\n";
}

}  // namespace twincraft
