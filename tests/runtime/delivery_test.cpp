// Claims about specs flown, attributed and proved in process: everything is what the programs print
// and write, byte for byte, and nothing is left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <future>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "runtime/delivery/attribution_run.h"
#include "runtime/delivery/room.h"
#include "runtime/delivery/spec_proof.h"
#include "runtime/delivery/spec_run.h"
#include "runtime/report/netcdf.h"
#include "tests/support/run_program.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramResult;
using test::run_program;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string kQuickstart = TWINCRAFT_ROOT "/models/quickstart.yaml";

// Members that are compared need the samples of an earlier one.
const std::string kStudy = R"(format: spacecraft/1
name: tumbler
hub: {mass: 750, inertia: [900, 800, 600]}
initial: {rate: [0.02, -0.01, 0.03]}
simulation: {integrator: rk4, step: 0.5, duration: 100, record: 10}
study:
  compare: initial.rate
  sweep:
    - {set: initial.rate, values: [[0.02, -0.01, 0.03], [0.04, 0, 0.03]]}
    - {set: simulation.step, values: [1, 0.5]}
)";

CompiledSpec compiled(const std::string& file, const Wanted& wanted,
                      std::vector<std::string> overrides = {}) {
  Diagnostics diagnostics;
  Compilation made = compile_spec({file, std::move(overrides)}, wanted, diagnostics);
  if (!made.compiled) throw std::runtime_error(file + " has faults");
  return *std::move(made.compiled);
}

RunRequest kept() {
  RunRequest request;
  request.options.trials = 0;
  request.keeps_results = true;
  return request;
}

SpecRun flown(const std::string& file, const RunRequest& request,
              std::vector<std::string> overrides = {}) {
  return fly(compiled(file, request.wanted(), std::move(overrides)), request);
}

/// Without the one thing that differs between two processes of the same build on one machine.
std::string without_load(const std::string& text) {
  static const std::regex load("\"load_average\": ?[-+.0-9e]+");
  return std::regex_replace(text, load, "");
}

/// What is in a folder, by name.
std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] =
          without_load(test::read_file(entry.path()));
  return files;
}

std::vector<std::string> names(const std::map<std::string, std::string>& files) {
  std::vector<std::string> all;
  for (const auto& [name, text] : files) all.push_back(name);
  return all;
}

class Delivery : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return folder.path() + "/" + name; }
  ProgramResult scsim(std::vector<std::string> arguments) const {
    return run_program(TWINCRAFT_SCSIM, arguments);
  }

  TemporaryFolder folder;
};

TEST_F(Delivery, SavesASingleRunAsTheProgramWritesIt) {
  const ProgramResult program = scsim({kQuickstart, "-o", at("program"), "--no-timing"});
  const SpecRun run = flown(kQuickstart, kept());
  EXPECT_EQ(run.save(at("deep/library")), "");
  const auto files = files_in(at("deep/library"));
  EXPECT_THAT(names(files), ElementsAre("bsm.csv", "mujoco.csv", "report.html", "report.json"));
  EXPECT_TRUE(files == files_in(at("program")));
  EXPECT_EQ(without_load(run.json()), files.at("report.json"));
  EXPECT_EQ(run.text(), program.out);
  EXPECT_EQ(run.exit_code(), program.exit_code);
  EXPECT_EQ(run.verdict(), Verdict::kAgree);
}

TEST_F(Delivery, SavesAStudyAsTheProgramWritesIt) {
  const std::string spec = folder.write("study.yaml", kStudy);
  const ProgramResult program = scsim({spec, "-o", at("program"), "--no-timing"});
  RunRequest request = kept();
  request.jobs = 2;
  std::vector<std::size_t> finished;
  request.finished = [&](std::size_t index, const ReportedMember& /*member*/) {
    finished.push_back(index);
  };
  const SpecRun run = flown(spec, request);
  EXPECT_EQ(run.save(at("library")), "");
  const auto files = files_in(at("library"));
  EXPECT_THAT(files, SizeIs(2 + 4 * 2));
  EXPECT_TRUE(files == files_in(at("program")));
  EXPECT_EQ(without_load(run.json()), files.at("report.json"));
  EXPECT_EQ(run.text(), program.out);
  EXPECT_EQ(run.exit_code(), program.exit_code);
  EXPECT_EQ(run.members(), 4u);
  EXPECT_THAT(finished, ElementsAre(0, 1, 2, 3));
}

TEST_F(Delivery, WritesIntoAFolderWhileItFlies) {
  RunRequest request = kept();
  request.keeps_results = false;
  request.folder = at("flying");
  EXPECT_EQ(flown(kQuickstart, request).error(), "");
  EXPECT_EQ(flown(kQuickstart, kept()).save(at("saved")), "");
  EXPECT_TRUE(files_in(at("flying")) == files_in(at("saved")));
}

