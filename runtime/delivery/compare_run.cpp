#include "runtime/delivery/compare_run.h"

#include <fmt/color.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>
#include <system_error>

#include "compiler/diag/diagnostics.h"
#include "runtime/report/table.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNamed = 5;  // names that a note shows

/// Names of the CSV files in a folder and in the folders in it: `bsm.csv`, `0001/bsm.csv`.
std::set<std::string> trajectories_in(const fs::path& folder, std::error_code& fault,
                                      bool is_outer = true) {
  std::set<std::string> names;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end;
       entry.increment(fault)) {
    const fs::path& path = entry->path();
    std::error_code unknown;  // a file that vanishes meanwhile
    if (entry->is_regular_file(unknown) && path.extension() == ".csv")
      names.insert(path.filename().string());
    if (!is_outer || !entry->is_directory(unknown)) continue;
    for (const std::string& name : trajectories_in(path, unknown, false))
      names.insert((path.filename() / name).string());
  }
  return names;
}

/// `12 columns are in `a.csv` alone: `x`, `y`, ...`
std::string names_note(const std::vector<std::string>& names, std::string_view thing,
                       std::string_view what) {
  if (names.empty()) return {};
  std::string text =
      fmt::format("note: {} {}{} {} {}: ", names.size(), thing, names.size() == 1 ? "" : "s",
                  names.size() == 1 ? "is" : "are", what);
  for (std::size_t i = 0; i < std::min(kNamed, names.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", in_backticks(names[i]));
  return text + (names.size() > kNamed ? ", ...\n" : "\n");
}

std::string in_alone(std::string_view file) {
  return fmt::format("in {} alone", in_backticks(file));
}

std::string notes_of(const ComparedFile& file) {
  std::string text;
  const std::string name = in_backticks(file.name);
  if (file.lone_times > 0)
    text += fmt::format("note: {} {} in {} alone, the first at {:.9g} s\n", file.lone_times,
                        file.lone_times == 1 ? "time is" : "times are", name, file.first_lone);
  if (const NotFinite& cells = file.not_finite; cells.count > 0)
    text +=
        fmt::format("note: {} {} of {} not finite, the first in line {}, column {}\n", cells.count,
                    cells.count == 1 ? "cell" : "cells", name + (cells.count == 1 ? " is" : " are"),
                    cells.line, in_backticks(cells.column));
  if (file.null_attitudes > 0)
    text += fmt::format("note: `q_BN` of {} has the length 0, the first time at {:.9g} s\n", name,
                        file.first_null);
  return text;
}

/// As in the report, but for what only a spec can tell apart.
MetricWords words_in(const TrajectoryDifference& pair, const std::string& key, bool has_spec) {
  if (key == "joint_m" && !has_spec) return {"displacements", "m"};
  return words_of(key, pair.shared.model);
}

std::string notes_of(const TrajectoryDifference& pair, bool has_spec) {
  std::vector<std::string> unjudged;
  for (const std::string& key : pair.shared.unjudged)
    unjudged.push_back(words_in(pair, key, has_spec).label);
  return names_note(pair.shared.only_a, "column", in_alone(pair.a.name)) +
         names_note(pair.shared.only_b, "column", in_alone(pair.b.name)) +
         names_note(pair.shared.incomparable, "column",
                    "not compared, with units that are missing, unknown or different") +
         names_note(unjudged, "tolerance", "not judged, without the columns in both files") +
         notes_of(pair.a) + notes_of(pair.b);
}

std::string text_of(const TrajectoryDifference& pair, bool has_spec, bool colour) {
  std::string text =
      fmt::format("{} and {}   {} common {}, {:.9g} s to {:.9g} s\n\n", in_backticks(pair.a.name),
                  in_backticks(pair.b.name), pair.times, pair.times == 1 ? "time" : "times",
                  pair.first_time, pair.last_time);
  std::vector<DifferenceRow> rows;
  for (const Metric& metric : pair.comparison.metrics)
    rows.push_back({metric, words_in(pair, metric.key, has_spec)});
  if (!rows.empty()) text += difference_block("agreement", rows, true, colour);
  rows.clear();
  for (const ColumnDifference& each : pair.others)
    rows.push_back({{each.name, each.peak.maximum, each.peak.at, std::nullopt},
                    {printable(each.name), each.unit == "1" ? "" : printable(each.unit)}});
  if (!rows.empty()) text += difference_block("other columns", rows, true, colour);
  return text + notes_of(pair, has_spec);
}

/// With a spec, a metric that is not finite is judged without a tolerance, too, and does not hold.
std::vector<JudgedFigure> figures_of(const std::vector<TrajectoryDifference>& pairs,
                                     bool has_spec) {
  std::vector<JudgedFigure> figures;
  for (const TrajectoryDifference& pair : pairs)
    for (const Metric& metric : pair.comparison.metrics)
      if (metric.tolerance || (has_spec && !std::isfinite(metric.maximum)))
        figures.push_back({JudgedFigure::Of::kAgreement,
                           metric.key,
                           {},
                           {},
                           metric.maximum,
                           metric.tolerance.value_or(0.0)});
  return figures;
}

}  // namespace

Verdict CompareRun::verdict() const {
  return judge(figures_of(pairs_, spec_name_.has_value()), true);
}

int CompareRun::exit_code() const {
  if (!faults_.empty()) return kExitInputOutput;
  return verdict() == Verdict::kDisagree ? kExitFindings : kExitDone;
}

std::string CompareRun::verdict_line(bool colour) const {
  const std::string both = fmt::format("{} and {}", in_backticks(a_), in_backticks(b_));
  const auto paint = [colour](const std::string& words, fmt::color shade) {
    return colour ? fmt::format(fmt::fg(shade), "{}", words) : words;
  };
  switch (verdict()) {
    case Verdict::kDisagree:
      return both + " " + paint("disagree", fmt::color::red);
    case Verdict::kAgree:
      if (faults_.empty()) return both + " " + paint("agree", fmt::color::green);
      return "not judged; not all files could be compared";
    default:
      break;
  }
  if (!spec_name_) return "not judged; no tolerance given: `--tolerances SPEC` names a spec";
  return fmt::format("not judged; no tolerance given by {} for what both have",
                     in_backticks(*spec_name_));
}

std::string CompareRun::text(bool colour) const {
  if (pairs_.empty()) return {};
  std::string text;
  for (const TrajectoryDifference& pair : pairs_)
    text += text_of(pair, spec_name_.has_value(), colour) + "\n";
  text += names_note(only_a_, "file", in_alone(a_)) + names_note(only_b_, "file", in_alone(b_));
  if (!only_a_.empty() || !only_b_.empty()) text += '\n';
  return text + verdict_line(colour) + "\n";
}

namespace {

/// The names that both folders have.
std::vector<std::string> shared_names(const CompareRequest& request,
                                      std::vector<std::string>& only_a,
                                      std::vector<std::string>& only_b,
                                      std::vector<FileFault>& faults) {
  std::error_code fault_a, fault_b;
  const std::set<std::string> a = trajectories_in(request.a, fault_a),
                              b = trajectories_in(request.b, fault_b);
  for (const auto& [name, fault] : {std::pair(request.a, fault_a), std::pair(request.b, fault_b)})
    if (fault) faults.push_back({name, 0, 0, "it can not be read: " + reason_of(fault), ""});
  if (!faults.empty()) return {};
  std::vector<std::string> both;
  std::ranges::set_intersection(a, b, std::back_inserter(both));
  std::ranges::set_difference(a, b, std::back_inserter(only_a));
  std::ranges::set_difference(b, a, std::back_inserter(only_b));
  const auto count = [](const std::set<std::string>& names, const std::string& folder) {
    return fmt::format("{} has {}", in_backticks(folder),
                       names.empty() ? "none" : "`" + printable(*names.begin()) + "`");
  };
  if (both.empty())
    faults.push_back({request.a, 0, 0,
                      fmt::format("no CSV file in common with {}", in_backticks(request.b)),
                      fmt::format("files of one name are compared: {}, {}", count(a, request.a),
                                  count(b, request.b))});
  return both;
}

}  // namespace

CompareRun compare_files(const CompareRequest& request) {
  CompareRun run;
  run.a_ = request.a;
  run.b_ = request.b;
  if (request.spec != nullptr) run.spec_name_ = request.spec_name;
  const auto compare = [&](const std::string& a, const std::string& b) {
    auto pair = compare_trajectories(a, b, request.spec, run.faults_, request.progress);
    if (pair) run.pairs_.push_back(*std::move(pair));
  };
  std::error_code unknown;  // what does not exist is read as a file, which says so
  const bool is_folder_a = fs::is_directory(request.a, unknown),
             is_folder_b = fs::is_directory(request.b, unknown);
  if (is_folder_a != is_folder_b) {
    run.faults_.push_back({is_folder_a ? request.a : request.b, 0, 0,
                           fmt::format("it is a folder, {} is none",
                                       in_backticks(is_folder_a ? request.b : request.a)),
                           "compare two files or two folders"});
    return run;
  }
  if (!is_folder_a) {
    compare(request.a, request.b);
    return run;
  }
  for (const std::string& name : shared_names(request, run.only_a_, run.only_b_, run.faults_))
    compare((fs::path(request.a) / name).string(), (fs::path(request.b) / name).string());
  return run;
}

}  // namespace twincraft
