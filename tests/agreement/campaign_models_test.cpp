// The campaigns among the shipped models fly to the answers that their files and models/README.md
// give.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace twincraft {
namespace {

using nlohmann::json;

/// The report of a campaign in which members break requirements.
json flown(const std::string& model) {
  const test::TemporaryFolder folder;
  const test::ProgramResult result = test::run_program(
      TWINCRAFT_SCSIM, {TWINCRAFT_ROOT "/models/gallery/" + model, "-o", folder.path()});
  EXPECT_EQ(result.exit_code, 1) << result.out << result.err;
  return json::parse(folder.read("report.json"));
}

int passed(const json& campaign, std::size_t output) {
  return campaign["outputs"][output]["pass"]["flown"]["passed"];
}
std::string strongest(const json& campaign, std::size_t output) {
  return campaign["outputs"][output]["drivers"][0]["name"];
}

void expect_that_engines_agree(const json& report, int twins) {
  EXPECT_EQ(report["complete"], true);
  EXPECT_EQ(report["verdict"], "not_judged");  // as the members that one engine flew
  EXPECT_EQ(report["campaign"]["twins"]["agree"], twins);
  EXPECT_EQ(report["campaign"]["twins"]["disagree"], 0);
  EXPECT_TRUE(report["campaign"]["failures"].empty());
}

TEST(CampaignModels, TheTelescopeSettlesInTimeNineTimesInTen) {
  const json report = flown("dispersed_telescope.yaml");
  const json& campaign = report["campaign"];
  expect_that_engines_agree(report, 10);  // every 32nd, and the two that are kept
  EXPECT_EQ(campaign["flown"], 256);
  EXPECT_EQ(passed(campaign, 0), 244);
  EXPECT_EQ(passed(campaign, 1), 229);
  EXPECT_EQ(strongest(campaign, 0), "panels.wing_p.stiffness");
  EXPECT_EQ(strongest(campaign, 2), "initial.rate.x");
}

TEST(CampaignModels, TheBurnTurnsTheVehicleAsTheThrustIsTilted) {
  const json report = flown("dispersed_burn.yaml");
  const json& campaign = report["campaign"];
  expect_that_engines_agree(report, 8);
  EXPECT_EQ(campaign["flown"], 64);
  EXPECT_EQ(passed(campaign, 0), 57);
  EXPECT_EQ(passed(campaign, 1), 57);
  EXPECT_EQ(passed(campaign, 2), 64);
  EXPECT_EQ(strongest(campaign, 0), "thrusters.main_engine.direction.z");
  EXPECT_EQ(strongest(campaign, 1), "thrusters.main_engine.thrust");
}

}  // namespace
}  // namespace twincraft