TEST_F(Delivery, DoesBothAtOnce) {
  RunRequest request = kept();
  request.folder = at("first");
  const SpecRun run = flown(folder.write("study.yaml", kStudy), request);
  EXPECT_EQ(run.error(), "");
  EXPECT_EQ(run.save(at("second")), "");
  EXPECT_TRUE(files_in(at("first")) == files_in(at("second")));
}

TEST_F(Delivery, KeepsTheSamplesOfTheFirstMember) {
  const SpecRun run = flown(kQuickstart, kept());
  for (const EngineKind engine : {EngineKind::kBsm, EngineKind::kMujoco}) {
    const Trajectory& trajectory = run.trajectory(engine);
    EXPECT_EQ(trajectory.status, Trajectory::Status::kComplete);
    EXPECT_THAT(trajectory.samples, SizeIs(241));
    EXPECT_EQ(trajectory.recorded, 241u);
  }
  EXPECT_THAT(run.report().members.front().result.engines[0].trajectory.samples, SizeIs(1));
  const SpecRun study = flown(folder.write("study.yaml", kStudy), kept());
  EXPECT_THAT(study.trajectory(EngineKind::kMujoco).samples, SizeIs(11));
}

TEST_F(Delivery, RemovesWhatAnEarlierRunLeft) {
  EXPECT_EQ(flown(folder.write("study.yaml", kStudy), kept()).save(at("out")), "");
  folder.write("out/notes.txt", "the user's");
  RunRequest alone = kept();
  alone.options.mujoco = false;
  const SpecRun run = flown(kQuickstart, alone);
  EXPECT_EQ(run.save(at("out")), "");
  EXPECT_THAT(names(files_in(at("out"))),
              ElementsAre("bsm.csv", "notes.txt", "report.html", "report.json"));
  EXPECT_THAT(run.trajectory(EngineKind::kMujoco).samples, IsEmpty());
}

TEST_F(Delivery, SaysWhyItCannotSaveInTheWordsOfTheProgram) {
  folder.write("file", "");
  const ProgramResult program = scsim({kQuickstart, "--no-timing", "-o", at("file")});
  EXPECT_EQ("scsim: " + flown(kQuickstart, kept()).save(at("file")) + "\n", program.err);
}

TEST_F(Delivery, SavesNothingIntoAFolderWithoutAName) {
  EXPECT_THAT(flown(kQuickstart, kept()).save(""), HasSubstr("no folder is named"));
  EXPECT_FALSE(fs::exists("report.json"));
}

