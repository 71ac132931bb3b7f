// The command line as pinned: flags, streams, exit codes, files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/compiler/run_sccompile.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::run_sccompile;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kQuickstart = "models/quickstart.yaml";

std::string read(const fs::path& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

class Sccompile : public testing::Test {
 protected:
  Sccompile()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("sccompile_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Sccompile() override { fs::remove_all(folder_); }

  std::string out() const { return " -o '" + folder_.string() + "' "; }
  std::string spec(const std::string& text) const {
    std::ofstream(folder_ / "spec.yaml") << text;
    return "'" + (folder_ / "spec.yaml").string() + "'";
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(Sccompile, WritesBothTargetsSilently) {
  const Outcome run = run_sccompile(kQuickstart + out() + "2>&1");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.output, "");
  EXPECT_THAT(read(folder_ / "wheels_and_panels.xml"),
              HasSubstr("<mujoco model=\"wheels_and_panels\""));
  EXPECT_TRUE(nlohmann::json::accept(read(folder_ / "wheels_and_panels.bsm.json")));
  EXPECT_EQ(files(), 2u);
}

TEST_F(Sccompile, WritesOnlyWhatWasAskedFor) {
  EXPECT_EQ(run_sccompile(kQuickstart + out() + "--emit dot,resolved").exit_code, 0);
  EXPECT_THAT(read(folder_ / "wheels_and_panels.dot"), StartsWith("digraph"));
  EXPECT_THAT(read(folder_ / "wheels_and_panels.resolved.yaml"),
              StartsWith("format: spacecraft/1\n"));
  EXPECT_EQ(files(), 2u);
}

TEST_F(Sccompile, ExtendsAFileButNotFromStandardInput) {
  std::ofstream(folder_ / "base.yaml") << read(TWINCRAFT_ROOT "/models/quickstart.yaml");
  const std::string text = "extends: base.yaml\nname: small\ndrop: [wing_m, wing_p]\n";
  const Outcome run = run_sccompile(spec(text) + out() + "--emit resolved 2>&1");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(read(folder_ / "small.resolved.yaml"), HasSubstr("rw_z"));
  EXPECT_THAT(read(folder_ / "small.resolved.yaml"), Not(HasSubstr("wing")));
  EXPECT_THAT(read(folder_ / "small.resolved.yaml"), Not(HasSubstr("extends")));
  const Outcome piped = run_sccompile("- 2>&1 < " + spec(text));
  EXPECT_EQ(piped.exit_code, 1);
  EXPECT_THAT(piped.output, HasSubstr("<stdin>:1:10: error[SC1604]"));
}

TEST_F(Sccompile, TellsAMissingSpecFromAMissingExtendedOne) {
  EXPECT_EQ(run_sccompile("missing.yaml 2>/dev/null").exit_code, 3);
  EXPECT_EQ(run_sccompile(spec("extends: missing.yaml\n") + " 2>/dev/null").exit_code, 1);
}

TEST_F(Sccompile, WritesOneResultToStandardOutput) {
  const Outcome run = run_sccompile(std::string(kQuickstart) + " -o - --emit bsm");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(run.output)["name"], "wheels_and_panels");
  const Outcome two = run_sccompile(std::string(kQuickstart) + " -o - 2>&1");
  EXPECT_EQ(two.exit_code, 2);
  EXPECT_THAT(two.output, HasSubstr("`-o -` writes a single result"));
}

TEST_F(Sccompile, CompilesItsOwnResolvedSpecToTheSameBytes) {
  ASSERT_EQ(run_sccompile(kQuickstart + out() + "--emit mjcf,bsm,resolved").exit_code, 0);
  const std::string resolved = (folder_ / "wheels_and_panels.resolved.yaml").string();
  for (const std::string target : {"mjcf", "bsm", "resolved"}) {
    const Outcome first = run_sccompile(kQuickstart + (" -o - --emit " + target));
    const Outcome again = run_sccompile("'" + resolved + "' -o - --emit " + target + " 2>&1");
    EXPECT_EQ(first.output, again.output) << target;
  }
}

TEST_F(Sccompile, GivesTheSameBytesInEveryLocaleAndTimeZone) {
  const std::string arguments = std::string(kQuickstart) + " -o - --emit mjcf";
  const Outcome plain = run_sccompile(arguments);
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  setenv("TZ", "Asia/Tokyo", 1);
  EXPECT_EQ(run_sccompile(arguments).output, plain.output);
  unsetenv("LC_ALL");
  unsetenv("TZ");
}

TEST_F(Sccompile, ReadsStandardInputAndCallsItStdin) {
  const std::string from_file = std::string(" --emit bsm -o - < ") + kQuickstart;
  EXPECT_EQ(run_sccompile("-" + from_file).exit_code, 0);
  const Outcome empty = run_sccompile("- 2>&1 < /dev/null");
  EXPECT_EQ(empty.exit_code, 1);
  EXPECT_THAT(empty.output, StartsWith("<stdin>:1:1: error[SC1004]"));
}

TEST_F(Sccompile, ChangesTheSpecFirst) {
  const Outcome run = run_sccompile(std::string(kQuickstart) +
                                    " --emit bsm -o - --set name=other --set 'hub.mass=0.7 t'");
  EXPECT_EQ(run.exit_code, 0);
  const auto json = nlohmann::json::parse(run.output);
  EXPECT_EQ(json["name"], "other");
  EXPECT_EQ(json["links"][0]["elements"][0]["mass_kg"], 700.0);
}

TEST_F(Sccompile, KeepsEarlierFilesWhenASpecHasFaults) {
  ASSERT_EQ(run_sccompile(kQuickstart + out()).exit_code, 0);
  const std::string before = read(folder_ / "wheels_and_panels.xml");
  EXPECT_EQ(run_sccompile(kQuickstart + out() + "--set hub.mass=-5 2>&1").exit_code, 1);
  EXPECT_EQ(read(folder_ / "wheels_and_panels.xml"), before);
  EXPECT_EQ(files(), 2u);
}

TEST_F(Sccompile, ExitsWithThreeOnInputAndOutputFaults) {
  const Outcome missing = run_sccompile("no/such.yaml 2>&1");
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.output, HasSubstr("no/such.yaml`: no such file or directory"));
  const Outcome folder = run_sccompile("models 2>&1");
  EXPECT_EQ(folder.exit_code, 3);
  EXPECT_THAT(folder.output, HasSubstr("it is a directory"));
  const Outcome below_file = run_sccompile(std::string(kQuickstart) + " -o CMakeLists.txt 2>&1");
  EXPECT_EQ(below_file.exit_code, 3);
  EXPECT_THAT(below_file.output, HasSubstr("CMakeLists.txt"));
}

TEST_F(Sccompile, ExitsWithThreeWhenStandardOutputCannotTakeTheResult) {
  const std::string arguments = std::string(kQuickstart) + " -o - --emit mjcf";
  const Outcome closed = run_sccompile(arguments + " 2>&1 >&-");
  EXPECT_EQ(closed.exit_code, 3);
  EXPECT_THAT(closed.output, HasSubstr("cannot write standard output: bad file descriptor"));
  const Outcome full = run_sccompile(arguments + " 2>&1 >/dev/full");
  EXPECT_EQ(full.exit_code, 3);
  EXPECT_THAT(full.output, HasSubstr("no space left on device"));
}

TEST_F(Sccompile, PrintsDiagnosticsAsJsonOnStandardOutput) {
  const Outcome run =
      run_sccompile(std::string(kQuickstart) + " --diagnostics json --set hub.mass=-5 2>/dev/null");
  EXPECT_EQ(run.exit_code, 1);
  const auto json = nlohmann::json::parse(run.output);
  ASSERT_EQ(json["diagnostics"].size(), 1u);
  EXPECT_EQ(json["diagnostics"][0]["severity"], "error");
  EXPECT_TRUE(nlohmann::json::accept(
      run_sccompile(std::string(kQuickstart) + " --diagnostics sarif" + out()).output));
}

TEST_F(Sccompile, PrintsASchemaThatIsDraft7) {
  const Outcome run = run_sccompile("--schema");
  EXPECT_EQ(run.exit_code, 0);
  const auto schema = nlohmann::json::parse(run.output);
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
  EXPECT_TRUE(schema["properties"].contains("hub"));
}

TEST_F(Sccompile, PrintsTheReference) {
  const Outcome run = run_sccompile("--reference");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, HasSubstr("spin_inertia"));
}

