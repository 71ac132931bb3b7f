// One function per object of the format, in the order of the file.
// Tested by tests/runtime/report_test.cpp.
#include "runtime/report/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/report/attribution_json.h"
#include "runtime/report/printed_time.h"
#include "runtime/report/resolution_json.h"
#include "runtime/report/words.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json spec_json(const Bundle& bundle) {
  return {{"name", bundle.model.name},
          {"file", bundle.spec_file},
          {"sha256", bundle.spec_sha256},
          {"degrees_of_freedom", bundle.model.degrees_of_freedom()}};
}

/// A setting's value as JSON when it reads as such (`0.02`), else as the text it is (`10 s`).
Json settings_json(const std::vector<Setting>& all) {
  Json settings = Json::object();
  for (const Setting& setting : all) {
    Json value = Json::parse(setting.text, nullptr, false);
    settings[setting.path] = value.is_discarded() ? Json(setting.text) : std::move(value);
  }
  return settings;
}

Json digests_json(const Bundle& bundle) {
  Json digests = Json::object();
  for (const auto& [target, emitted] : bundle.emitted) digests[target] = emitted.sha256;
  return digests;
}

Json resolved_json(const Bundle& bundle) {
  Json resolved = Json::parse(bundle.resolved_json, nullptr, false);
  return resolved.is_discarded() ? Json::object() : resolved;
}

Json coordinates_json(const Model& model, const Observation& sample) {
  Json coordinates = Json::object();
  for (const Coordinate& coordinate : model.coordinates) {
    Json& json = coordinates[coordinate.name];
    if (!coordinate.is_wheel()) json["position"] = position_of(coordinate, sample);
    json["rate"] = rate_of(coordinate, sample);
  }
  return coordinates;
}

/// `r_BN_N_m`, `omega_BN_B_rad_s`; what has no unit goes by its name.
std::string key_with_unit(const Signal& signal) {
  if (signal.unit == "1") return signal.name;
  std::string unit = signal.unit;
  std::ranges::replace(unit, '/', '_');
  return signal.name + '_' + unit;
}

Json output_json(const OutputSignal& output, const Observation& sample) {
  if (output.axes.empty()) return value_of(output, 0, sample);
  Json json = Json::array();
  for (std::size_t i = 0; i < output.size(); ++i) json.push_back(value_of(output, i, sample));
  return json;
}

Json final_json(const Model& model, const Observation& sample) {
  using Of = OutputSignal::Of;
  const std::vector<OutputSignal> outputs = outputs_of(model);
  Json json = Json::object();
  const auto add = [&](Of of) {
    const OutputSignal& output = *std::ranges::find(outputs, of, &OutputSignal::of);
    json[key_with_unit(output)] = output_json(output, sample);
  };
  for (const Of of : {Of::kHubPosition, Of::kHubVelocity, Of::kComPosition, Of::kComVelocity,
                      Of::kAttitude, Of::kHubRate})
    add(of);
  json["coordinates"] = coordinates_json(model, sample);
  add(Of::kMass);
  return json;
}

std::string status_name(EngineRun::Status status) {
  switch (status) {
    case EngineRun::Status::kOk:
      return "ok";
    case EngineRun::Status::kSkipped:
      return "skipped";
    case EngineRun::Status::kFailed:
      break;
  }
  return "failed";
}

Json engine_json(const Model& model, const EngineRun& run) {
  Json engine{{"status", status_name(run.status)}, {"reason", run.reason}};
  const Trajectory& trajectory = run.trajectory;
  if (trajectory.samples.empty()) return engine;
  engine["steps"] = trajectory.counts.accepted;
  engine["rejected_steps"] = trajectory.counts.rejected;
  engine["evaluations"] = trajectory.counts.evaluations;
  engine["t_end_s"] = PrintedTime(model.simulation.step)(trajectory.t_end);
  engine["final"] = final_json(model, trajectory.samples.back());
  for (const BalanceRow& balance : kBalances)
    engine["conservation"][balance.key] = run.conservation.*balance.imbalance;
  return engine;
}

Json agreement_json(const Comparison& comparison) {
  Json agreement = Json::object();
  for (const Metric& metric : comparison.metrics)
    agreement[metric.key] = {{"max", metric.maximum},
                             {"at_s", metric.at},
                             {"tolerance", or_null(metric.tolerance)},
                             {"pass", or_null(metric.pass())}};
  return agreement;
}

