// Claims about what a run leaves and takes: its files as they come, one run to a folder, memory
// that does not grow, resources known before the start, the instruction set that was asked for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "runtime/report/netcdf.h"
#include "tests/support/run_program.h"

namespace twincraft {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::TemporaryFolder;
using testing::HasSubstr;

const std::string kTumbler = R"(format: spacecraft/1
name: tumbler
hub: {mass: 750, inertia: [900, 800, 600]}
initial: {rate: [0.02, -0.01, 0.03]}
simulation: {step: 0.5, duration: 10, record: 1}
)";

const std::string kStudy = kTumbler + R"(study:
  sweep:
    - {set: hub.mass, values: [700, 750, 800]}
)";

class ScsimFolder : public testing::Test {
 protected:
  ProgramResult run(const std::string& spec, std::vector<std::string> arguments,
                    const test::ProgramInput& input = {}) {
    arguments.insert(arguments.begin(), {spec, "--no-timing", "-o", folder.path() + "/out"});
    return test::run_program(TWINCRAFT_SCSIM, arguments, input);
  }
  /// Everything in the folder, by name.
  std::vector<std::string> listing() const {
    std::vector<std::string> names;
    const std::filesystem::path out = folder.path() + "/out";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out))
      names.push_back(entry.path().lexically_relative(out).string());
    std::ranges::sort(names);
    return names;
  }

  TemporaryFolder folder;
  std::string tumbler = folder.write("tumbler.yaml", kTumbler);
  std::string study = folder.write("study.yaml", kStudy);
};

using Names = std::vector<std::string>;

// A sanitizer reserves more of the address space than a limit leaves.
#ifdef TWINCRAFT_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

TEST_F(ScsimFolder, HoldsTheFilesOfItsLastRunAlone) {
  if (!has_netcdf()) GTEST_SKIP() << "this build has no netCDF";
  ASSERT_EQ(run(study, {"--netcdf"}).exit_code, 0);
  EXPECT_EQ(listing(),
            (Names{"0001", "0001/bsm.csv", "0001/bsm.nc", "0001/mujoco.csv", "0001/mujoco.nc",
                   "0002", "0002/bsm.csv", "0002/bsm.nc", "0002/mujoco.csv", "0002/mujoco.nc",
                   "bsm.csv", "bsm.nc", "mujoco.csv", "mujoco.nc", "report.html", "report.json"}));
  ASSERT_EQ(run(study, {"--set", "study.sweep=[{set: hub.mass, values: [700, 750]}]"}).exit_code,
            0);
  EXPECT_EQ(listing(), (Names{"0001", "0001/bsm.csv", "0001/mujoco.csv", "bsm.csv", "mujoco.csv",
                              "report.html", "report.json"}));
  ASSERT_EQ(run(tumbler, {"--engine", "bsm"}).exit_code, 0);
  EXPECT_EQ(listing(), (Names{"bsm.csv", "report.html", "report.json"}));
}

TEST_F(ScsimFolder, KeepsWhatIsTheUsers) {
  ASSERT_EQ(run(study, {}).exit_code, 0);
  folder.write("out/0001/notes.txt", "mine");
  folder.write("out/0003", "a file");
  folder.write("out/summary.csv", "mine");
  std::filesystem::create_directories(folder.path() + "/out/0007");
  folder.write("out/0007/report.json", "a run of its own");
  folder.write("out/0007/bsm.csv", "and its trajectory");
  std::filesystem::create_directories(folder.path() + "/out/12");
  folder.write("out/12/bsm.csv", "no member is called so");
  ASSERT_EQ(run(tumbler, {}).exit_code, 0);
  EXPECT_EQ(listing(), (Names{"0001", "0001/notes.txt", "0003", "0007", "0007/bsm.csv",
                              "0007/report.json", "12", "12/bsm.csv", "bsm.csv", "mujoco.csv",
                              "report.html", "report.json", "summary.csv"}));
}

TEST_F(ScsimFolder, IsLeftAsItWasByARunThatWasRefused) {
  ASSERT_EQ(run(study, {}).exit_code, 0);
  const Names before = listing();
  EXPECT_EQ(run(tumbler, {"--set", "hub.mass=-1"}).exit_code, 1);
  EXPECT_EQ(run(tumbler, {"--engine", "bms"}).exit_code, 2);
  EXPECT_EQ(listing(), before);
}

