// Claims about report.json and report.html of a campaign that need no browser. The rest is in
// tests/node.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "runtime/report/campaign_json.h"
#include "runtime/report/page/campaign_data.h"
#include "runtime/report/page/document.h"
#include "tests/runtime/handmade_campaign_report.h"
#include "tests/support/count_of.h"

namespace twincraft {
namespace {

using nlohmann::json;
using test::campaign_report;
using test::count_of;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

json report_of(const CampaignReport& report) { return json::parse(campaign_json(report)); }

std::vector<std::string> keys(const json& object) {
  std::vector<std::string> names;
  for (const auto& [key, unused] : object.items()) names.push_back(key);
  return names;
}

TEST(CampaignJson, HasTheFormatOfAReport) {
  const json report = report_of(campaign_report(300));
  EXPECT_EQ(report["format"], "twincraft-report/1");
  EXPECT_EQ(report["complete"], true);
  EXPECT_EQ(report["verdict"], "disagree");
  EXPECT_EQ(report["spec"], json::parse(R"({"name": "tug", "file": "models/my tug.yaml",
                                            "sha256": "abc", "degrees_of_freedom": 8})"));
  EXPECT_EQ(report["provenance"]["instructions"], "AVX2");
  // No members: their rows are in campaign.csv.
  EXPECT_THAT(keys(report), UnorderedElementsAre("format", "complete", "verdict", "spec",
                                                 "provenance", "campaign"));
}

TEST(CampaignJson, SaysWhatWasDrawnAndFlown) {
  const json campaign = report_of(campaign_report(800, 10))["campaign"];
  EXPECT_EQ(campaign["members"], 800);
  EXPECT_EQ(campaign["flown"], 789);
  EXPECT_EQ(campaign["missing"], json::parse(R"({"count": 10, "ranges": [[790, 799]]})"));
  EXPECT_EQ(campaign["seed"], 7);
  EXPECT_EQ(campaign["sampling"], "latin_hypercube");
  EXPECT_EQ(campaign["drawn"][0], json::parse(R"({"name": "hub.mass", "unit": "kg",
                            "distribution": "normal, sigma 2 %, truncate 3", "nominal": 600})"));
  EXPECT_EQ(campaign["failures"],
            json::parse(R"([{"reason": "`omega_BN_B` is absurd: .. rad/s", "count": 1,
                             "first": 399}])"));
}

TEST(CampaignJson, HasAnEntryPerOutput) {
  const CampaignReport report = campaign_report(300);
  const json peak = report_of(report)["campaign"]["outputs"][0];
  const OutputSummary& summary = report.findings.outputs[0].summary;
  EXPECT_EQ(peak["name"], "peak");
  EXPECT_EQ(peak["unit"], "rad");
  EXPECT_EQ(peak["count"], 300);
  EXPECT_EQ(peak["median"], summary.median);
  EXPECT_EQ(peak["p95_bounds"],
            json::array({*summary.p95_bounds.lower, *summary.p95_bounds.upper}));
  EXPECT_EQ(peak["tolerance_95_95"], *summary.tolerance_upper);
  EXPECT_EQ(peak["requirement"], json::parse(R"({"below": 0.08, "above": null})"));
  EXPECT_EQ(peak["pass"]["flown"]["of"], 300);
  EXPECT_EQ(peak["pass"]["flown"]["rate"], summary.flown.rate());
  EXPECT_EQ(peak["pass"]["flown"]["interval"][0], summary.flown.interval.lower);
  ASSERT_EQ(peak["drivers"].size(), 3u);
  EXPECT_EQ(peak["drivers"][0]["name"], "hub.mass");
  EXPECT_GT(peak["drivers"][0]["rank_correlation"], 0.7);
  EXPECT_LT(peak["drivers"][0]["sobol_first"]["interval"][0],
            peak["drivers"][0]["sobol_first"]["value"]);
  EXPECT_FALSE(peak.contains("no_sobol"));
}

TEST(CampaignJson, SaysWhyThereAreNoIndices) {
  const json touch = report_of(campaign_report(300))["campaign"]["outputs"][1];
  EXPECT_TRUE(touch["requirement"].is_null());
  EXPECT_TRUE(touch["pass"].is_null());
  EXPECT_TRUE(touch["drivers"][0]["sobol_first"].is_null());
  EXPECT_THAT(touch["no_sobol"], HasSubstr("members have no value"));
}

TEST(CampaignJson, NamesTwinsWorstAndKeptMembers) {
  const CampaignReport report = campaign_report(300);
  const json campaign = report_of(report)["campaign"];
  EXPECT_EQ(campaign["twins"]["flown"], 30);
  EXPECT_EQ(campaign["twins"]["members"].size(), campaign["twins"]["disagree"]);
  EXPECT_EQ(campaign["twins"]["driver"]["name"], "hub.mass");
  ASSERT_EQ(campaign["worst"].size(), 5u);
  const std::size_t worst = report.findings.outputs[0].worst[0].member;
  EXPECT_EQ(campaign["worst"][0]["member"], worst);
  EXPECT_EQ(campaign["worst"][0]["pass"], false);
  EXPECT_EQ(campaign["worst"][0]["command"],
            "scsim 'models/my tug.yaml' --set hub.mass=" + std::to_string(600 + worst) +
                R"( --set 'wheels.w.speed=it'\''s 3 rad/s')");
  EXPECT_EQ(campaign["kept"][1]["member"], 17);
  EXPECT_EQ(campaign["kept"][1]["folder"], "0017");
}

TEST(CampaignJson, OfMembersThatNobodyFlewHasNoNumbers) {
  CampaignReport report = campaign_report(5, 5);
  report.settings = {};
  const json campaign = report_of(report)["campaign"];
  EXPECT_TRUE(campaign["outputs"][0]["median"].is_null());
  EXPECT_EQ(campaign["outputs"][0]["p95_bounds"], json::array({nullptr, nullptr}));
  EXPECT_TRUE(campaign["outputs"][0]["pass"]["flown"]["rate"].is_null());
  EXPECT_EQ(campaign["outputs"][0]["pass"]["all"]["rate"], 0.0);
  EXPECT_TRUE(campaign["twins"]["driver"].is_null());
  EXPECT_TRUE(campaign["kept"][0]["command"].is_null());
  EXPECT_THAT(campaign_html(report), HasSubstr("<h1>tug</h1>"));
}

TEST(CampaignJson, NamesNoMoreThanAListIsGoodFor) {
  CampaignReport report = campaign_report(3);
  report.campaign.missing.clear();
  for (std::size_t i = 0; i < 5000; ++i) report.campaign.missing.push_back({2 * i, 2 * i});
  const json missing = report_of(report)["campaign"]["missing"];
  EXPECT_EQ(missing["count"], 5000);
  EXPECT_EQ(missing["ranges"].size(), 1000u);
}

TEST(CampaignWords, AreOfTheVerdict) {
  CampaignReport report = campaign_report(800);
  EXPECT_EQ(verdict_words(report), "2 of 800 members failed");
  report.verdict = Verdict::kNotJudged;
  report.findings.twins.count = {11, 11, 0};
  EXPECT_EQ(verdict_words(report), "The engines agree in all 11 members that both flew");
  report.findings.twins.count = {11, 8, 2};
  report.verdict = Verdict::kDisagree;
  EXPECT_EQ(verdict_words(report), "The engines disagree in 2 of 10 members that both flew");
  report.findings.twins.count = {};
  report.verdict = Verdict::kNotJudged;
  EXPECT_EQ(verdict_words(report), "Not judged");
  report.verdict = Verdict::kInterrupted;
  EXPECT_EQ(verdict_words(report), "Interrupted");
}

/// What a spec could not name its parts by, were names not checked.
const std::string kHostile = "</script><script>alert(1)</script>\"'&@DATA@";

CampaignReport hostile_report() {
  RecordsHeader header = test::driven_header();
  header.name = kHostile;
  for (DrawnNumber& drawn : header.drawn)
    drawn.name = drawn.unit = drawn.distribution = kHostile + drawn.name;
  for (OutputColumn& output : header.outputs)
    output.name = output.unit = output.meaning = kHostile + output.name;
  CampaignReport report = campaign_report(400, 0, header);
  report.description = report.spec_file = kHostile;
  report.campaign.remarks = {kHostile};
  report.settings = [](std::size_t) { return std::vector<std::string>{kHostile}; };
  return report;
}

TEST(CampaignPage, ShowsHostileNamesAsText) {
  const std::string page = campaign_html(hostile_report());
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_EQ(count_of(page, "</script>"),
            count_of(campaign_html(campaign_report(400)), "</script>"));
  EXPECT_THAT(campaign_page_data(hostile_report()), Not(HasSubstr("<")));
  EXPECT_EQ(json::parse(campaign_page_data(hostile_report()))["report"],
            report_of(hostile_report()));
}

TEST(CampaignPage, NeedsNothingButItself) {
  const std::string page = campaign_html(campaign_report(400));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr("unsafe")));
  EXPECT_THAT(page, Not(HasSubstr(" src=")));
  EXPECT_THAT(page, Not(HasSubstr("href=\"http")));
  EXPECT_THAT(page, Not(HasSubstr("dygraphs")));
  EXPECT_EQ(count_of(page, "<script>"), 1u);
}

