// The command line as pinned: flags, streams, exit codes, files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using test::ProgramInput;
using test::ProgramResult;
using test::read_file;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kQuickstart = "models/quickstart.yaml";

using Arguments = std::vector<std::string>;

/// From the root of the repository, unless `input` says otherwise.
ProgramResult sccompile(const Arguments& arguments, ProgramInput input = {}) {
  if (input.folder.empty()) input.folder = TWINCRAFT_ROOT;
  return test::run_program(TWINCRAFT_SCCOMPILE, arguments, input);
}

class Sccompile : public testing::Test {
 protected:
  /// With its files in the folder.
  ProgramResult compile(const std::string& spec, Arguments arguments = {}) const {
    arguments.insert(arguments.begin(), {spec, "-o", folder.path() + "/out"});
    return sccompile(arguments);
  }
  std::string written(const std::string& name) const { return folder.read("out/" + name); }
  std::ptrdiff_t files() const {
    if (!folder.has("out")) return 0;
    return std::distance(fs::directory_iterator(folder.path() + "/out"), fs::directory_iterator());
  }

  test::TemporaryFolder folder;
};

TEST_F(Sccompile, WritesBothTargetsSilently) {
  const ProgramResult run = compile(kQuickstart);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out + run.err, "");
  EXPECT_THAT(written("wheels_and_panels.xml"), HasSubstr("<mujoco model=\"wheels_and_panels\""));
  EXPECT_TRUE(nlohmann::json::accept(written("wheels_and_panels.bsm.json")));
  EXPECT_EQ(files(), 2);
}

TEST_F(Sccompile, WritesOnlyWhatWasAskedFor) {
  EXPECT_EQ(compile(kQuickstart, {"--emit", "dot,resolved"}).exit_code, 0);
  EXPECT_THAT(written("wheels_and_panels.dot"), StartsWith("digraph"));
  EXPECT_THAT(written("wheels_and_panels.resolved.yaml"), StartsWith("format: spacecraft/1\n"));
  EXPECT_EQ(files(), 2);
}