/// Without tolerances: one engine's two runs are not judged.
Json against_json(const Baseline& against) {
  Json json{{"member", against.member}};
  if (!against.failed.empty()) json["failed_baselines"] = against.failed;
  for (const Baseline::OfEngine& of : against.engines) {
    for (const Metric& metric : of.comparison.metrics)
      json[of.engine][metric.key] = {{"max", metric.maximum}, {"at_s", metric.at}};
    json[of.engine]["same_sample_times"] = of.comparison.same_times;
  }
  return json;
}

Json deviation_json(const Deviation& deviation) {
  return {{"max", deviation.max},
          {"at_s", deviation.at},
          {"tolerance", or_null(deviation.tolerance)},
          {"pass", or_null(deviation.pass())}};
}

Json conservation_json(const std::vector<Balance>& balances) {
  Json conservation = Json::object();
  for (const Balance& balance : balances)
    conservation[balance.key] = {{"max", balance.maximum},
                                 {"engine", balance.engine},
                                 {"tolerance", or_null(balance.tolerance)},
                                 {"pass", or_null(balance.pass())}};
  return conservation;
}

Json references_json(const std::vector<ReferenceRun>& runs) {
  Json references = Json::object();
  for (const ReferenceRun& run : runs)
    for (const Deviation& deviation : run.deviations)
      references[run.name][run.engine][deviation.metric] = deviation_json(deviation);
  return references;
}

Json engine_timing_json(const EngineTiming& timing) {
  Json json{{"trials_s", timing.trials}};
  if (timing.trials.empty()) return json;
  json["median_s"] = timing.median();
  json["us_per_step"] = 1.0e6 * timing.per_step();
  json["spread_relative"] = timing.spread();
  return json;
}

Json timing_json(const Timing& timing) {
  Json json{{"protocol", protocol(timing)}};
  for (const EngineTiming& engine : timing.engines) json[engine.name] = engine_timing_json(engine);
  const std::optional<double> ratio = timing.ratio();
  if (ratio) json["ratio_bsm_over_mujoco"] = *ratio;
  return json;
}

/// Every `at_s` as the CSV files write it.
void print_times(const PrintedTime& printed, Json& json) {
  for (auto& [key, value] : json.items()) {
    if (value.is_structured()) print_times(printed, value);
    if (key == "at_s" && value.is_number()) value = printed(value.get<double>());
  }
}

Json outputs_json(const std::vector<OutputValue>& outputs) {
  const auto number = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
  };
  Json json = Json::object();
  for (const OutputValue& output : outputs) {
    Json& one = json[output.name] = {{"value", number(output.value)}, {"unit", output.unit}};
    if (output.below) one["below"] = *output.below;
    if (output.above) one["above"] = *output.above;
    if (output.below || output.above) one["pass"] = output.holds;
  }
  return json;
}

Json member_json(const ReportedMember& member) {
  const Member& result = member.result;
  Json json{{"verdict", verdict_name(result.verdict())},
            {"settings", settings_json(member.settings)},
            {"emitted_sha256", digests_json(member.bundle)},
            {"resolved", resolved_json(member.bundle)}};
  const std::string depletion = depletion_words(member.bundle.model);
  if (!depletion.empty()) json["depletion"] = depletion;
  for (const EngineRun& run : result.engines)
    json["engines"][run.name] = engine_json(member.bundle.model, run);
  json["agreement"] = result.comparison ? agreement_json(*result.comparison) : Json::object();
  if (result.comparison) json["same_sample_times"] = result.comparison->same_times;
  if (member.against) json["against"] = against_json(*member.against);
  if (!member.outputs.empty()) json["outputs"] = outputs_json(member.outputs);
  json["conservation"] = conservation_json(result.conservation);
  json["references"] = references_json(result.references);
  if (result.resolution) json["resolution"] = resolution_json(result);
  if (result.timing) json["timing"] = timing_json(*result.timing);
  const PrintedTime printed(member.bundle.model.simulation.step);
  for (const char* part : {"agreement", "against", "references"})
    if (json.contains(part)) print_times(printed, json[part]);
  return json;
}

/// NaN, where no exponent can be told, becomes null.
Json trend_json(const Trend& trend, const char* x, const char* y, const char* exponents) {
  Json json = Json::object();
  if (!trend.metric.empty()) json["metric"] = trend.metric;
  if (!trend.reference.empty()) json["reference"] = trend.reference;
  if (!trend.engine.empty()) json["engine"] = trend.engine;
  json["set"] = trend.path;
  if (!trend.others.empty()) json["settings"] = settings_json(trend.others);
  json[x] = trend.x;
  json[y] = trend.y;
  json["members"] = trend.members;
  json["rounding"] = trend.is_rounding;
  json[exponents] = trend.exponents;
  return json;
}