TEST(CampaignPage, SaysWithoutScriptsWhatTheTerminalSays) {
  EXPECT_THAT(campaign_html(campaign_report(400)), HasSubstr("tug: 399 of 400 members flown"));
}

TEST(CampaignPage, IsSmallHoweverManyMembersThereAre) {
  const CampaignReport report = campaign_report(100'000);
  EXPECT_LT(campaign_html(report).size(), 500'000u);
  const json scatter = json::parse(campaign_page_data(report))["scatter"];
  const std::size_t numbers = scatter["members"].get<std::string>().size() / 4 * 3 / 8;
  EXPECT_LE(numbers, 2000u);
  EXPECT_GT(numbers, 1990u);
}

TEST(CampaignPage, StaysSmallWithManyOutputs) {
  RecordsHeader header = test::driven_header();
  header.outputs.assign(60, header.outputs[0]);
  for (std::size_t i = 0; i < header.outputs.size(); ++i)
    header.outputs[i].name += std::to_string(i);
  CampaignTable wide(header);
  std::mt19937_64 random(1);
  for (std::size_t member = 0; member < 5000; ++member) {
    MemberRecord record = test::driven_member(member, random);
    record.outputs.assign(60, record.outputs[0]);
    wide.add(record);
  }
  ASSERT_EQ(wide.settle(5000), "");
  CampaignReport report = campaign_report(10);
  report.campaign = {std::move(wide), 5000, {}, {}};
  report.findings = find_all(report.campaign, report.plan, std::vector<bool>(3, true));
  EXPECT_LT(campaign_html(report).size(), 2'000'000u);
}

}  // namespace
}  // namespace twincraft
