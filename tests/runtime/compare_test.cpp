// Claims about trajectories compared in process: which columns and times are common, in which
// units, and what of them is judged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runtime/delivery/compare_run.h"
#include "tests/runtime/handmade.h"
#include "tests/support/run_program.h"

namespace twincraft {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kAttitude = "q_BN.w [1],q_BN.x [1],q_BN.y [1],q_BN.z [1]";

class Compare : public testing::Test {
 protected:
  CompareRun compare(const std::string& a, const std::string& b, const Model* spec = nullptr) {
    CompareRequest request;
    request.a = folder.write("a.csv", a);
    request.b = folder.write("b.csv", b);
    request.spec = spec;
    request.spec_name = "spec.yaml";
    return compare_files(request);
  }

  /// Key or name, and maximum, of all that two texts differ in.
  std::map<std::string, double> maxima(const std::string& a, const std::string& b,
                                       const Model* spec = nullptr) {
    return maxima(compare(a, b, spec));
  }
  static std::map<std::string, double> maxima(const CompareRun& run) {
    EXPECT_THAT(faults_of(run), "");
    std::map<std::string, double> found;
    for (const TrajectoryDifference& pair : run.pairs()) {
      for (const Metric& metric : pair.comparison.metrics) found[metric.key] = metric.maximum;
      for (const ColumnDifference& each : pair.others) found[each.name] = each.peak.maximum;
    }
    return found;
  }
  static std::string faults_of(const CompareRun& run) {
    std::string text;
    for (const FileFault& fault : run.faults()) text += to_text(fault);
    return text;
  }

