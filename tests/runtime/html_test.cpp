// Claims about report.html that need no browser: what is shown of long histories, what is escaped,
// what its policy lets run. The rest is in tests/node.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "runtime/report/json.h"
#include "runtime/report/page/assets.h"
#include "runtime/report/page/base64.h"
#include "runtime/report/page/decimate.h"
#include "runtime/report/page/document.h"
#include "runtime/report/page/page_data.h"
#include "runtime/report/page/page_series.h"
#include "runtime/report/page/replay_data.h"
#include "tests/runtime/handmade.h"
#include "tests/support/count_of.h"

namespace twincraft {
namespace {

using nlohmann::json;
using test::count_of;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64(std::string_view("")), "");
  EXPECT_EQ(base64(std::string_view("f")), "Zg==");
  EXPECT_EQ(base64(std::string_view("fo")), "Zm8=");
  EXPECT_EQ(base64(std::string_view("foo")), "Zm9v");
  EXPECT_EQ(base64(std::string_view("foobar")), "Zm9vYmFy");
}

TEST(Base64, HoldsDoublesLeastByteFirst) {
  EXPECT_EQ(base64(std::vector<double>{1.0}), "AAAAAAAA8D8=");
}

TEST(Base64, HashesAsAPolicyWantsIt) {
  EXPECT_EQ(csp_hash("abc"), "sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=");
}

std::vector<double> doubles(const std::string& text) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<unsigned>(kDigits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 255U);
  }
  std::vector<double> values(bytes.size() / sizeof(double));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
  return values;
}

/// One column, whose samples are a second apart.
Decimator decimated(const std::vector<double>& values, std::size_t points) {
  Decimator column(1, points);
  for (std::size_t i = 0; i < values.size(); ++i)
    column.take(static_cast<double>(i), std::span(&values[i], 1));
  return column;
}

TEST(Decimator, LeavesShortHistoriesAlone) {
  const Decimator all = decimated({3, 1, 4, 1}, 4);
  EXPECT_FALSE(all.thins());
  EXPECT_THAT(all.extremes(0), ElementsAre(3, 1, 4, 1));
  EXPECT_THAT(all.times(), ElementsAre(0, 1, 2, 3));
}

TEST(Decimator, KeepsLeastAndGreatestOfEveryBucketInTheirOrder) {
  const Decimator thin = decimated({0, 9, -5, 1, 2, -7, 8, 3}, 4);
  EXPECT_TRUE(thin.thins());
  EXPECT_EQ(thin.points(), 4U);
  EXPECT_THAT(thin.extremes(0), ElementsAre(9, -5, -7, 8));
  EXPECT_THAT(thin.times(), ElementsAre(0, 3, 4, 7));
}

TEST(Decimator, LosesNoPeakWhereverItIsAndHoweverManySamplesCome) {
  for (const std::size_t size : {50U, 1000U, 4097U})
    for (std::size_t peak = 0; peak < size; peak += 7) {
      std::vector<double> values(size, 0.0);
      values[peak] = 1.0;
      const Decimator thin = decimated(values, 20);
      EXPECT_THAT(thin.extremes(0), testing::Contains(1.0)) << peak << " of " << size;
      EXPECT_THAT(thin.extremes(0), testing::SizeIs(20));
      EXPECT_EQ(thin.times().front(), 0.0);
      EXPECT_EQ(thin.times().back(), static_cast<double>(size - 1));
      EXPECT_TRUE(std::ranges::is_sorted(thin.times()));
    }
}

TEST(Decimator, KeepsTheOrderOfExtremesWhenBucketsAreMerged) {
  std::vector<double> saw;
  for (int i = 0; i < 6400; ++i) saw.push_back(i % 640);  // up, ten times over
  const std::vector<double> shown = decimated(saw, 20).extremes(0);
  for (std::size_t i = 0; i + 1 < shown.size(); i += 2) EXPECT_LT(shown[i], shown[i + 1]);
}