TEST_F(Sccompile, ExplainsACode) {
  const Outcome run = run_sccompile("--explain sc1012");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, StartsWith("SC1012: a key is written twice\n\n"));
  const Outcome unknown = run_sccompile("--explain SC1o12 2>&1");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.output, HasSubstr("did you mean `SC1012`?"));
}

TEST_F(Sccompile, HelpFitsOneScreenAndShowsAnExample) {
  const Outcome run = run_sccompile("--help");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(std::count(run.output.begin(), run.output.end(), '\n'), 30);
  EXPECT_THAT(run.output, HasSubstr("Example: sccompile"));
  EXPECT_EQ(run_sccompile("--version").output, "sccompile " TWINCRAFT_VERSION "\n");
}

TEST_F(Sccompile, ForeseesAStepThatDestroysTheMotion) {
  const Outcome run =
      run_sccompile(std::string(kQuickstart) +
                    " --check --set 'panels.*.stiffness=3e5' --set 'panels.*.damping=0' 2>&1");
  EXPECT_EQ(run.exit_code, 0) << run.output;  // the two targets are one machine all the same
  EXPECT_THAT(run.output, HasSubstr("warning[SC4003]: "));
  EXPECT_THAT(run.output, HasSubstr("resolves it"));
  EXPECT_THAT(run_sccompile(std::string(kQuickstart) + " --check 2>&1").output,
              testing::Not(HasSubstr("SC4003")));
}

