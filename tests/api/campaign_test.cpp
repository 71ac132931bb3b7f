// Campaigns by the facade and by the C interface: whole, in shards that are joined, member by
// member.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "tests/api/vehicles.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Seven members with a drawn mass, flown for 2 s; both engines fly 0 and 4.
Model drawn(const std::vector<std::string>& further = {}) {
  std::vector<std::string> set{
      "simulation.duration=2 s",
      "campaign={members: 7, dispersions: [{set: hub.mass, normal: {sigma: 2 %}}], outputs: "
      "[{name: "
      "peak, of: wing_p.1.position, reduce: max_abs, require: {below: 1 rad}}, {name: touch, of: "
      "wing_p.1.position, reduce: first_crossing, level: 1 rad}], twin: {every: 4}}"};
  set.insert(set.end(), further.begin(), further.end());
  return Model::load(test::file("models/quickstart.yaml"), set);
}

/// campaign.csv without its last column, the time that members took.
std::string table(const Campaign& campaign) {
  std::string text, line;
  std::istringstream csv(campaign.text(TC_CAMPAIGN_CSV));
  while (std::getline(csv, line)) text += line.substr(0, line.rfind(',')) + "\n";
  return text;
}

std::vector<double> column(const Campaign& campaign, std::size_t index) {
  std::vector<double> values(campaign.rows());
  campaign.read(index, values.data(), values.size());
  return values;
}

/// A folder that goes with the test.
struct Folder {
  fs::path path =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  Folder() { fs::remove_all(path); }
  ~Folder() { fs::remove_all(path); }
  std::string operator/(const char* name) const { return (path / name).string(); }
};

TEST(Campaigns, AreATable) {
  const Campaign campaign = drawn().campaign();
  EXPECT_TRUE(campaign);
  EXPECT_EQ(campaign.exit_code(), 0);
  EXPECT_EQ(campaign.verdict(), "not_judged");
  EXPECT_THAT(campaign.text(), HasSubstr("7 of 7 members flown"));
  EXPECT_THAT(campaign.json(), HasSubstr("\"campaign\""));
  std::vector<std::string> names;
  for (const Signal& one : campaign.columns()) names.push_back(one.name + " [" + one.unit + "]");
  EXPECT_THAT(names, ElementsAre("hub.mass [kg]", "peak [rad]", "touch [s]", "seconds [s]"));
  ASSERT_EQ(campaign.rows(), 7u);
  EXPECT_NE(column(campaign, 0).at(1), column(campaign, 0).at(2));
  EXPECT_THAT(column(campaign, 1), testing::Each(testing::Gt(0.1)));
  EXPECT_TRUE(std::isnan(column(campaign, 2).at(0)));
  EXPECT_EQ(campaign.row(4).verdict, "agree");
  EXPECT_EQ(campaign.row(5).verdict, "not_judged");
  EXPECT_EQ(campaign.row(5).member, 5u);
  EXPECT_EQ(campaign.row(5).reason, "");
  EXPECT_THAT(campaign.text(TC_CAMPAIGN_HEADER), HasSubstr("\"meaning\""));
}

TEST(Campaigns, JoinShardsThatWereFlownElsewhere) {
  const Model model = drawn();
  const std::string whole = table(model.campaign());
  CampaignOptions joined;
  for (std::size_t shard = 1; shard <= 3; ++shard) {
    CampaignOptions part;
    part.shard = shard;
    part.shards = 3;
    const Campaign flown = model.campaign(part);
    EXPECT_EQ(flown.rows(), 0u);
    EXPECT_STREQ(flown.json(), "");
    EXPECT_THROW(flown.save(testing::TempDir()), UsageError);
    joined.records.push_back(flown.text(TC_CAMPAIGN_RECORDS));
    joined.records.push_back(joined.records.back());  // flown twice
  }
  EXPECT_EQ(table(model.campaign(joined)), whole);
  joined.records.resize(2);  // what is missing is flown
  joined.records.back().resize(joined.records.back().size() - 3);
  EXPECT_EQ(table(model.campaign(joined)), whole);
}

TEST(Campaigns, RefuseRecordsOfAnother) {
  CampaignOptions options;
  options.records = {drawn({"campaign.seed=9"}).campaign().text(TC_CAMPAIGN_RECORDS)};
  EXPECT_THROW(drawn().campaign(options), FileError);
  options.records = {"no records"};
  EXPECT_THROW(drawn().campaign(options), FileError);
}