TEST(Decimator, ShowsABucketWithoutANumberAsSuch) {
  const std::vector<double> shown = decimated({0, 1, kNan, 3, 4, 5, 6, 7}, 4).extremes(0);
  EXPECT_TRUE(std::isnan(shown[0]) && std::isnan(shown[1]));
  EXPECT_THAT(std::vector(shown.begin() + 2, shown.end()), ElementsAre(4, 7));
}

TEST(Frames, AreSpreadOverALongRunFromItsFirstToItsLastSample) {
  const Model model = test::model_of_every_kind();
  Frames frames(model);
  Observation sample = test::sample_at(0.0, model);
  const int last = 100'000;
  for (int i = 0; i <= last; ++i) {
    sample.time = i;
    frames.take(sample);
  }
  const std::vector<double> rows = doubles(frames.text());
  const std::size_t width = rows.size() / frames.count();
  EXPECT_EQ(rows[0], 0.0);
  EXPECT_EQ(rows[rows.size() - width], last);
  const double mean = static_cast<double>(last) / static_cast<double>(frames.count() - 1);
  for (std::size_t i = 1; i < frames.count(); ++i)
    EXPECT_NEAR(rows[i * width] - rows[(i - 1) * width], mean, 0.5 * mean);
}

EngineRun engine_run(const std::string& name, const Model& model) {
  EngineRun run;
  run.name = name;
  run.trajectory = test::standstill(model);
  return run;
}

Report small_report() {
  ReportedMember member;
  member.bundle.model = test::model_of_every_kind();
  member.bundle.emitted[kMjcf].text = "<mujoco/>";
  const Model& model = member.bundle.model;
  member.result.engines = {engine_run("bsm", model), engine_run("mujoco", model)};
  member.result.engines[1].trajectory.samples[1].omega_BN_B.x() += 2.5e-13;
  member.result.comparison =
      compare(model, member.result.engines[0].trajectory, member.result.engines[1].trajectory);
  member.result.complete = true;
  Report report{provenance(), {}};
  report.members.push_back(std::move(member));
  return report;
}

json figure(const json& histories, const std::string& metric) {
  for (const json& one : histories["figures"])
    if (one.contains("difference") && one["difference"].value("metric", "") == metric) return one;
  return nullptr;
}

TEST(Histories, HoldBothEnginesAndTheDifferenceThatIsJudged) {
  const Report report = small_report();
  const json histories = histories_json(report.members[0]);
  const json rates = figure(histories, "rate_rad_s");
  const std::vector<double> bsm = doubles(rates["series"][0]["bsm"]);
  const std::vector<double> mujoco = doubles(rates["series"][0]["mujoco"]);
  const std::vector<double> judged = doubles(rates["difference"]["series"][0]["values"]);
  ASSERT_EQ(bsm.size(), report.members[0].result.engines[0].trajectory.samples.size());
  EXPECT_EQ(mujoco[1] - bsm[1], judged[1]);
  for (const Metric& metric : report.members[0].result.comparison->metrics) {
    if (metric.key != "rate_rad_s") continue;
    EXPECT_EQ(*std::max_element(judged.begin(), judged.end()), metric.maximum);
  }
}

TEST(Histories, HoldOneEngineAlone) {
  Report report = small_report();
  report.members[0].result.engines[1].trajectory = {};
  report.members[0].result.comparison.reset();
  const json histories = histories_json(report.members[0]);
  EXPECT_TRUE(histories["times"].contains("bsm"));
  EXPECT_FALSE(histories["times"].contains("mujoco"));
  EXPECT_FALSE(histories["figures"][0]["series"][0].contains("mujoco"));
  EXPECT_TRUE(histories["figures"][0]["difference"].is_null());
}

TEST(Histories, OfAMemberThatWasRefusedAreEmpty) {
  Report report{provenance(), {}};
  report.members.push_back({{}, {}, refused_member("no such panel")});
  EXPECT_TRUE(histories_json(report.members[0])["times"].empty());
  EXPECT_THAT(report_html(report), HasSubstr("no such panel"));
}

