// Claims about campaigns as the user of scsim meets them: the same bytes however they are flown,
// and nothing lost that was done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "runtime/report/netcdf.h"
#include "tests/support/run_program.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramResult;
using test::TemporaryFolder;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

const std::string kQuickstart = TWINCRAFT_ROOT "/models/quickstart.yaml";

const std::string kCampaign = R"(extends: quickstart.yaml
simulation: {duration: 3 s, record: 0.1 s}
campaign:
  members: 40
  seed: 7
  dispersions:
    - {set: hub.mass, normal: {sigma: 2 %}}
    - {set: hub.inertia, inertia: {sigma: 5 %, tilt: 1 deg}}
    - {set: panels.*.stiffness, uniform: {low: 80 %, high: 120 %}}
    - {set: initial.attitude, rotation: {sigma: 2 deg}}
  outputs:
    - {name: peak, of: wing_p.1.position, reduce: max_abs, require: {below: 12.5 deg}}
    - {name: turn, of: omega_BN_B.z, reduce: final}
  keep: {worst: 1, by: peak, members: [3]}
  twin: {every: 10}
)";

using Flags = std::vector<std::string>;

/// A campaign of nothing but members: no engine but bsm, no trajectory.
const Flags kPlain{"--engine", "bsm", "--set", "campaign.keep=null"};
/// One hub in two, or so, has a mass that none can have.
const Flags kFailing{"--set", "campaign.keep=null", "--set",
                     "campaign.dispersions=[{set: hub.mass, choice: {values: [600, -1]}}]"};
// Long enough for a signal to come in the middle: batches of few members, of short steps.
#ifdef TWINCRAFT_SANITIZED
const char* const kShortStep = "simulation.step=1 ms";
#else
const char* const kShortStep = "simulation.step=0.05 ms";
#endif
const Flags kSlow{"--jobs",   "1",        "--isa",      "portable",
                  "--engine", "bsm",      "--set",      "campaign.keep=null",
                  "--set",    kShortStep, "--progress", "always"};

