// See page_data.h. Tested by tests/runtime/html_test.cpp.
#include "runtime/report/page/page_data.h"

#include <nlohmann/json.hpp>

#include "runtime/report/json.h"
#include "runtime/report/page/inline_json.h"
#include "runtime/report/page/page_series.h"
#include "runtime/report/page/replay_data.h"
#include "runtime/report/words.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

// A page is for looking at: beyond this a study's members are in report.json.
constexpr std::size_t kMostMembers = 500;

/// Members that are in no fit and why, by their numbers: of all, not of those that are shown.
Json left_out(const Json& members) {
  Json found = Json::object();
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::string verdict = members[i].value("verdict", "");
    if (verdict == "failed" || verdict == "unresolved" || verdict == "interrupted")
      found[std::to_string(i)] = verdict;
  }
  return found;
}

/// What the page shows of report.json: the first members, resolved once.
Json shown_report(Json json) {
  Json& members = json["members"];
  if (members.size() > kMostMembers)
    members.erase(members.begin() + static_cast<std::ptrdiff_t>(kMostMembers), members.end());
  for (Json& member : members) member.erase("resolved");
  return json;
}

/// Label and unit of every metric that occurs.
Json words_json(const Report& report, const Json& shown) {
  Json words = Json::object();
  const Model& model = report.members.front().bundle.model;
  const auto add = [&](const std::string& key) {
    const auto [label, unit] = words_of(key, model);
    words[key] = {{"label", label}, {"unit", unit}};
  };
  for (const Json& member : shown["members"]) {
    for (const auto& [key, unused] : member["agreement"].items()) add(key);
    for (const auto& [name, engines] : member["references"].items())
      for (const auto& [engine, metrics] : engines.items())
        for (const auto& [key, unused] : metrics.items()) add(key);
  }
  return words;
}

}  // namespace

std::string page_data(const Report& report) {
  const ReportedMember& first = report.members.front();
  const Model& model = first.bundle.model;
  Json whole = report_value(report);
  Json not_counted = left_out(whole["members"]);
  Json shown = shown_report(std::move(whole));
  Json json{{"description", model.description},
            {"vehicle", vehicle_words(model)},
            {"plan", plan_words(model)},
            {"depletion", depletion_words(model)},
            {"words", words_json(report, shown)},
            {"is_study", report.study.has_value()},
            {"is_work_precision", report.study && report.study->is_work_precision},
            {"members_run", report.summary()->members()},
            {"members_planned", report.study ? report.study->members : 1},
            {"left_out", std::move(not_counted)},
            {"report", std::move(shown)},
            {"histories", histories_json(first)},
            {"replay", replay_json(first)},
            {kMjcf, first.bundle.text(kMjcf)},
            {kResolved, first.bundle.text(kResolved)}};
  return inline_json(json);
}

}  // namespace twincraft