  TemporaryFolder folder;
};

TEST_F(Compare, TakesAnAttitudeForWhatItIsWhateverItsSignAndLength) {
  EXPECT_THAT(maxima("t [s]," + kAttitude + "\n0,1,0,0,0\n1,0.6,0.8,0,0\n",
                     "t [s]," + kAttitude + "\n0,-3,0,0,0\n1,-60,-80,0,0\n"),
              ElementsAre(std::pair("attitude_deg", 0.0)));
  EXPECT_THAT(maxima("t [s]," + kAttitude + "\n0,1e-200,0,0,0\n",
                     "t [s]," + kAttitude + "\n0,0,1e200,0,0\n"),
              ElementsAre(std::pair("attitude_deg", 180.0)));
  // Half a turn about z against none.
  EXPECT_THAT(
      maxima("t [s]," + kAttitude + "\n0,1,0,0,0\n", "t [s]," + kAttitude + "\n0,0,0,0,2\n"),
      ElementsAre(std::pair("attitude_deg", 180.0)));
}

TEST_F(Compare, PassesNoQuaternionOfLengthZero) {
  Model model = test::model_of_every_kind();
  model.agreement.attitude = 1.0;
  const CompareRun run = compare("t [s]," + kAttitude + "\n0,1,0,0,0\n1,0,0,0,0\n",
                                 "t [s]," + kAttitude + "\n0,1,0,0,0\n1,1,0,0,0\n", &model);
  EXPECT_EQ(run.exit_code(), 1);
  EXPECT_THAT(run.text(), HasSubstr("`q_BN` of `" + folder.path() +
                                    "/a.csv` has the length 0, the first time at 1 s\n"));
}

TEST_F(Compare, ConvertsUnitsAndFindsColumnsInAnyOrder) {
  const std::string si = "t [s],r_BN_N.x [m],r_BN_N.y [m],r_BN_N.z [m],arm.position [rad]\n";
  const std::string other =
      "arm.position [deg],r_BN_N.z [km],t [min],r_BN_N.y [km],r_BN_N.x [mm]\n";
  const auto found = maxima(
      si + "0,1,2000,3000,0.5\n60,4,5000,6000," + std::to_string(std::numbers::pi / 4) + "\n",
      other + "28.64788975654116,3,0,2,1000\n45,6,1,5,4000\n");
  EXPECT_LT(found.at("position_m"), 1e-12);
  EXPECT_LT(found.at("joint_deg"), 1e-4);  // of the six digits of std::to_string
  EXPECT_EQ(found.size(), 2u);
}

TEST_F(Compare, MeetsTimesWithinANanosecondAndInterpolatesNever) {
  const std::string head = "t [s],mass [kg]\n";
  const std::string a = head + "0,1\n1,2\n2,3\n";
  EXPECT_THAT(maxima(a, head + "0.0000000005,1\n0.9999999995,2\n1.5,100\n2,3\n"),
              ElementsAre(std::pair("mass_kg", 0.0)));
  const CompareRun run = compare(a, head + "0.00000001,5\n0.99999999,5\n2,3\n");
  ASSERT_EQ(run.pairs().size(), 1u);
  EXPECT_EQ(run.pairs()[0].times, 1u);
  EXPECT_EQ(run.pairs()[0].a.lone_times, 2u);
  EXPECT_EQ(run.pairs()[0].b.lone_times, 2u);
  EXPECT_EQ(run.pairs()[0].comparison.metrics[0].maximum, 0.0);
  EXPECT_FALSE(run.pairs()[0].comparison.same_times);
}

TEST_F(Compare, ComparesASubsetOfTheTimes) {
  const std::string head = "t [s],mass [kg]\n";
  const CompareRun run =
      compare(head + "0,1\n0.5,7\n1,2\n1.5,7\n2,3.5\n", head + "1,2\n2,3\n3,9\n");
  ASSERT_EQ(run.pairs().size(), 1u);
  EXPECT_EQ(run.pairs()[0].times, 2u);
  EXPECT_EQ(run.pairs()[0].comparison.metrics[0].maximum, 0.5);
  EXPECT_EQ(run.pairs()[0].comparison.metrics[0].at, 2.0);
}

TEST_F(Compare, TellsCoordinatesByUnitAndNameWithoutASpec) {
  const std::string head =
      "t [s],rw.rate [rad/s],arm.position [rad],arm.rate [rad/s],rail.position [m],"
      "bob.phi.position [rad],bob.theta.position [rad],sun.rate [m]\n";
  const auto found = maxima(head + "0,0,0,0,0,0,0,0\n", head + "0,1,2,3,4,5,6,7\n");
  EXPECT_EQ(found.at("wheel_rate_rad_s"), 1.0);
  EXPECT_DOUBLE_EQ(found.at("joint_deg"), 360.0 / std::numbers::pi);
  EXPECT_EQ(found.at("arm.rate"), 3.0);
  EXPECT_EQ(found.at("joint_m"), 4.0);
  EXPECT_DOUBLE_EQ(found.at("pendulum_deg"), 1080.0 / std::numbers::pi);
  EXPECT_EQ(found.at("sun.rate"), 7.0);
  EXPECT_EQ(found.size(), 6u);
}

TEST_F(Compare, KnowsNoWheelByARateWhosePositionOneFileHas) {
  const auto found =
      maxima("t [s],arm.position [rad],arm.rate [rad/s]\n0,0,1\n", "t [s],arm.rate [rad/s]\n0,3\n");
  EXPECT_THAT(found, ElementsAre(std::pair("arm.rate", 2.0)));
}

TEST_F(Compare, TakesCoordinatesAndTolerancesFromASpec) {
  Model model = test::model_of_every_kind();
  model.agreement.slosh = 0.5;
  model.agreement.wheel = 1e-3;
  const std::string head = "t [s],slosh.position [m],rail.position [m],rw_x.rate [rad/s]\n";
  const CompareRun held = compare(head + "0,0,0,1\n", head + "0,0.25,3,1\n", &model);
  EXPECT_THAT(maxima(held), ElementsAre(std::pair("joint_m", 3.0), std::pair("slosh_m", 0.25),
                                        std::pair("wheel_rate_rad_s", 0.0)));
  EXPECT_EQ(held.verdict(), Verdict::kAgree);
  EXPECT_EQ(held.exit_code(), 0);
  const CompareRun broken = compare(head + "0,0,0,1\n", head + "0,0.75,3,1\n", &model);
  EXPECT_EQ(broken.verdict(), Verdict::kDisagree);
  EXPECT_EQ(broken.exit_code(), 1);
}

TEST_F(Compare, SaysWhichToleranceJudgesNothing) {
  Model model = test::model_of_every_kind();
  model.agreement.slosh = 0.5;
  model.agreement.rate = 0.5;
  const CompareRun run =
      compare("t [s],slosh.position [m]\n0,0\n", "t [s],slosh.position [m]\n0,0\n", &model);
  EXPECT_EQ(run.verdict(), Verdict::kAgree);
  EXPECT_THAT(run.text(), HasSubstr("note: 1 tolerance is not judged, without the columns in both "
                                    "files: `body rate`\n"));
}

TEST_F(Compare, NeverPassesWhatIsNotFinite) {
  Model model = test::model_of_every_kind();
  model.agreement.mass = 1.0;
  const std::string head = "t [s],mass [kg],r_BN_N.x [m],r_BN_N.y [m],r_BN_N.z [m]\n";
  for (const char* value : {"nan", "inf"}) {
    const std::string bad = head + "0," + value + ",0,0,0\n1,1,0,0,0\n";
    EXPECT_EQ(compare(bad, bad, &model).exit_code(), 1) << value;
    // The hub's position has no tolerance.
    const std::string worse = head + "0,1,0," + value + ",0\n1,1,0,0,0\n";
    EXPECT_EQ(compare(worse, worse, &model).exit_code(), 1) << value;
  }
  const CompareRun run = compare(head + "0,1,0,0,0\n", head + "0,1,0,-inf,0\n");
  EXPECT_EQ(run.verdict(), Verdict::kNotJudged);
  EXPECT_THAT(run.text(), HasSubstr("/b.csv` is not finite, the first in line 2, column "
                                    "`r_BN_N.y`\n"));
}

TEST_F(Compare, ListsOtherColumnsAndThoseThatItCanNotCompare) {
  const CompareRun run =
      compare("t [s],euler.z [deg],label,power [W],r_BN_N.x [m],extra [m]\n0,1,on,1,0,0\n",
              "t [s],euler.z [rad],label,power [kg],r_BN_N.x [m],more [foo]\n0,1,off,1,5,0\n");
  const auto found = maxima(run);
  EXPECT_NEAR(found.at("euler.z"), 180.0 / std::numbers::pi - 1.0, 1e-12);
  EXPECT_EQ(found.at("r_BN_N.x"), 5.0);  // a third of a position is no position
  EXPECT_EQ(found.size(), 2u);
  EXPECT_THAT(run.text(),
              HasSubstr("note: 2 columns are not compared, with units that are missing, unknown or "
                        "different: `label`, `power`\n"));
  EXPECT_THAT(run.text(), HasSubstr("/a.csv` alone: `extra`\n"));
  EXPECT_THAT(run.text(), HasSubstr("/b.csv` alone: `more`\n"));
}

TEST_F(Compare, RefusesAColumnOfOursWithoutItsUnit) {
  const std::string good = "t [s],mass [kg],w.position [deg],rw.rate [rpm]\n0,1,1,1\n";
  const std::string b = folder.path() + "/b.csv";
  EXPECT_EQ(faults_of(compare(good, "t [s],mass,w.position [m],rw.rate [Hz]\n0,1,1,1\n")),
            b + ":1:7: error: `mass` has no unit\n  hint: write `mass [kg]`\n" +  //
                b +
                ":1:12: error: the unit of `w.position`: `m` is a length, an angle [rad] is "
                "expected\n" +
                b +
                ":1:27: error: the unit of `rw.rate`: `Hz` is a frequency, an angular rate "
                "[rad/s] is expected\n"
                "  hint: count in angles: `rad/s`, `deg/s`, `rpm` or `rev/s`\n");
}

TEST_F(Compare, RefusesWhatHasNothingInCommon) {
  const std::string a = "t [s],mass [kg]\n0,1\n1,1\n";
  const CompareRun times = compare(a, "t [s],mass [kg]\n0.5,1\n1.5,1\n");
  EXPECT_EQ(times.exit_code(), 3);
  EXPECT_THAT(faults_of(times), HasSubstr("/a.csv: error: no time in common with "));
  EXPECT_THAT(faults_of(times),
              HasSubstr("nothing is interpolated: record both at the same times"));
  const CompareRun columns = compare(a, "t [s],weight [kg]\n0,1\n1,1\n");
  EXPECT_EQ(columns.exit_code(), 3);
  EXPECT_THAT(faults_of(columns), HasSubstr("/a.csv: error: no column in common with "));
  EXPECT_EQ(compare(a, "t [s],mass [kg]\n").exit_code(), 3);
  EXPECT_EQ(columns.text(), "");
}

TEST_F(Compare, PairsFilesOfOneNameInFoldersAndInTheirMembers) {
  const std::string text = "t [s],mass [kg]\n0,1\n", other = "t [s],mass [kg]\n0,2\n";
  std::filesystem::create_directories(folder.path() + "/a/0001");
  std::filesystem::create_directories(folder.path() + "/b/0001");
  for (const char* name : {"a/bsm.csv", "a/0001/bsm.csv", "b/bsm.csv", "a/lone.csv", "a/note.txt"})
    folder.write(name, text);
  folder.write("b/0001/bsm.csv", other);
  CompareRequest request;
  request.a = folder.path() + "/a";
  request.b = folder.path() + "/b";
  const CompareRun run = compare_files(request);
  ASSERT_EQ(run.pairs().size(), 2u);
  EXPECT_EQ(run.pairs()[0].a.name, request.a + "/0001/bsm.csv");
  EXPECT_EQ(run.pairs()[0].comparison.metrics[0].maximum, 1.0);
  EXPECT_EQ(run.pairs()[1].comparison.metrics[0].maximum, 0.0);
  EXPECT_THAT(run.text(), HasSubstr("note: 1 file is in `" + request.a + "` alone: `lone.csv`\n"));
  // A fault in one leaves the others compared.
  folder.write("b/0001/bsm.csv", "t [s]\n");
  const CompareRun faulty = compare_files(request);
  EXPECT_EQ(faulty.exit_code(), 3);
  EXPECT_EQ(faulty.pairs().size(), 1u);
}

}  // namespace
}  // namespace twincraft
