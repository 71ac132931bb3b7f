// Claims about campaigns that take the whole chain, from what is drawn to what is concluded: of a
// vehicle whose answer is known in closed form, and of engines that are made to disagree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/delivery/campaign_run.h"
#include "runtime/report/campaign_json.h"

namespace twincraft {
namespace {

using nlohmann::json;
using testing::ElementsAreArray;

CompiledSpec compiled(const CompileRequest& request) {
  Diagnostics diagnostics;
  Compilation made = compile_spec(request, wanted_by_run(true), diagnostics);
  if (!made.compiled) throw std::runtime_error(made.io_error + diagnostics.all().front().message);
  return *std::move(made.compiled);
}

// ---- A linear vehicle: what comes out is known in closed form.

constexpr double kSigma = 0.1;                            // [m/s]
constexpr double kMean = 4.0, kDeviation = 2.0 * kSigma;  // [m] of the travel in 2 s
constexpr double kBound = 4.2;                            // [m]
const double kHolds = 0.5 * std::erfc(-(kBound - kMean) / kDeviation / std::sqrt(2.0));
const double kP95 = kMean + 1.6448536269514722 * kDeviation;  // [m]
constexpr std::size_t kSeeds = 200, kMembers = 300;

const char* const kCoasting = R"(format: spacecraft/1
name: coasting
hub: {mass: 100 kg, inertia: [10, 20, 30]}
initial: {velocity: [2, 0, 0]}
simulation: {integrator: rk4, step: 1 s, duration: 2 s, record: 2 s}
campaign:
  members: 300
  dispersions: [{set: initial.velocity, normal: {sigma: 0.1 m/s}}]
  outputs: [{name: travel, of: r_BN_N.x, reduce: final, require: {below: 4.2 m}}]
)";

CampaignReport coasting(std::size_t seed) {
  const CompiledSpec spec = compiled(
      {"coasting.yaml", {"campaign.seed=" + std::to_string(seed)}, std::string(kCoasting)});
  CampaignRequest request;
  request.twins = CampaignRequest::Twins::kNone;
  return *fly_campaign(spec, request).report;
}

bool is_within(double value, const std::optional<double>& lower,
               const std::optional<double>& upper) {
  return (!lower || *lower <= value) && (!upper || value <= *upper);
}

// What is claimed with 95 % confidence is true in 95 % of 200 campaigns. Chance alone moves that by
// 1.5 % (one standard deviation).
TEST(CampaignChain, IsRightAsOftenAsItSays) {
  std::size_t rates = 0, percentiles = 0, tolerances = 0;
  std::vector<double> travels;
  for (std::size_t seed = 1; seed <= kSeeds; ++seed) {
    const CampaignReport report = coasting(seed);
    const OutputSummary& found = report.findings.outputs.at(0).summary;
    ASSERT_EQ(found.count, kMembers);
    rates += is_within(kHolds, found.flown.interval.lower, found.flown.interval.upper);
    percentiles += is_within(kP95, found.p95_bounds.lower, found.p95_bounds.upper);
    tolerances += *found.tolerance_upper >= kP95;
    std::ranges::copy(report.campaign.table.output(0), std::back_inserter(travels));
  }
  for (const std::size_t right : {rates, percentiles, tolerances}) {
    EXPECT_GE(right, kSeeds * 92 / 100);
    EXPECT_LE(right, kSeeds * 98 / 100);
  }
  // Normal numbers in, normal numbers out, by the test of Kolmogorov and Smirnov at 1 %.
  std::ranges::sort(travels);
  const auto count = static_cast<double>(travels.size());
  double farthest = 0.0;
  for (std::size_t i = 0; i < travels.size(); ++i) {
    const double share = 0.5 * std::erfc(-(travels[i] - kMean) / kDeviation / std::sqrt(2.0));
    farthest = std::max({farthest, share - static_cast<double>(i) / count,
                         static_cast<double>(i + 1) / count - share});
  }
  EXPECT_LT(farthest, 1.63 / std::sqrt(count));
}

// ---- Engines that disagree.

// Turning about its middle axis a body tumbles, and the rounding of the engines grows e-fold every
// two seconds. A wheel at speed holds the axis. No tolerance of this spec knows of that.
const char* const kTumbling = R"(format: spacecraft/1
name: tumbler
hub: {mass: 100 kg, inertia: [10, 20, 30]}
wheels:
  - {name: w, axis: [0, 1, 0], spin_inertia: 0.08 kg m2, transverse_inertia: 0.04 kg m2, speed: 1 rpm}
initial: {rate: [1.0e-3, 1, 1.0e-3]}
simulation: {integrator: rk4, step: 0.02 s, duration: 60 s, record: 0.5 s}
agreement: {rate: 1.0e-13 rad/s}
campaign:
  members: 24
  seed: 3
  dispersions:
    - {set: hub.mass, normal: {sigma: 2 %}}
    - {set: wheels.w.speed, choice: {values: [0 rpm, 6000 rpm]}}
  outputs: [{name: rate, of: omega_BN_B, reduce: max_norm}]
  twin: {every: 2}
)";

TEST(CampaignChain, FindsAndNamesEnginesThatDisagree) {
  const CampaignResult result = fly_campaign(compiled({"tumbling.yaml", {}, kTumbling}), {});
  EXPECT_EQ(result.exit_code(), kExitFindings);
  EXPECT_EQ(result.verdict, Verdict::kDisagree);
  const CampaignTable& table = result.report->campaign.table;
  std::vector<std::size_t> tumbling;
  for (std::size_t member = 0; member < table.rows(); ++member) {
    const bool is_twin = member % 2 == 0, tumbles = is_twin && table.drawn(1)[member] == 0.0;
    if (tumbles) tumbling.push_back(member);
    EXPECT_EQ(table.verdict(member), tumbles   ? Verdict::kDisagree
                                     : is_twin ? Verdict::kAgree
                                               : Verdict::kNotJudged)
        << member;
    EXPECT_EQ(table.reason(member).starts_with("rate_rad_s "), tumbles) << table.reason(member);
  }
  ASSERT_GT(tumbling.size(), 2U);
  ASSERT_LT(tumbling.size(), 10U);
  const json twins = campaign_report_value(*result.report)["campaign"]["twins"];
  EXPECT_EQ(twins["disagree"], tumbling.size());
  EXPECT_EQ(twins["agree"], 12 - tumbling.size());
  EXPECT_THAT(twins["members"], ElementsAreArray(tumbling));
  EXPECT_EQ(twins["driver"]["name"], "wheels.w.speed");
  EXPECT_EQ(twins["driver"]["larger_where_they_disagree"], 0.0);
  EXPECT_LT(twins["driver"]["p_value"], 0.01);
}

}  // namespace
}  // namespace twincraft