TEST_F(Sccompile, ExtendsAFileButNotFromStandardInput) {
  folder.write("base.yaml", read_file(TWINCRAFT_ROOT "/models/quickstart.yaml"));
  const std::string text = "extends: base.yaml\nname: small\ndrop: [wing_m, wing_p]\n";
  const ProgramResult run = compile(folder.write("spec.yaml", text), {"--emit", "resolved"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(written("small.resolved.yaml"), HasSubstr("rw_z"));
  EXPECT_THAT(written("small.resolved.yaml"), Not(HasSubstr("wing")));
  EXPECT_THAT(written("small.resolved.yaml"), Not(HasSubstr("extends")));
  const ProgramResult piped = sccompile({"-"}, {.standard_input = text});
  EXPECT_EQ(piped.exit_code, 1);
  EXPECT_THAT(piped.err, HasSubstr("<stdin>:1:10: error[SC1604]"));
}

TEST_F(Sccompile, TellsAMissingSpecFromAMissingExtendedOne) {
  EXPECT_EQ(sccompile({"missing.yaml"}).exit_code, 3);
  const std::string spec = folder.write("spec.yaml", "extends: missing.yaml\n");
  EXPECT_EQ(sccompile({spec}).exit_code, 1);
}

TEST_F(Sccompile, WritesOneResultToStandardOutput) {
  const ProgramResult run = sccompile({kQuickstart, "-o", "-", "--emit", "bsm"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(run.out)["name"], "wheels_and_panels");
  const ProgramResult two = sccompile({kQuickstart, "-o", "-"});
  EXPECT_EQ(two.exit_code, 2);
  EXPECT_THAT(two.err, HasSubstr("`-o -` writes a single result"));
}

TEST_F(Sccompile, CompilesItsOwnResolvedSpecToTheSameBytes) {
  ASSERT_EQ(compile(kQuickstart, {"--emit", "mjcf,bsm,resolved"}).exit_code, 0);
  const std::string resolved = folder.path() + "/out/wheels_and_panels.resolved.yaml";
  for (const std::string target : {"mjcf", "bsm", "resolved"}) {
    const ProgramResult first = sccompile({kQuickstart, "-o", "-", "--emit", target});
    const ProgramResult again = sccompile({resolved, "-o", "-", "--emit", target});
    EXPECT_EQ(first.out, again.out) << target << ": " << again.err;
    EXPECT_EQ(again.err, "") << target;
  }
}

TEST_F(Sccompile, GivesTheSameBytesInEveryLocaleAndTimeZone) {
  const Arguments arguments{kQuickstart, "-o", "-", "--emit", "mjcf"};
  const ProgramResult plain = sccompile(arguments);
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  setenv("TZ", "Asia/Tokyo", 1);
  EXPECT_EQ(sccompile(arguments).out, plain.out);
  unsetenv("LC_ALL");
  unsetenv("TZ");
}

TEST_F(Sccompile, ReadsStandardInputAndCallsItStdin) {
  const std::string text = read_file(TWINCRAFT_ROOT "/" + kQuickstart);
  EXPECT_EQ(sccompile({"-", "--emit", "bsm", "-o", "-"}, {.standard_input = text}).exit_code, 0);
  const ProgramResult empty = sccompile({"-"});
  EXPECT_EQ(empty.exit_code, 1);
  EXPECT_THAT(empty.err, StartsWith("<stdin>:1:1: error[SC1004]"));
}

TEST_F(Sccompile, ChangesTheSpecFirst) {
  const ProgramResult run = sccompile({kQuickstart, "--emit", "bsm", "-o", "-",  //
                                       "--set", "name=other", "--set", "hub.mass=0.7 t"});
  EXPECT_EQ(run.exit_code, 0);
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["name"], "other");
  EXPECT_EQ(json["links"][0]["elements"][0]["mass_kg"], 700.0);
}

TEST_F(Sccompile, KeepsEarlierFilesWhenASpecHasFaults) {
  ASSERT_EQ(compile(kQuickstart).exit_code, 0);
  const std::string before = written("wheels_and_panels.xml");
  EXPECT_EQ(compile(kQuickstart, {"--set", "hub.mass=-5"}).exit_code, 1);
  EXPECT_EQ(written("wheels_and_panels.xml"), before);
  EXPECT_EQ(files(), 2);
}

TEST_F(Sccompile, ExitsWithThreeOnInputAndOutputFaults) {
  const ProgramResult missing = sccompile({"no/such.yaml"});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.err, HasSubstr("no/such.yaml`: no such file or directory"));
  const ProgramResult a_folder = sccompile({"models"});
  EXPECT_EQ(a_folder.exit_code, 3);
  EXPECT_THAT(a_folder.err, HasSubstr("it is a directory"));
  const ProgramResult below_file = sccompile({kQuickstart, "-o", "CMakeLists.txt"});
  EXPECT_EQ(below_file.exit_code, 3);
  EXPECT_THAT(below_file.err, HasSubstr("CMakeLists.txt"));
}

TEST_F(Sccompile, ExitsWithThreeWhenStandardOutputCannotTakeTheResult) {
  const Arguments arguments{kQuickstart, "-o", "-", "--emit", "mjcf"};
  const ProgramResult closed = sccompile(arguments, {.output = ProgramInput::Output::kClosed});
  EXPECT_EQ(closed.exit_code, 3);
  EXPECT_THAT(closed.err, HasSubstr("cannot write standard output: bad file descriptor"));
  const ProgramResult full = sccompile(arguments, {.output = ProgramInput::Output::kFullDevice});
  EXPECT_EQ(full.exit_code, 3);
  EXPECT_THAT(full.err, HasSubstr("no space left on device"));
}

TEST_F(Sccompile, PrintsDiagnosticsAsJsonOnStandardOutput) {
  const ProgramResult run =
      sccompile({kQuickstart, "--diagnostics", "json", "--set", "hub.mass=-5"});
  EXPECT_EQ(run.exit_code, 1);
  const auto json = nlohmann::json::parse(run.out);
  ASSERT_EQ(json["diagnostics"].size(), 1u);
  EXPECT_EQ(json["diagnostics"][0]["severity"], "error");
  EXPECT_TRUE(nlohmann::json::accept(compile(kQuickstart, {"--diagnostics", "sarif"}).out));
}

TEST_F(Sccompile, PrintsASchemaThatIsDraft7) {
  const ProgramResult run = sccompile({"--schema"});
  EXPECT_EQ(run.exit_code, 0);
  const auto schema = nlohmann::json::parse(run.out);
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
  EXPECT_TRUE(schema["properties"].contains("hub"));
}

TEST_F(Sccompile, PrintsTheReference) {
  const ProgramResult run = sccompile({"--reference"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("spin_inertia"));
}

TEST_F(Sccompile, ExplainsACode) {
  const ProgramResult run = sccompile({"--explain", "sc1012"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, StartsWith("SC1012: a key is written twice\n\n"));
  const ProgramResult unknown = sccompile({"--explain", "SC1o12"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean `SC1012`?"));
}

TEST_F(Sccompile, HelpFitsOneScreenAndShowsAnExample) {
  const ProgramResult run = sccompile({"--help"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(std::ranges::count(run.out, '\n'), 32);
  EXPECT_THAT(run.out, HasSubstr("Example: sccompile"));
}

TEST_F(Sccompile, HasTheVersionItIsCitedBy) {
  EXPECT_EQ(sccompile({"--version"}).out, "sccompile " TWINCRAFT_VERSION "\n");
  EXPECT_THAT(read_file(TWINCRAFT_ROOT "/CITATION.cff"),
              HasSubstr("\nversion: " TWINCRAFT_VERSION "\n"));
}

TEST_F(Sccompile, ForeseesAStepThatDestroysTheMotion) {
  const ProgramResult run = sccompile(
      {kQuickstart, "--check", "--set", "panels.*.stiffness=3e5", "--set", "panels.*.damping=0"});
  EXPECT_EQ(run.exit_code, 0) << run.err;  // the two targets are one machine all the same
  EXPECT_THAT(run.err, HasSubstr("warning[SC4003]: "));
  EXPECT_THAT(run.err, HasSubstr("resolves it"));
  EXPECT_THAT(sccompile({kQuickstart, "--check"}).err, Not(HasSubstr("SC4003")));
}

TEST_F(Sccompile, ProvesTheTwoTargetsEqual) {
  const ProgramResult run = compile(kQuickstart, {"--check"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("mass"));
  EXPECT_EQ(files(), 0);
}

TEST_F(Sccompile, SaysWhichFlagsHaveNoEffect) {
  const ProgramResult run = compile(kQuickstart, {"--emit", "bsm", "--check"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("warning: `-o` has no effect with `--check`"));
  EXPECT_THAT(run.err, HasSubstr("warning: `--emit` has no effect with `--check`"));
  EXPECT_THAT(sccompile({"--schema", "-o", "x"}).err,
              HasSubstr("warning: `-o` has no effect with `--schema`"));
  EXPECT_EQ(sccompile({"--schema"}).err, "");
  EXPECT_EQ(compile(kQuickstart).err, "");
}

TEST_F(Sccompile, WritesARuleOfWhatItReadForBuildTools) {
  fs::create_directory(folder.path() + "/far #1");
  folder.write("far #1/base.yaml", read_file(TWINCRAFT_ROOT "/models/quickstart.yaml"));
  const std::string spec =
      folder.write("a spec$.yaml", "extends: \"far #1/base.yaml\"\nname: near\n");
  const std::string rule = folder.path() + "/deep/near.d";
  const ProgramResult run = compile(spec, {"--emit", "mjcf,resolved", "--depfile", rule});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string here = folder.path();
  EXPECT_EQ(read_file(rule), here + "/out/near.xml " + here + "/out/near.resolved.yaml: \\\n  " +
                                 here + "/a\\ spec$$.yaml \\\n  " + here +
                                 "/far\\ \\#1/base.yaml\n");
  EXPECT_EQ(files(), 2);
  const std::string before = read_file(rule);
  EXPECT_EQ(compile(spec, {"--depfile", rule, "--set", "hub.mass=-5"}).exit_code, 1);
  EXPECT_EQ(read_file(rule), before);
}

TEST_F(Sccompile, NamesTheFileThatALinkedFolderLeadsTo) {
  fs::create_directories(folder.path() + "/deep/er");
  folder.write("deep/er/own.yaml", "extends: ../base.yaml\nname: own\n");
  folder.write("deep/base.yaml", read_file(TWINCRAFT_ROOT "/models/quickstart.yaml"));
  folder.write(".twincraft", "");
  fs::create_directory_symlink("deep/er", folder.path() + "/link");
  const ProgramResult run = compile(folder.path() + "/link/own.yaml", {"--list", "inputs"});
  EXPECT_EQ(run.out, folder.path() + "/link/own.yaml\n" +
                         fs::canonical(folder.path() + "/deep/base.yaml").string() + "\n");
}

TEST_F(Sccompile, ListsWhatItReadsAndWritesAndWritesNothing) {
  const ProgramResult inputs = compile(kQuickstart, {"--list", "inputs"});
  EXPECT_EQ(inputs.out, kQuickstart + "\n");
  const ProgramResult outputs = compile(kQuickstart, {"--emit", "dot,bsm", "--list", "outputs"});
  const std::string stem = folder.path() + "/out/wheels_and_panels";
  EXPECT_EQ(outputs.out, stem + ".dot\n" + stem + ".bsm.json\n");
  EXPECT_EQ(inputs.exit_code + outputs.exit_code, 0) << inputs.err << outputs.err;
  EXPECT_EQ(files(), 0);
  const std::string text = read_file(TWINCRAFT_ROOT "/" + kQuickstart);
  EXPECT_EQ(sccompile({"-", "--list", "inputs"}, {.standard_input = text}).out, "");
}

TEST_F(Sccompile, BlamesTheSpecForAPathOfItsStudy) {
  EXPECT_EQ(compile("tests/malformed/study_path_malformed.yaml").exit_code, 1);
  EXPECT_EQ(sccompile({kQuickstart, "--set", "hub..mass=1"}).exit_code, 2);
}

TEST_F(Sccompile, ReportsATargetThatIsRefusedAndWritesTheOther) {
  const ProgramResult run = compile(folder.write("ladder.yaml", R"(format: spacecraft/1
name: ladder
hub: {mass: 600, inertia: [400, 380, 360]}
panels:
  - name: wing
    hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: [1, 0, 0]}
    segments: 96
    mass: 50
    length: 9.6
    inertia: {shape: bar, axial_ratio: 0.05, axial_minimum: 1.0e-4}
    stiffness: 10
simulation: {integrator: rk4, step: 0.1, duration: 1, record: 0.5}
)"));
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_THAT(run.err, HasSubstr("`ladder.xml` is not written: a chain of 96 bodies"));
  EXPECT_TRUE(folder.has("out/ladder.bsm.json"));
  EXPECT_FALSE(folder.has("out/ladder.xml"));
}

TEST_F(Sccompile, WritesAScriptForBasiliskAsItDoesAllResults) {
  const std::string rule = folder.path() + "/script.d";
  const ProgramResult run = compile(kQuickstart, {"--emit", "basilisk", "--depfile", rule});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out + run.err, "");
  const std::string path = folder.path() + "/out/wheels_and_panels.basilisk.py";
  EXPECT_EQ(read_file(rule), path + ": \\\n  " + kQuickstart + "\n");
  EXPECT_EQ(files(), 1);
  EXPECT_EQ(compile(kQuickstart, {"--emit", "basilisk", "--list", "outputs"}).out, path + "\n");
  const ProgramResult printed = sccompile({kQuickstart, "-o", "-", "--emit", "basilisk"});
  EXPECT_EQ(printed.exit_code, 0);
  EXPECT_EQ(printed.out, written("wheels_and_panels.basilisk.py"));
}

TEST_F(Sccompile, WritesAScriptForBasiliskOfTheHalfThatItCanHave) {
  const ProgramResult run = compile("models/gallery/branched_arm.yaml", {"--emit", "basilisk"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("warning[SC4004]: not in Basilisk's BSM: `finger_l` and "));
  EXPECT_EQ(files(), 1);
  EXPECT_EQ(compile("models/gallery/branched_arm.yaml").err,
            "");  // of other results nothing is said
}

TEST_F(Sccompile, WritesNoScriptForBasiliskOfAVehicleThatItCannotHave) {
  const Arguments of_both = {"--emit", "basilisk,bsm",
                             "--set",  "simulation.step=0.1 ns",
                             "--set",  "simulation.duration=1 us",
                             "--set",  "simulation.record=1 us"};
  const ProgramResult run = compile(kQuickstart, of_both);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("`wheels_and_panels.basilisk.py` is not written: "));
  EXPECT_TRUE(folder.has("out/wheels_and_panels.bsm.json"));
  EXPECT_EQ(files(), 1);
}

TEST_F(Sccompile, WritesTheSpecOfAStudyForBasiliskAndTellsOfNoMember) {
  const ProgramResult run =
      compile("models/paper/studies/torque_orbit_steps.yaml", {"--emit", "basilisk"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(files(), 1);
  EXPECT_THAT(run.err, HasSubstr("note[SC4005]: in Basilisk's MJScene: "));
  EXPECT_THAT(run.err, Not(HasSubstr("member")));
}

/// A bad command line, what is said about it and what is hinted at.
struct Usage {
  const char* name;
  Arguments arguments;
  const char* said;
  const char* hint;
};

class SccompileRefuses : public testing::TestWithParam<Usage> {};

TEST_P(SccompileRefuses, TheCommandLine) {
  const ProgramResult run = sccompile(GetParam().arguments);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, StartsWith(std::string("sccompile: ") + GetParam().said));
  EXPECT_THAT(run.err, HasSubstr(std::string("hint: ") + GetParam().hint));
}

INSTANTIATE_TEST_SUITE_P(
    BadUsage, SccompileRefuses,
    testing::Values(
        Usage{"no_spec", {}, "SPEC is missing", "for example"},
        Usage{"unknown_flag",
              {"x.yaml", "--emmit", "bsm"},
              "unknown flag `--emmit`",
              "did you mean `--emit`?"},
        Usage{"unknown_flag_with_value",
              {"x.yaml", "--checks=1"},
              "unknown flag `--checks`",
              "did you mean `--check`?"},
        Usage{"strange_flag", {"x.yaml", "--quux"}, "unknown flag `--quux`", "`sccompile --help`"},
        Usage{"two_specs",
              {"x.yaml", "y.yaml"},
              "unexpected argument `y.yaml`",
              "`sccompile --help`"},
        Usage{"unknown_target",
              {"x.yaml", "--emit", "bsm,mjfc"},
              "`--emit` cannot be `mjfc`",
              "did you mean `mjcf`?"},
        Usage{"no_target", {"x.yaml", "--emit", ""}, "`--emit` is empty", "give it a value"},
        Usage{"no_folder",
              {"x.yaml", "-o", ""},
              "`-o` names no folder",
              "write for example `-o out`"},
        Usage{"no_spec_name", {""}, "`SPEC` is empty", "give it a value"},
        Usage{"unknown_format",
              {"x.yaml", "--diagnostics", "jsno"},
              "`--diagnostics` cannot be `jsno`",
              "did you mean `json`?"},
        Usage{"no_value", {"x.yaml", "--set"}, "--set", "`sccompile --help`"},
        Usage{"bad_count", {"x.yaml", "--max-errors", "many"}, "", "`sccompile --help`"},
        Usage{"unknown_list",
              {"x.yaml", "--list", "input"},
              "--list: `input` is none of inputs|outputs",
              "`sccompile --help`"},
        Usage{"depfile_of_nothing",
              {"x.yaml", "-o", "-", "--emit", "bsm", "--depfile", "x.d"},
              "`--depfile` names the files that are written",
              "write to a folder"},
        Usage{"mixed_lists",
              {"x.yaml", "--list", "inputs", "--diagnostics", "json"},
              "`--list` and `--diagnostics` both",
              "leave"},
        Usage{"mixed_streams",
              {"x.yaml", "-o", "-", "--emit", "bsm", "--diagnostics", "json"},
              "`-o -` and `--diagnostics` both",
              "write to a folder"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace twincraft