Flags joined(Flags one, const Flags& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The cells of a line of CSV, those in quotes without them.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"')
      is_quoted = !is_quoted;
    else if (c == ',' && !is_quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

std::vector<double> column_of(const std::string& csv, const std::string& name) {
  const std::vector<std::string> lines = lines_of(csv);
  const std::vector<std::string> names = cells_of(lines.at(0));
  const auto place = std::ranges::find(names, name) - names.begin();
  std::vector<double> numbers;
  for (std::size_t i = 1; i < lines.size(); ++i)
    numbers.push_back(std::stod(cells_of(lines[i]).at(static_cast<std::size_t>(place))));
  return numbers;
}

/// Every file below a folder, by its path.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path()] = test::read_file(entry.path());
  return files;
}

class ScsimCampaign : public testing::Test {
 protected:
  ScsimCampaign() {
    fs::copy_file(kQuickstart, folder.path() + "/quickstart.yaml");
    folder.write("spec.yaml", kCampaign);
  }

  ProgramResult run(const Flags& arguments, test::ProgramInput input = {}) const {
    input.folder = folder.path();
    return test::run_program(TWINCRAFT_SCSIM, arguments, input);
  }
  ProgramResult fly(const std::string& out, const Flags& flags = {},
                    const test::ProgramInput& input = {}) const {
    return run(joined({"spec.yaml", "-o", out, "--no-timing"}, flags), input);
  }
  ProgramResult merge(const std::string& out) const { return run({"merge", out}); }

  /// The lines of campaign.csv without their last cell: the seconds.
  std::vector<std::string> table(const std::string& out) const {
    std::vector<std::string> lines = lines_of(folder.read(out + "/campaign.csv"));
    for (std::string& line : lines) line.erase(line.rfind(','));
    return lines;
  }
  std::string cell(const std::string& out, std::size_t member, const std::string& name) const {
    const std::vector<std::string> lines = lines_of(folder.read(out + "/campaign.csv"));
    const std::vector<std::string> names = cells_of(lines.at(0));
    return cells_of(lines.at(member + 1))
        .at(static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
  }
  json report(const std::string& out) const {
    return json::parse(folder.read(out + "/report.json"));
  }

  TemporaryFolder folder;
};

TEST_F(ScsimCampaign, GivesTheSameTableForAnyJobsAndShards) {
  const ProgramResult one = fly("one", {"--jobs", "1"});
  EXPECT_EQ(one.exit_code, 1) << one.err;
  EXPECT_THAT(one.out, HasSubstr("40 of 40 members flown"));
  ASSERT_THAT(table("one"), SizeIs(41));
  fly("two", {"--jobs", "2"});
  EXPECT_EQ(table("two"), table("one"));
  for (const char* shard : {"2/3", "3/3", "1/3"}) {
    const ProgramResult part = fly("three", {"--shard", shard});
    EXPECT_THAT(part.exit_code, AnyOf(0, 1)) << part.err;
    EXPECT_THAT(part.out, HasSubstr(" members flown\n"));
    EXPECT_FALSE(folder.has("three/campaign.csv"));
  }
  EXPECT_EQ(merge("three").exit_code, 1);
  EXPECT_EQ(table("three"), table("one"));
  EXPECT_EQ(report("three")["complete"], true);
  for (const char* kept : {"0003/bsm.csv", "0003/mujoco.csv"})
    EXPECT_EQ(folder.read(std::string("three/") + kept), folder.read(std::string("one/") + kept));
}

TEST_F(ScsimCampaign, LosesNothingToASignal) {
  ASSERT_EQ(fly("whole", kSlow).exit_code, 1);
  for (const int signal : {SIGKILL, SIGTERM}) {
    const std::string out = "signal_" + std::to_string(signal);
    const ProgramResult stopped = fly(out, kSlow, test::signalled_after("members  ", signal));
    EXPECT_EQ(stopped.exit_code, 128 + signal);
    const std::size_t lines = lines_of(folder.read(out + "/shards/1-of-1.records")).size();
    EXPECT_GT(lines, 2U);   // of the header and the number of members
    EXPECT_LT(lines, 42U);  // or it was no test
    if (signal == SIGTERM) {
      EXPECT_EQ(report(out)["complete"], false);
      EXPECT_EQ(report(out)["verdict"], "interrupted");
      EXPECT_THAT(table(out), SizeIs(lines - 1));
    }
    EXPECT_EQ(fly(out, joined(kSlow, {"--resume"})).exit_code, 1);
    EXPECT_EQ(table(out), table("whole"));
    EXPECT_EQ(report(out)["complete"], true);
  }
}

TEST_F(ScsimCampaign, PrintsACommandThatFliesAMemberAlone) {
  const ProgramResult flown = fly("out");
  for (const bool is_merged : {false, true}) {
    const ProgramResult told = is_merged ? merge("out") : flown;
    const json worst = report("out")["campaign"]["worst"][0];
    ASSERT_EQ(worst["output"], "peak");
    std::string command = worst["command"];
    ASSERT_THAT(command, StartsWith("scsim "));
    EXPECT_THAT(told.out, HasSubstr(command));
    command.replace(0, std::string("scsim").size(), TWINCRAFT_SCSIM);
    const ProgramResult alone =
        test::run_program("/bin/sh", {"-c", command + " -o alone --no-timing --engine bsm"},
                          {.folder = folder.path()});
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    const std::string csv = folder.read("alone/bsm.csv");
    const std::vector<double> angles = column_of(csv, "wing_p.1.position [rad]");
    double peak = 0.0;
    for (const double angle : angles) peak = std::max(peak, std::abs(angle));
    const std::size_t member = worst["member"];
    EXPECT_NEAR(peak, std::stod(cell("out", member, "peak [rad]")), 1e-12);
    EXPECT_NEAR(column_of(csv, "omega_BN_B.z [rad/s]").back(),
                std::stod(cell("out", member, "turn [rad/s]")), 1e-12);
  }
}

TEST_F(ScsimCampaign, MergesWhatThereIs) {
  fly("all", kPlain);
  fly("out", joined(kPlain, {"--shard", "2/3"}));
  const ProgramResult merged = merge("out");
  EXPECT_EQ(merged.exit_code, 1);
  EXPECT_THAT(merged.out, HasSubstr("13 of 40 members flown"));
  EXPECT_EQ(report("out")["complete"], false);
  EXPECT_EQ(report("out")["campaign"]["missing"]["count"], 27);
  const std::vector<std::string> part = table("out"), all = table("all");
  ASSERT_THAT(part, SizeIs(14));
  for (std::size_t i = 1; i < part.size(); ++i) EXPECT_EQ(part[i], all[3 * i - 1]);
  EXPECT_TRUE(folder.has("out/report.html"));
}

TEST_F(ScsimCampaign, MissesShardsThoughEveryMemberHolds) {
  const Flags holds = joined(kPlain, {"--set", "campaign.outputs.peak.require=null"});
  EXPECT_EQ(fly("out", joined(holds, {"--shard", "1/2"})).exit_code, 0);
  EXPECT_EQ(merge("out").exit_code, 1);
  EXPECT_EQ(fly("out", joined(holds, {"--shard", "2/2"})).exit_code, 0);
  EXPECT_EQ(merge("out").exit_code, 0);
}

TEST_F(ScsimCampaign, NamesBrokenRequirementsAndLeavesTheVerdicts) {
  const ProgramResult result = fly("out");
  EXPECT_EQ(result.exit_code, 1);
  std::size_t broken = 0;
  for (std::size_t member = 0; member < 40; ++member) {
    const bool holds = std::stod(cell("out", member, "peak [rad]")) < 12.5 * M_PI / 180.0;
    if (!holds) ++broken;
    EXPECT_THAT(cell("out", member, "reason"),
                holds ? testing::Matcher<std::string>(IsEmpty())
                      : AllOf(StartsWith("peak 0.2"), HasSubstr(" rad is not below ")));
    EXPECT_THAT(cell("out", member, "verdict"), AnyOf("not_judged", "agree"));
  }
  EXPECT_GT(broken, 0U);
  EXPECT_LT(broken, 40U);
  EXPECT_THAT(report("out")["verdict"], AnyOf("agree", "not_judged"));
  EXPECT_EQ(report("out")["campaign"]["outputs"][0]["pass"]["flown"]["passed"], 40 - broken);
}

// rk4 at 0.02 s follows the panel of 3e4 N m/rad, which a bound does not tell, and not that of 5e4.
TEST_F(ScsimCampaign, SaysOfEveryMemberWhetherItsStepResolvesIt) {
  const Flags stiff = joined(
      kPlain, {"--set", "campaign.outputs.peak.require=null", "--set",
               "campaign.dispersions=[{set: panels.wing_p.stiffness, choice: {values: [150, 3e4, "
               "5e4]}}]"});
  const ProgramResult result = fly("one", joined(stiff, {"--jobs", "1"}));
  EXPECT_EQ(result.exit_code, 1) << result.err;
  std::vector<std::size_t> unresolved;
  for (std::size_t member = 0; member < 40; ++member) {
    const bool is_stiff = cell("one", member, "panels.wing_p.stiffness [N m/rad]") == "50000";
    if (is_stiff) unresolved.push_back(member);
    EXPECT_EQ(cell("one", member, "verdict"), is_stiff ? "unresolved" : "not_judged") << member;
    EXPECT_THAT(cell("one", member, "reason"),
                is_stiff ? testing::Matcher<std::string>(
                               AllOf(StartsWith("wing_p.1 swings at 29.3 rad/s"),
                                     testing::EndsWith(" --step '10 ms' resolves it")))
                         : IsEmpty());
  }
  ASSERT_GT(unresolved.size(), 5U);
  ASSERT_LT(unresolved.size(), 35U);
  EXPECT_EQ(report("one")["verdict"], "unresolved");
  const json found = report("one")["campaign"]["unresolved"];
  EXPECT_EQ(found["members"], json(unresolved));
  EXPECT_EQ(found["reason"], cell("one", unresolved.front(), "reason"));
  EXPECT_THAT(result.out, HasSubstr(std::to_string(unresolved.size()) + " unresolved: wing_p.1 "));
  for (const char* shard : {"2/3", "1/3", "3/3"})
    fly("three", joined(stiff, {"--shard", shard, "--jobs", "2"}));
  EXPECT_EQ(merge("three").exit_code, 1);
  EXPECT_EQ(table("three"), table("one"));
  EXPECT_EQ(fly("said", joined(stiff, {"--set", "simulation.resolution=report"})).exit_code, 0);
  EXPECT_EQ(cell("said", unresolved.front(), "verdict"), "not_judged");
  EXPECT_EQ(cell("said", unresolved.front(), "reason"), found["reason"]);
  EXPECT_EQ(fly("short", joined(stiff, {"--set", "simulation.step=10 ms"})).exit_code, 0);
}

TEST_F(ScsimCampaign, KeepsAFailureToTheMemberThatHasIt) {
  const ProgramResult result = fly("out", kFailing);
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_TRUE(folder.has("out/report.html"));
  EXPECT_EQ(report("out")["complete"], true);
  std::size_t failed = 0;
  for (std::size_t member = 0; member < 40; ++member) {
    const bool has_mass = cell("out", member, "hub.mass [kg]") == "600";
    if (!has_mass) ++failed;
    EXPECT_EQ(cell("out", member, "verdict") == "failed", !has_mass) << member;
    EXPECT_EQ(cell("out", member, "peak [rad]").empty(), !has_mass) << member;
    EXPECT_EQ(cell("out", member, "reason"),
              has_mass ? "" : "`mass` of hub is `-1`, but must be positive");
  }
  EXPECT_GT(failed, 5U);
  EXPECT_EQ(report("out")["campaign"]["failures"][0]["count"], failed);
}

TEST_F(ScsimCampaign, BeginsNoMemberAfterAFailureWhereThatIsWanted) {
  fly("all", kFailing);
  EXPECT_EQ(fly("out", joined(kFailing, {"--stop-on-failure", "--jobs", "1"})).exit_code, 4);
  EXPECT_EQ(report("out")["complete"], false);
  const std::vector<std::string> begun = table("out"), all = table("all");
  EXPECT_LT(begun.size(), all.size());
  EXPECT_TRUE(std::equal(begun.begin(), begun.end(), all.begin()));
  fly("out", joined(kFailing, {"--resume"}));
  EXPECT_EQ(table("out"), all);
}

TEST_F(ScsimCampaign, RefusesFlagsThatMakeNoSense) {
  const auto refuses = [this](const Flags& flags, const std::string& why) {
    const ProgramResult result = run(joined({"spec.yaml"}, flags));
    EXPECT_EQ(result.exit_code, 2) << why;
    EXPECT_THAT(result.err, HasSubstr(why));
  };
  for (const char* shard : {"4/3", "0/3", "x", "1/", "/3", "1/2/3", "-1/2", "1/0", ""})
    refuses({"-o", "out", "--shard", shard}, "`--shard`");
  refuses({"--shard", "1/3"}, "--output");
  refuses({"--resume"}, "--output");
  refuses({"-o", "out", "--engine", "mujoco"}, "members of a campaign fly in bsm");
  EXPECT_FALSE(folder.has("out/shards"));
  EXPECT_EQ(run({"quickstart.yaml", "-o", "out", "--resume"}).exit_code, 2);
}

TEST_F(ScsimCampaign, LeavesResultsOfAnotherSpecAlone) {
  fly("out");
  const auto before = contents(folder.path() + "/out");
  for (const char* change : {"hub.mass=601 kg", "campaign.seed=8"}) {
    const ProgramResult result = fly("out", {"--resume", "--set", change});
    EXPECT_EQ(result.exit_code, 3) << change;
    EXPECT_THAT(result.err, HasSubstr("results of another spec"));
    EXPECT_EQ(contents(folder.path() + "/out"), before) << change;
  }
}

TEST_F(ScsimCampaign, GoesOnWithMoreMembers) {
  for (const char* sampling : {"random", "sobol"}) {
    const Flags drawn = joined(kPlain, {"--set", std::string("campaign.sampling=") + sampling});
    fly("out", joined(drawn, {"--set", "campaign.members=16"}));
    const std::vector<std::string> first = table("out");
    ASSERT_THAT(first, SizeIs(17));
    fly("out", joined(drawn, {"--resume"}));
    fly("whole", drawn);
    EXPECT_EQ(table("out"), table("whole"));
    EXPECT_TRUE(std::equal(first.begin(), first.end(), table("out").begin())) << sampling;
    EXPECT_EQ(report("out")["campaign"]["members"], 40);
    merge("out");
    EXPECT_EQ(table("out"), table("whole"));
  }
}

TEST_F(ScsimCampaign, DoesNotMixLatinHypercubes) {
  const Flags drawn = joined(kPlain, {"--set", "campaign.sampling=latin_hypercube"});
  fly("out", joined(drawn, {"--set", "campaign.members=16"}));
  const ProgramResult result = fly("out", joined(drawn, {"--resume"}));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("results of another spec"));
}

TEST_F(ScsimCampaign, GoesOnWhereAFileIsCutOff) {
  fly("out", kPlain);
  const std::vector<std::string> whole = table("out");
  const std::string file = "out/shards/1-of-1.records", records = folder.read(file);
  std::vector<std::size_t> cuts{0, 1, records.find('\n'), records.find('\n') + 1,
                                records.size() - 1};
  std::mt19937 random(7);
  for (int i = 0; i < 6; ++i) cuts.push_back(random() % records.size());
  for (const std::size_t cut : cuts) {
    folder.write(file, records.substr(0, cut));
    const ProgramResult result = fly("out", joined(kPlain, {"--resume"}));
    EXPECT_EQ(result.exit_code, 1) << cut << result.err;
    EXPECT_EQ(table("out"), whole) << cut;
  }
}

TEST_F(ScsimCampaign, FliesAgainFromADamagedRecordOn) {
  fly("out", kPlain);
  const std::vector<std::string> whole = table("out");
  const std::string file = "out/shards/1-of-1.records", records = folder.read(file);
  const std::size_t header = records.find('\n', records.find('\n') + 1) + 1;  // two lines
  std::mt19937 random(7);
  for (int i = 0; i < 4; ++i) {
    std::string damaged = records;
    char& byte = damaged[header + random() % (records.size() - header)];
    byte = static_cast<char>(byte ^ 1);
    folder.write(file, damaged);
    const ProgramResult merged = merge("out");
    EXPECT_EQ(merged.exit_code, 1);
    EXPECT_THAT(merged.err, HasSubstr("1-of-1.records"));
    const ProgramResult again = fly("out", joined(kPlain, {"--resume", "--shard", "1/1"}));
    EXPECT_THAT(again.out, Not(StartsWith("0 members"))) << again.err;
    EXPECT_THAT(merge("out").err, Not(HasSubstr(".records")));  // cut off where it was damaged
    EXPECT_EQ(table("out"), whole);
  }
}

TEST_F(ScsimCampaign, KeepsWhatIsDoneOfAShard) {
  EXPECT_THAT(fly("out", joined(kPlain, {"--shard", "1/4"})).out, "10 members flown\n");
  fly("out", joined(kPlain, {"--shard", "2/4"}));  // whose members are not of the first
  EXPECT_THAT(fly("out", joined(kPlain, {"--shard", "1/4", "--resume"})).out,
              "0 members flown, 10 were there\n");
}

// A task that was requeued says of its shard what it would have said at once.
TEST_F(ScsimCampaign, EndsAResumedShardByAllThatItHas) {
  for (const auto& [flags, code] : {std::pair(kPlain, 1), std::pair(kFailing, 4)}) {
    const Flags shard = joined(flags, {"--shard", "1/2", "--resume"});
    const std::string out = "out" + std::to_string(code);
    EXPECT_EQ(fly(out, shard).exit_code, code);
    const ProgramResult again = fly(out, shard);
    EXPECT_EQ(again.out, "0 members flown, 20 were there\n");
    EXPECT_EQ(again.exit_code, code);
  }
}

TEST_F(ScsimCampaign, RefusesFilesOfAnotherProgram) {
  fs::create_directories(folder.path() + "/out/shards");
  folder.write("out/shards/2-of-3.records", "a diary\n");
  const std::string notes = folder.write("out/shards/notes.records", "mine\n");
  const auto before = contents(folder.path() + "/out");
  const ProgramResult result = fly("out", joined(kPlain, {"--resume"}));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("2-of-3.records"));
  EXPECT_EQ(merge("out").exit_code, 3);
  EXPECT_EQ(contents(folder.path() + "/out"), before);
  // What has another name than ours is nobody's business.
  EXPECT_EQ(fly("out", kPlain).exit_code, 1);
  EXPECT_EQ(test::read_file(notes), "mine\n");
  EXPECT_FALSE(folder.has("out/shards/2-of-3.records"));
}