Json trends_json(const std::vector<Trend>& trends, const char* x, const char* y,
                 const char* exponents) {
  Json json = Json::array();
  for (const Trend& trend : trends) json.push_back(trend_json(trend, x, y, exponents));
  return json;
}

Json work_point_json(const WorkPoint& point, const StudyPoints& members) {
  const std::vector<Setting>& settings = members.all()[point.member].settings;
  Json json{{"member", point.member},
            {"settings", settings_json(settings)},
            {"diverged", point.diverged}};
  if (point.diverged) return json;
  json["attitude_deg"] = point.error.attitude;
  json["position_m"] = point.error.position;
  json["evaluations"] = point.evaluations;
  if (point.median) json["median_s"] = *point.median;
  json["frontier"] = point.on_frontier;
  return json;
}

Json work_precision_json(const std::vector<EngineWork>& engines, const StudyPoints& members) {
  Json json = Json::object();
  for (const EngineWork& work : engines) {
    Json& engine = json[work.engine];
    engine["floor"] = {{"attitude_deg", work.floor.attitude}, {"position_m", work.floor.position}};
    engine["configurations"] = Json::array();
    for (const WorkPoint& point : work.points)
      engine["configurations"].push_back(work_point_json(point, members));
  }
  if (!engines.empty()) json["remarks"] = idle_tolerances(engines.front(), members);
  if (engines.size() != 2) return json;
  const Faster faster = compare_cost(engines[0], engines[1]);
  if (faster.of > 0) json["bsm_faster"] = {{"in", faster.first}, {"of", faster.of}};
  return json;
}

Json studies_json(const Report& report) {
  Json json = Json::object();
  if (!report.study) return json;
  const StudyResults results = study_results(report);
  if (report.study->is_work_precision) {
    json["work_precision"] =
        work_precision_json(results.work_precision, report.summary()->points());
    return json;
  }
  json["convergence"] = trends_json(results.convergence, "steps_s", "errors", "orders");
  json["scaling"] = trends_json(results.scaling, "degrees_of_freedom", "us_per_step", "exponents");
  json["slopes"] = trends_json(results.slopes, "values", "maxima", "slopes");
  json["left_out"] = results.left_out;
  return json;
}

}  // namespace

namespace {

/// The whole report but its members.
Json frame_value(const Report& report) {
  Json json{{"format", "twincraft-report/1"},
            {"complete", report.complete()},
            {"verdict", verdict_name(report.verdict())},
            {"spec", spec_json(report.members.front().bundle)},
            {"provenance", provenance_json(report.provenance)},
            {"members", Json::array()},
            {"studies", studies_json(report)}};
  if (report.attribution) {
    json["attribution"] = attribution_json(*report.attribution);
    json["explanation"] =
        explanation_json(*report.attribution, report.members.front().bundle.model);
  }
  return json;
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Json provenance_json(const Provenance& provenance) {
  return {{"program", provenance.program},
          {"git", provenance.git},
          {"compiler", provenance.compiler},
          {"flags", provenance.flags},
          {"mujoco", provenance.mujoco},
          {"eigen", provenance.eigen},
          {"instructions", provenance.instructions},
          {"instructions_reason", provenance.instructions_reason},
          {"instructions_available", provenance.instructions_available},
          {"cpu", provenance.cpu},
          {"cores", provenance.cores},
          {"load_average",
           provenance.load_average < 0.0 ? Json(nullptr) : Json(provenance.load_average)}};
}

Json report_value(const Report& report) {
  Json json = frame_value(report);
  for (const ReportedMember& member : report.members)
    json["members"].push_back(member_json(member));
  return json;
}

std::string report_member(const ReportedMember& member, bool is_first) {
  std::string text = is_first ? "\n    " : ",\n    ";
  // A line break in a text is written as such, so every one here is the printer's.
  for (const char c : text_of(member_json(member))) {
    text += c;
    if (c == '\n') text += "    ";
  }
  return text;
}

ReportFrame report_frame(const Report& report) {
  // A quote in a text is escaped, so this is the key itself.
  constexpr std::string_view kPlace = "\n  \"members\": []";
  const std::string text = text_of(frame_value(report)) + "\n";
  const std::size_t end = text.find(kPlace) + kPlace.size() - 1;
  return {text.substr(0, end), "\n  " + text.substr(end)};
}

std::string report_json(const Report& report) {
  const ReportFrame frame = report_frame(report);
  std::string text = frame.before;
  for (const ReportedMember& member : report.members)
    text += report_member(member, &member == &report.members.front());
  return text + frame.after;
}

}  // namespace twincraft