TEST_F(ScsimFolder, TakesAMillionSamplesInLittleMemory) {
  if (kSanitized) GTEST_SKIP();
  // As objects and text they would be half a gigabyte.
  const ProgramResult result =
      run(tumbler,
          {"--engine", "bsm", "--quiet", "--set", "simulation.record=0.001", "--step", "0.001",
           "--duration", "1000"},
          {.data = 200'000'000});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(folder.read("out/report.json"));
  EXPECT_EQ(report["members"][0]["engines"]["bsm"]["steps"], 1'000'000);
  const std::string csv = folder.read("out/bsm.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1'000'002);
}

TEST_F(ScsimFolder, TakesNoMoreMemoryForMoreMembers) {
  if (kSanitized) GTEST_SKIP();
  std::string values = "[1";
  for (int i = 2; i <= 1500; ++i) values += ", " + std::to_string(i);
  const std::string many = folder.write(
      "many.yaml", kTumbler + "study: {sweep: [{set: hub.mass, values: " + values + "]}]}\n");
  const ProgramResult result = run(many, {"--quiet", "--jobs", "1"}, {.data = 150'000'000});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(folder.read("out/report.json"));
  EXPECT_EQ(report["members"].size(), 1500U);
  EXPECT_EQ(report["complete"], true);
  EXPECT_EQ(report["members"][1499]["settings"]["hub.mass"], 1500);
  EXPECT_TRUE(report["members"][1499]["resolved"].contains("hub"));
}

TEST_F(ScsimFolder, RefusesAComparisonThatDoesNotFitIntoMemoryAtItsPlace) {
  const std::string spec =
      folder.write("compared.yaml", kTumbler +
                                        "study:\n  compare: hub.mass\n  sweep:\n"
                                        "    - {set: hub.mass, values: [700, 750]}\n");
  const ProgramResult result =
      run(spec, {"--jobs", "2", "--set", "simulation.step=0.001", "--set",
                 "simulation.record=0.001", "--set", "simulation.duration=1000"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr("simulation.record=0.001"));
  EXPECT_THAT(result.err, HasSubstr("more than 2 GiB"));
  EXPECT_THAT(result.err, HasSubstr("hint: raise `simulation.record` to 0.00"));
  EXPECT_FALSE(folder.has("out"));
}

TEST_F(ScsimFolder, SaysWhichInstructionsRanAndComesOutAlikeWithAll) {
  ASSERT_EQ(run(tumbler, {"--isa", "portable"}).exit_code, 0);
  const json portable = json::parse(folder.read("out/report.json"));
  EXPECT_EQ(portable["provenance"]["instructions"], "x86-64");
  EXPECT_EQ(portable["provenance"]["instructions_reason"], "--isa portable");
  ASSERT_EQ(run(tumbler, {}).exit_code, 0);
  const json best = json::parse(folder.read("out/report.json"));
  EXPECT_NE(best["provenance"]["instructions_reason"], "--isa auto");
  for (const char* engine : {"bsm", "mujoco"}) {
    const json a = portable["members"][0]["engines"][engine]["final"]["omega_BN_B_rad_s"];
    const json b = best["members"][0]["engines"][engine]["final"]["omega_BN_B_rad_s"];
    // A fused product differs by half a unit in the last place, in each of 80 evaluations.
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(a[i].get<double>(), b[i].get<double>(), 80 * 2.2e-16 * 0.04) << engine;
  }
}

TEST_F(ScsimFolder, RefusesInstructionsThatTheProcessorLacksOrNobodyKnows) {
  EXPECT_THAT(run(tumbler, {"--isa", "avx"}).err, HasSubstr("auto|portable|avx2|avx512"));
  EXPECT_EQ(run(tumbler, {"--isa", "avx"}).exit_code, 2);
  for (const char* isa : {"portable", "avx2", "avx512"}) {
    const ProgramResult result = run(tumbler, {"--isa", isa, "--quiet"});
    if (result.exit_code == 0) continue;
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err,
                HasSubstr("this processor has no `" + std::string(isa) + "`; it has portable"));
  }
}

}  // namespace
}  // namespace twincraft