TEST_F(Sccompile, ProvesTheTwoTargetsEqual) {
  const Outcome run = run_sccompile(kQuickstart + out() + "--check 2>&1");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("mass"));
  EXPECT_EQ(files(), 0u);
}

TEST_F(Sccompile, SaysWhichFlagsHaveNoEffect) {
  const Outcome run = run_sccompile(kQuickstart + out() + "--emit bsm --check 2>&1 >/dev/null");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("warning: `-o` has no effect with `--check`"));
  EXPECT_THAT(run.output, HasSubstr("warning: `--emit` has no effect with `--check`"));
  EXPECT_THAT(run_sccompile("--schema -o x 2>&1 >/dev/null").output,
              HasSubstr("warning: `-o` has no effect with `--schema`"));
  EXPECT_EQ(run_sccompile("--schema 2>&1 >/dev/null").output, "");
  EXPECT_EQ(run_sccompile(kQuickstart + out() + "2>&1").output, "");
}

TEST_F(Sccompile, BlamesTheSpecForAPathOfItsStudy) {
  const std::string malformed = "tests/malformed/study_path_malformed.yaml";
  EXPECT_EQ(run_sccompile(malformed + out() + "2>/dev/null").exit_code, 1);
  EXPECT_EQ(run_sccompile(kQuickstart + out() + "--set hub..mass=1 2>/dev/null").exit_code, 2);
}

TEST_F(Sccompile, ReportsATargetThatIsRefusedAndWritesTheOther) {
  const Outcome run = run_sccompile(
      spec("format: spacecraft/1\nname: ladder\nhub: {mass: 600, inertia: [400, 380, 360]}\n"
           "panels:\n  - name: wing\n    hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: "
           "[1, 0, 0]}\n    segments: 96\n    mass: 50\n    length: 9.6\n    inertia: {shape: bar, "
           "axial_ratio: 0.05, axial_minimum: 1.0e-4}\n    stiffness: 10\n"
           "simulation: {integrator: rk4, step: 0.1, duration: 1, record: 0.5}\n") +
      out() + "2>&1");
  EXPECT_EQ(run.exit_code, 1) << run.output;
  EXPECT_THAT(run.output, HasSubstr("`ladder.xml` is not written: a chain of 96 bodies"));
  EXPECT_TRUE(fs::exists(folder_ / "ladder.bsm.json"));
  EXPECT_FALSE(fs::exists(folder_ / "ladder.xml"));
}

/// A bad command line, what is said about it and what is hinted at.
struct Usage {
  const char* name;
  const char* arguments;
  const char* said;
  const char* hint;
};

class SccompileRefuses : public testing::TestWithParam<Usage> {};

TEST_P(SccompileRefuses, TheCommandLine) {
  const Outcome run = run_sccompile(std::string(GetParam().arguments) + " 2>&1");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, StartsWith(std::string("sccompile: ") + GetParam().said));
  EXPECT_THAT(run.output, HasSubstr(std::string("hint: ") + GetParam().hint));
}

INSTANTIATE_TEST_SUITE_P(
    BadUsage, SccompileRefuses,
    testing::Values(
        Usage{"no_spec", "", "SPEC is missing", "for example"},
        Usage{"unknown_flag", "x.yaml --emmit bsm", "unknown flag `--emmit`",
              "did you mean `--emit`?"},
        Usage{"unknown_flag_with_value", "x.yaml --checks=1", "unknown flag `--checks`",
              "did you mean `--check`?"},
        Usage{"strange_flag", "x.yaml --quux", "unknown flag `--quux`", "`sccompile --help`"},
        Usage{"two_specs", "x.yaml y.yaml", "unexpected argument `y.yaml`", "`sccompile --help`"},
        Usage{"unknown_target", "x.yaml --emit bsm,mjfc", "`--emit` cannot be `mjfc`",
              "did you mean `mjcf`?"},
        Usage{"no_target", "x.yaml --emit ''", "`--emit` is empty", "give it a value"},
        Usage{"no_folder", "x.yaml -o ''", "`-o` names no folder", "write for example `-o out`"},
        Usage{"no_spec_name", "''", "`SPEC` is empty", "give it a value"},
        Usage{"unknown_format", "x.yaml --diagnostics jsno", "`--diagnostics` cannot be `jsno`",
              "did you mean `json`?"},
        Usage{"no_value", "x.yaml --set", "--set", "`sccompile --help`"},
        Usage{"bad_count", "x.yaml --max-errors many", "", "`sccompile --help`"},
        Usage{"mixed_streams", "x.yaml -o - --emit bsm --diagnostics json",
              "`-o -` and `--diagnostics` both", "write to a folder"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace twincraft