TEST_F(Delivery, LeavesNoTemporaryFolderAndPrintsNothing) {
  ASSERT_EQ(::setenv("TMPDIR", folder.path().c_str(), 1), 0);
  const std::string spec = folder.write("study.yaml", kStudy);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  {
    SpecRun run = flown(spec, kept());
    EXPECT_THAT(names(files_in(folder.path())), SizeIs(1 + 1 + 4 * 2)) << "spec, members, theirs";
    run = flown(spec, kept());
    EXPECT_THAT(names(files_in(folder.path())), SizeIs(1 + 1 + 4 * 2));
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(names(files_in(folder.path())), ElementsAre("study.yaml"));
  ASSERT_EQ(::setenv("TMPDIR", at("nowhere").c_str(), 1), 0);
  const SpecRun homeless = flown(spec, kept());
  EXPECT_THAT(homeless.error(), HasSubstr("cannot make a folder in"));
  EXPECT_EQ(homeless.save(at("out")), homeless.error());
  EXPECT_EQ(homeless.exit_code(), kExitInputOutput);
  ::unsetenv("TMPDIR");
}

TEST_F(Delivery, FliesOnTwoThreadsAtOnce) {
  const std::string spec = folder.write("study.yaml", kStudy);
  const auto fly_and_save = [&](const std::string& file, const std::string& out) {
    const SpecRun run = flown(file, kept());
    EXPECT_EQ(run.save(at(out)), "");
    return without_load(run.json());
  };
  const std::string alone = fly_and_save(kQuickstart, "a");
  const std::string study_alone = fly_and_save(spec, "study_a");
  std::future<std::string> other =
      std::async(std::launch::async, [&] { return fly_and_save(spec, "study_b"); });
  EXPECT_EQ(fly_and_save(kQuickstart, "b"), alone);
  EXPECT_EQ(other.get(), study_alone);
  EXPECT_TRUE(files_in(at("a")) == files_in(at("b")));
  EXPECT_TRUE(files_in(at("study_a")) == files_in(at("study_b")));
}

TEST_F(Delivery, NamesTheProgramThatCalls) {
  RunRequest request = kept();
  request.program = "mission 7";
  EXPECT_EQ(json::parse(flown(kQuickstart, request).json())["provenance"]["program"], "mission 7");
}

TEST_F(Delivery, MakesAFailedRunAResult) {
  const ProgramResult program = scsim({kQuickstart, "--no-timing", "--step", "3 s"});
  const SpecRun run = flown(kQuickstart, kept(), {"simulation.step=3 s"});
  EXPECT_EQ(run.exit_code(), kExitFailure);
  EXPECT_EQ(run.exit_code(), program.exit_code);
  EXPECT_EQ(run.verdict(), Verdict::kFailed);
  std::string told;
  for (const std::string& failure : run.failures()) told += "scsim: " + failure + "\n";
  EXPECT_EQ(told, program.err);
  EXPECT_EQ(run.text(), program.out);
}

TEST_F(Delivery, MakesAStoppedRunAResult) {
  const std::atomic<bool> stop{true};
  RunRequest request = kept();
  request.options.stop = &stop;
  const SpecRun run = flown(kQuickstart, request);
  EXPECT_EQ(run.verdict(), Verdict::kInterrupted);
  EXPECT_EQ(run.exit_code(), kExitInterrupted);
  EXPECT_EQ(json::parse(run.json())["complete"], false);
  EXPECT_EQ(run.save(at("out")), "");
  const SpecRun study = flown(folder.write("study.yaml", kStudy), request);
  EXPECT_TRUE(study.empty());
  EXPECT_EQ(study.verdict(), Verdict::kInterrupted);
  EXPECT_EQ(study.exit_code(), kExitInterrupted);
  EXPECT_THAT(study.save(at("out")), HasSubstr("interrupted before its first member"));
}

TEST_F(Delivery, SavesNetcdfWhereItWasAskedFor) {
  if (!has_netcdf()) GTEST_SKIP() << "this build has no netCDF";
  EXPECT_EQ(scsim({kQuickstart, "--no-timing", "--netcdf", "-o", at("program")}).exit_code, 0);
  RunRequest request = kept();
  request.netcdf = true;
  EXPECT_EQ(flown(kQuickstart, request).save(at("library")), "");
  const auto files = files_in(at("library"));
  EXPECT_THAT(files, SizeIs(6));
  EXPECT_TRUE(files == files_in(at("program")));
}

TEST_F(Delivery, RefusesToKeepWhatMemoryDoesNotHold) {
  const CompiledSpec spec = compiled(
      kQuickstart, {kMjcf},
      {"simulation.step=0.1 ms", "simulation.record=0.1 ms", "simulation.duration=1000 s"});
  Diagnostics diagnostics;
  EXPECT_FALSE(check_memory(spec, kept(), diagnostics));
  ASSERT_THAT(diagnostics.all(), SizeIs(1));
  EXPECT_EQ(diagnostics.all().front().code, Code::kTooManySteps);
  RunRequest passing = kept();
  passing.keeps_results = false;
  EXPECT_TRUE(check_memory(spec, passing, diagnostics)) << "samples pass";
}

TEST_F(Delivery, AttributesAsTheProgramDoes) {
  const std::string spec = TWINCRAFT_ROOT "/models/paper/rw_panels.yaml";
  const std::vector<std::string> changes{"simulation.duration=2 s",
                                         "engines.mujoco.compensate=false"};
  const ProgramResult program =
      scsim({"attribute", spec, "--set", changes[0], "--set", changes[1], "-o", at("program")});
  const AttributionRun run = attribute(compiled(spec, wanted_by_attribution(true), changes), {});
  EXPECT_TRUE(run.complete());
  EXPECT_EQ(run.complaint(), "");
  EXPECT_EQ(run.exit_code(), program.exit_code);
  EXPECT_EQ(run.text(), program.out);
  EXPECT_EQ(run.save(at("library")), "");
  const auto files = files_in(at("library"));
  EXPECT_TRUE(files == files_in(at("program")));
  EXPECT_EQ(without_load(run.json()), files.at("report.json"));
}

TEST_F(Delivery, SaysWhyThereIsNothingToAttribute) {
  const ProgramResult program = scsim({"attribute", kQuickstart, "--step", "3 s"});
  const AttributionRun run =
      attribute(compiled(kQuickstart, wanted_by_attribution(true), {"simulation.step=3 s"}), {});
  EXPECT_FALSE(run.attributed());
  EXPECT_EQ("scsim: " + run.complaint() + "\n", program.err);
  EXPECT_EQ(run.exit_code(), program.exit_code);
  EXPECT_EQ(run.text(), "");
}

TEST_F(Delivery, ProvesAsTheProgramDoes) {
  for (const char* compensate : {"true", "false"}) {
    const std::string spec = TWINCRAFT_ROOT "/models/paper/rw_panels.yaml";
    const std::string change = std::string("engines.mujoco.compensate=") + compensate;
    const ProgramResult program =
        run_program(TWINCRAFT_SCCOMPILE, {spec, "--check", "--set", change});
    const SpecProof proof = prove_spec(compiled(spec, {kMjcf}, {change}).bundle);
    EXPECT_EQ(proof.text(), program.out);
    EXPECT_EQ(proof.exit_code(), program.exit_code);
    const json document = json::parse(proof.json());
    EXPECT_EQ(document["holds"], proof.holds());
    EXPECT_EQ(document["states"], kProofStates);
    EXPECT_EQ(document["rows"].size(), proof.report().lines.size());
    EXPECT_EQ(document["worst_relative_difference"] < 1.0e-10, proof.holds());
  }
}

}  // namespace
}  // namespace twincraft
