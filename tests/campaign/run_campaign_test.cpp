// Members flown and reduced to records: whatever the number of threads, and whatever becomes of
// some of them.
#include "runtime/campaign/run_campaign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "compiler/diag/print.h"
#include "runtime/simulate/engines.h"
#include "runtime/simulate/propagate.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::vector<std::string> settings_of(std::size_t member) {
  std::vector<std::string> settings{
      "simulation.duration=6 s", "hub.mass=" + std::to_string(500 + member) + " kg",
      "panels.wing_p.angle=" + std::to_string(5 + member % 10) + " deg"};
  if (member == 5) settings.push_back("hub.mass=-1 kg");
  if (member == 6) settings.push_back("panels.wing_p.stiffness=1e9 N m/rad");
  return settings;
}

MemberSpec compile(std::size_t member, bool both) {
  Diagnostics diagnostics;
  const LoadResult loaded =
      load_spec({TWINCRAFT_ROOT "/models/quickstart.yaml", settings_of(member)}, diagnostics);
  std::optional<Bundle> bundle;
  if (loaded.spec) bundle = loaded.spec->compile(both ? Wanted{kMjcf} : Wanted{}, diagnostics);
  if (bundle) return {std::move(bundle), {}};
  return {{}, diagnostics.all().front().message};
}

OutputPlan output(const char* name, const char* signal, Reduce reduce, const char* unit) {
  OutputPlan plan;
  plan.name = name;
  plan.signal = signal;
  plan.reduce = reduce;
  plan.unit = unit;
  return plan;
}

CampaignRun campaign(std::vector<std::size_t> members) {
  CampaignRun run;
  run.plan.members = 40;
  run.plan.outputs = {output("wing_peak", "wing_p.1.position", Reduce::kMaxAbs, "rad"),
                      output("mass", "mass", Reduce::kFinal, "kg")};
  run.plan.outputs[0].below = 0.2;
  run.plan.twin_every = 10;
  run.members = std::move(members);
  run.drawn = [](std::size_t member) {
    return std::vector<double>{500.0 + static_cast<double>(member)};
  };
  run.compile = compile;
  return run;
}

std::vector<MemberRecord> flown(CampaignRun run, int jobs, const RunOptions& options = {}) {
  std::vector<MemberRecord> records;
  run.jobs = jobs;
  run.finished = [&records](MemberRecord record) {
    EXPECT_GT(record.seconds, 0.0);
    record.seconds = 0.0;
    records.push_back(std::move(record));
  };
  run_campaign(run, options);
  return records;
}

std::vector<std::size_t> first(std::size_t count) {
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < count; ++i) members.push_back(i);
  return members;
}

/// Of wing_p, as a recorded run of the member has it [rad].
double peak_alone(std::size_t member) {
  const Bundle bundle = *compile(member, false).bundle;
  double peak = 0.0;
  for (const Observation& sample :
       propagate(*make_engine(EngineKind::kBsm, bundle), bundle.model).samples)
    peak = std::max(peak, std::abs(sample.joint_position.at(0)));
  return peak;
}

TEST(RunCampaign, LeavesARecordOfEveryMember) {
  const std::vector<MemberRecord> records = flown(campaign(first(23)), 2);
  ASSERT_EQ(records.size(), 23U);
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].member, i);
    EXPECT_THAT(records[i].drawn, ElementsAre(500.0 + static_cast<double>(i)));
    if (i == 5 || i == 6) continue;
    EXPECT_NEAR(records[i].outputs[0].value(), peak_alone(i), 1e-12) << i;
    EXPECT_EQ(records[i].outputs[1], 600.0 + static_cast<double>(i)) << i;  // with the panels
    EXPECT_EQ(records[i].twin.has_value(), i % 10 == 0);
    EXPECT_EQ(records[i].verdict, i % 10 == 0 ? Verdict::kAgree : Verdict::kNotJudged);
    EXPECT_EQ(records[i].reason.find("is not below 0.2 rad") != std::string::npos,
              records[i].outputs[0] >= 0.2)
        << records[i].reason;
  }
}

TEST(RunCampaign, SaysWhyAMemberCouldNotBeFlown) {
  const std::vector<MemberRecord> records = flown(campaign(first(8)), 1);
  EXPECT_EQ(records[5].verdict, Verdict::kFailed);
  EXPECT_THAT(records[5].reason, HasSubstr("mass"));
  EXPECT_THAT(records[5].outputs, ElementsAre(std::nullopt, std::nullopt));
  EXPECT_EQ(records[6].verdict, Verdict::kFailed);
  EXPECT_THAT(records[6].reason, HasSubstr("at t = "));
  EXPECT_THAT(records[6].outputs, ElementsAre(std::nullopt, std::nullopt));
}

TEST(RunCampaign, GivesTheSameRecordsWhateverElseIsFlown) {
  const std::vector<MemberRecord> records = flown(campaign(first(40)), 1);
  EXPECT_EQ(flown(campaign(first(40)), 3), records);
  const std::vector<MemberRecord> some = flown(campaign({3, 7, 17, 20, 39}), 2);
  EXPECT_THAT(some, ElementsAre(records[3], records[7], records[17], records[20], records[39]));
}

TEST(RunCampaign, StopsAMemberEarly) {
  CampaignRun run = campaign(first(3));
  run.plan.stops.resize(1);
  run.plan.stops[0].signal = "rw_x.rate";
  run.plan.stops[0].above = 0.2;
  run.plan.outputs = {output("speed", "rw_x.rate", Reduce::kFinal, "rad/s")};
  run.plan.twin_every = 0;
  for (const MemberRecord& record : flown(run, 1)) {
    EXPECT_THAT(record.reason, StartsWith("stopped at "));
    EXPECT_GT(record.outputs[0].value(), 0.2);
    EXPECT_LT(record.outputs[0].value(), 0.3);
  }
}

TEST(RunCampaign, DropsWhatIsOnItsWayWhenItIsStopped) {
  std::atomic<bool> stop = false;
  CampaignRun run = campaign(first(40));
  std::vector<MemberRecord> records;
  run.finished = [&](MemberRecord record) {
    records.push_back(std::move(record));
    stop = true;
  };
  RunOptions options;
  options.stop = &stop;
  run_campaign(run, options);
  EXPECT_GT(records.size(), 0U);
  EXPECT_LT(records.size(), 40U);
  const std::vector<MemberRecord> all = flown(campaign(first(records.size())), 1);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].seconds = 0.0;
    EXPECT_EQ(records[i], all[i]);
  }
}

}  // namespace
}  // namespace twincraft