TEST(Replay, HasAWholeRowPerFrame) {
  const Report report = small_report();
  const Model& model = report.members[0].bundle.model;
  const json replay = replay_json(report.members[0]);
  const std::vector<double> rows = doubles(replay["frames"]["bsm"]);
  const std::size_t width = 11 + replay["joints"].size() + replay["wheels"].size();
  EXPECT_EQ(replay["joints"].size(), model.assembly.links.size() - 1);
  EXPECT_EQ(rows.size(), width * report.members[0].result.engines[0].trajectory.samples.size());
}

/// What a spec could not name its parts by, were names not checked.
Report hostile_report() {
  Report report = small_report();
  Bundle& bundle = report.members[0].bundle;
  const std::string hostile = "</script><script>alert(1)</script>\"'&@DATA@";
  bundle.model.name = hostile;
  bundle.model.description = hostile;
  bundle.spec_file = hostile;
  bundle.emitted[kMjcf].text = "<mujoco>" + hostile;
  bundle.emitted[kResolved].text = hostile;
  for (Coordinate& coordinate : bundle.model.coordinates) coordinate.name = hostile;
  for (Link& link : bundle.model.assembly.links) link.name = hostile;
  report.members[0].settings = {{hostile, hostile}};
  return report;
}

TEST(Document, ShowsHostileNamesAsText) {
  const std::string page = report_html(hostile_report());
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_EQ(count_of(page, "</script>"), count_of(report_html(small_report()), "</script>"));
  EXPECT_THAT(page, HasSubstr("<h1>&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;&quot;&#39;"
                              "&amp;@DATA@</h1>"));
}

TEST(Document, KeepsHostileTextWholeInItsData) {
  const json data = json::parse(page_data(hostile_report()));
  EXPECT_EQ(data["description"], "</script><script>alert(1)</script>\"'&@DATA@");
  EXPECT_THAT(page_data(hostile_report()), Not(HasSubstr("<")));
}

TEST(Document, HoldsReportJsonAsItIs) {
  const Report report = small_report();
  json whole = json::parse(report_json(report));
  for (json& member : whole["members"]) member.erase("resolved");
  EXPECT_EQ(json::parse(page_data(report))["report"], whole);
}

/// What stands between the tags, in their order.
std::vector<std::string> between(const std::string& text, const std::string& begin,
                                 const std::string& end) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    found.push_back(text.substr(at, text.find(end, at) - at));
  }
  return found;
}

TEST(Document, LetsOnlyItsOwnScriptsAndStylesRun) {
  const std::string page = report_html(small_report());
  const std::string policy = between(page, "Content-Security-Policy\" content=\"", "\"").front();
  EXPECT_THAT(policy, HasSubstr("default-src 'none'"));
  EXPECT_THAT(policy, Not(HasSubstr("unsafe")));
  const std::vector<std::string> scripts = between(page, "<script>", "</script>");
  const std::vector<std::string> styles = between(page, "<style>", "</style>");
  EXPECT_EQ(scripts.size(), 4U);
  EXPECT_EQ(styles.size(), 2U);
  for (const std::string& text : scripts) EXPECT_THAT(policy, HasSubstr(csp_hash(text)));
  for (const std::string& text : styles) EXPECT_THAT(policy, HasSubstr(csp_hash(text)));
}

TEST(Document, KeepsTheLicencesOfItsParts) {
  const std::string page = report_html(small_report());
  EXPECT_THAT(page, HasSubstr("Dan Vanderkam"));
  EXPECT_THAT(page, HasSubstr("mrdoob"));
  EXPECT_GE(count_of(page, "THE SOFTWARE IS PROVIDED"), 2U);
}

TEST(Document, PointsNowhere) {
  const std::string page = report_html(small_report());
  EXPECT_THAT(page, Not(HasSubstr("sourceMappingURL")));
  EXPECT_THAT(page, Not(HasSubstr(" src=")));
  EXPECT_THAT(page, Not(HasSubstr("href=\"http")));
}

}  // namespace
}  // namespace twincraft