TEST(Campaigns, GoOnInTheirFolder) {
  const Folder folder;
  CampaignOptions options;
  options.folder = folder / "out";
  options.shard = 1;
  options.shards = 2;
  (void)drawn().campaign(options);
  EXPECT_FALSE(fs::exists(folder / "out/campaign.csv"));
  options.shard = options.shards = 0;
  options.resume = true;
  const Campaign flown = drawn().campaign(options);
  EXPECT_EQ(flown.rows(), 7u);
  EXPECT_EQ(table(flown), table(drawn().campaign()));
  flown.save(folder / "saved");
  for (const char* name : {"report.json", "shards/1-of-2.records", "shards/spec.yaml"})
    EXPECT_TRUE(fs::exists(folder.path / "saved" / name)) << name;
  EXPECT_THROW(drawn({"campaign.seed=9"}).campaign(options), FileError);
}

TEST(Campaigns, NameTheirWorstMembers) {
  const Campaign campaign = drawn().campaign();
  EXPECT_THAT(campaign.worst(3), SizeIs(3));
  EXPECT_EQ(campaign.worst(3), campaign.worst(3, "peak"));
  EXPECT_THAT(campaign.worst(0), IsEmpty());
  EXPECT_THAT(campaign.worst(100), SizeIs(7));
  try {
    (void)campaign.worst(1, "pek");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "unknown output `pek`; did you mean `peak`?");
  }
}

TEST(Campaigns, GiveTheirMembersAsModels) {
  const Model model = drawn();
  EXPECT_EQ(model.campaign_members(), 7u);
  const Model member = model.member(4);
  EXPECT_EQ(member.campaign_members(), 0u);
  const double drawn_mass = column(model.campaign(), 0).at(4);
  EXPECT_NEAR(member.mass_properties().mass - model.mass_properties().mass, drawn_mass - 600.0,
              1e-9);
  EXPECT_THROW(model.member(7), UsageError);
  EXPECT_THROW(member.member(0), SpecError);
}

TEST(Campaigns, AreOfSpecsThatHaveOne) {
  try {
    (void)test::quickstart().campaign();
    FAIL();
  } catch (const SpecError& error) {
    EXPECT_STREQ(error.what(), "`wheels_and_panels` has no `campaign`");
  }
}

TEST(Campaigns, RefuseWhatMakesNoSense) {
  CampaignOptions options;
  options.isa = "sse9";
  EXPECT_THROW(drawn().campaign(options), UsageError);
  options.isa = "portable";
  options.shard = 3;
  options.shards = 2;
  EXPECT_THROW(drawn().campaign(options), UsageError);
}

TEST(Campaigns, EndWhenAPollSaysSo) {
  const Folder folder;
  CampaignOptions options;
  options.folder = folder / "out";
  options.poll = [](void*) { return 1; };
  const Model longer = drawn({"simulation.duration=1000 s", "campaign.members=100000"});
  try {
    const Campaign campaign = longer.campaign(options);  // some members were flown
    EXPECT_EQ(campaign.verdict(), "interrupted");
    EXPECT_LT(campaign.rows(), 100000u);
  } catch (const Interrupted&) {  // none was
  }
  EXPECT_TRUE(fs::exists(folder / "out/shards/1-of-1.records"));
}

TEST(CInterface, TakesNothingForACampaign) {
  tc_run* campaign = nullptr;
  EXPECT_EQ(tc_model_campaign(nullptr, nullptr, &campaign), TC_USAGE);
  EXPECT_EQ(tc_campaign_rows(nullptr), 0u);
  EXPECT_EQ(tc_campaign_column_name(nullptr, 0), nullptr);
  EXPECT_EQ(tc_campaign_read(nullptr, 0, nullptr, 0), TC_USAGE);
  EXPECT_EQ(tc_campaign_row(nullptr, 0, nullptr, nullptr, nullptr), TC_USAGE);
  EXPECT_STREQ(tc_campaign_text(nullptr, TC_CAMPAIGN_CSV, nullptr), "");
  const Model model = drawn();
  ASSERT_EQ(tc_model_campaign(model.handle(), nullptr, &campaign), TC_OK);
  double numbers[3] = {};
  EXPECT_EQ(tc_campaign_read(campaign, 0, numbers, 3), TC_USAGE);
  EXPECT_EQ(tc_campaign_read(campaign, 4, numbers, 3), TC_USAGE);
  EXPECT_EQ(tc_campaign_row(campaign, 7, nullptr, nullptr, nullptr), TC_USAGE);
  EXPECT_EQ(tc_run_save(campaign, ""), TC_USAGE);
  tc_run_free(campaign);
  ASSERT_EQ(tc_model_run(model.handle(), nullptr, &campaign), TC_OK);  // the nominal vehicle
  EXPECT_EQ(tc_campaign_rows(campaign), 0u);
  EXPECT_EQ(tc_campaign_row(campaign, 0, nullptr, nullptr, nullptr), TC_USAGE);
  tc_run_free(campaign);
  tc_campaign_options options{};
  EXPECT_EQ(tc_model_campaign(model.handle(), &options, &campaign), TC_USAGE);
  EXPECT_THAT(tc_run_error(campaign), HasSubstr("its size"));
  tc_run_free(campaign);
}

}  // namespace
}  // namespace twincraft