TEST_F(ScsimCampaign, MergesNothingWhereThereIsNoCampaign) {
  for (const char* out : {".", "missing", "spec.yaml"}) {
    const ProgramResult result = merge(out);
    EXPECT_EQ(result.exit_code, 3) << out;
    EXPECT_THAT(result.err, HasSubstr("holds no results of a campaign"));
  }
  EXPECT_EQ(run({"merge"}).exit_code, 2);
  EXPECT_FALSE(folder.has("missing"));
}

TEST_F(ScsimCampaign, FliesInBothEnginesWhoIsToBeCompared) {
  const auto flown = [this](const Flags& flags) {
    fly("out", joined({"--set", "campaign.keep=null"}, flags));
    return report("out")["campaign"]["twins"];
  };
  EXPECT_EQ(flown({})["flown"], 4);
  EXPECT_EQ(flown({"--engine", "bsm"})["flown"], 0);
  const json all = flown({"--engine", "both"});
  EXPECT_EQ(all["flown"], 40);
  EXPECT_EQ(all["agree"], 40);
  for (std::size_t member = 0; member < 40; ++member)
    EXPECT_EQ(cell("out", member, "verdict"), "agree");
}

TEST_F(ScsimCampaign, GivesItsFolderToALaterRunButForTheShards) {
  fly("out");
  ASSERT_TRUE(folder.has("out/0003/bsm.csv"));
  const auto shards = contents(folder.path() + "/out/shards");
  ASSERT_THAT(shards, SizeIs(2));
  EXPECT_EQ(run({"quickstart.yaml", "-o", "out", "--no-timing"}).exit_code, 0);
  for (const char* gone : {"campaign.csv", "campaign.nc", "0003"})
    EXPECT_FALSE(folder.has(std::string("out/") + gone)) << gone;
  EXPECT_TRUE(folder.has("out/mujoco.csv"));
  EXPECT_EQ(contents(folder.path() + "/out/shards"), shards);
  merge("out");
  EXPECT_FALSE(folder.has("out/mujoco.csv"));
  EXPECT_TRUE(folder.has("out/0003/mujoco.csv"));
}

TEST_F(ScsimCampaign, ReplacesTheShardsOfAnEarlierOne) {
  fly("out", joined(kPlain, {"--shard", "1/2", "--set", "hub.mass=601 kg"}));
  fly("out", kPlain);
  EXPECT_FALSE(folder.has("out/shards/1-of-2.records"));
  EXPECT_THAT(table("out"), SizeIs(41));
}

TEST_F(ScsimCampaign, KeepsTrajectoriesAsNetcdfToo) {
  if (!has_netcdf()) GTEST_SKIP() << "this build has no netCDF";
  fly("out", {"--netcdf"});
  for (const char* file : {"campaign.nc", "0003/bsm.nc", "0003/mujoco.nc", "0003/bsm.csv"})
    EXPECT_TRUE(folder.has(std::string("out/") + file)) << file;
  EXPECT_EQ(report("out")["campaign"]["kept"].size(), 2U);
  fly("out");
  EXPECT_FALSE(folder.has("out/0003/bsm.nc"));
  EXPECT_TRUE(folder.has("out/0003/bsm.csv"));
}

}  // namespace
}  // namespace twincraft
