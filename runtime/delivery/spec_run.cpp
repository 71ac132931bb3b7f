// See spec_run.h. A single run that is kept has its samples in memory and is written from them; a
// study that is kept writes its files while it is flown, and they are copied.
#include "runtime/delivery/spec_run.h"

#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "runtime/delivery/file_parts.h"
#include "runtime/delivery/member_files.h"
#include "runtime/delivery/run_record.h"
#include "runtime/delivery/scratch_folder.h"
#include "runtime/delivery/study_outputs.h"
#include "runtime/report/json.h"
#include "runtime/report/study_table.h"
#include "runtime/report/table.h"
#include "runtime/study/replay.h"
#include "runtime/study/run_study.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

using Trajectories = std::array<Trajectory, 2>;

/// Keeps the samples of a member, on their way to its files.
class SampleKeeper : public MemberOutput {
 public:
  /// @param next  may be nothing
  SampleKeeper(Trajectories& kept, std::unique_ptr<MemberOutput> next)
      : kept_(kept), next_(std::move(next)) {}

  void take(std::size_t engine, const Observation& sample, const Books& books) override {
    samples_.at(engine).take(sample, books);
    if (next_) next_->take(engine, sample, books);
  }
  void take_pair(const Observation& bsm, const Observation& mujoco,
                 std::span<const double> metrics) override {
    if (next_) next_->take_pair(bsm, mujoco, metrics);
  }
  void land() override {
    if (next_) next_->land();
  }
  void publish(ReportedMember& member) override {
    for (std::size_t engine = 0; engine < kept_.size(); ++engine) {
      kept_[engine] = member.result.engines.at(engine).trajectory;
      kept_[engine].samples = std::move(samples_[engine].samples);
      kept_[engine].books = std::move(samples_[engine].books);
    }
    if (next_) next_->publish(member);
  }

 private:
  Trajectories& kept_;
  std::unique_ptr<MemberOutput> next_;
  std::array<SampleStore, 2> samples_;
};

/// The files that a run copies when it is saved.
std::unique_ptr<ScratchFolder> scratch_of(const RunRequest& request, bool is_study) {
  const bool needed = request.keeps_results && is_study;
  return needed ? std::make_unique<ScratchFolder>() : nullptr;
}

/// A member's file from one folder to another. @return as write_files
std::string copy_file(const OutputFolder& from, OutputFolder& to, std::size_t member,
                      const std::string& name) {
  std::vector<PendingFile> files;
  std::string error =
      copy_in_parts(from.of_member(member) / name, files.emplace_back(to.of_member(member) / name));
  if (error.empty()) error = publish(files);
  if (error.empty()) to.wrote(member, name);
  return error;
}

}  // namespace

struct SpecRun::Parts {
  Parts(const RunRequest& request, const StudyPlan* study)
      : keeps(request.keeps_results),
        netcdf(request.netcdf),
        scratch(scratch_of(request, study != nullptr)),
        record(provenance_of(request.options, request.program),
               study != nullptr ? std::optional(*study) : std::nullopt, folder_of(request)) {
    if (scratch) error = scratch->error();
  }

  /// Where files are written while it is flown; empty: nowhere.
  fs::path folder_of(const RunRequest& request) const {
    if (scratch) return scratch->path();
    return keeps ? fs::path() : fs::path(request.folder);
  }

  /// What member `index` leaves beside the report.
  std::unique_ptr<MemberOutput> output_of(std::size_t index, const Bundle& bundle) {
    std::unique_ptr<MemberOutput> files;
    if (record.files() != nullptr)
      files = std::make_unique<MemberFiles>(bundle, MemberFilesPlan{index, netcdf},
                                            record.report().provenance, record.output());
    std::unique_ptr<MemberOutput> output = std::move(files);
    if (keeps && index == 0)
      output = std::make_unique<SampleKeeper>(trajectories, std::move(output));
    const std::optional<StudyPlan>& study = record.report().study;
    if (study && !study->outputs.empty())
      output = std::make_unique<StudyOutputs>(bundle.model, study->outputs, std::move(output));
    return output;
  }

  const bool keeps, netcdf;
  std::unique_ptr<ScratchFolder> scratch;
  RunRecord record;
  Trajectories trajectories;
  bool stopped = false;
  std::string error;

  void fly_single(Bundle bundle, const RunRequest& request);
  void fly_study(const LoadedSpec& spec, const RunRequest& request);
};

void SpecRun::Parts::fly_single(Bundle bundle, const RunRequest& request) {
  RunOptions options = request.options;
  options.keep_samples = false;
  options.side_by_side = request.jobs > 1;
  FlownMember flown = run_one({std::move(bundle), {}}, options,
                              [this](const Bundle& flying) { return output_of(0, flying); });
  if (flown.output) flown.output->publish(flown.member);
  record.take(std::move(flown.member));
}

void SpecRun::Parts::fly_study(const LoadedSpec& spec, const RunRequest& request) {
  StudyRun study;
  study.plan = *spec.study();
  study.compile = [&spec, wanted = request.wanted()](std::size_t index) {
    return compile_member(
        [&](Diagnostics& diagnostics) { return spec.member(index, wanted, diagnostics); });
  };
  study.output = [this](std::size_t index, const Bundle& bundle) {
    return output_of(index, bundle);
  };
  study.finished = [&](std::size_t index, ReportedMember member) {
    if (request.finished) request.finished(index, member);
    record.take(std::move(member));
  };
  study.jobs = request.jobs;
  RunOptions options = request.options;
  options.keep_samples = study.plan.compare.has_value();  // needed again by later members
  options.side_by_side = false;
  run_study(study, options);
}

SpecRun::SpecRun(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SpecRun::SpecRun(SpecRun&& other) noexcept = default;
SpecRun& SpecRun::operator=(SpecRun&& other) noexcept = default;
SpecRun::~SpecRun() = default;

bool SpecRun::empty() const { return parts_->record.empty(); }
std::size_t SpecRun::members() const { return parts_->record.members(); }
const Report& SpecRun::report() const { return parts_->record.report(); }
const std::string& SpecRun::error() const { return parts_->error; }
std::vector<std::string> SpecRun::failures() const { return parts_->record.failures(); }

Verdict SpecRun::verdict() const { return empty() ? Verdict::kInterrupted : report().verdict(); }

int SpecRun::exit_code() const {
  if (!parts_->error.empty()) return kExitInputOutput;
  if (parts_->stopped) return kExitInterrupted;
  if (parts_->record.worst() != kExitDone || empty()) return parts_->record.worst();
  const Verdict found = verdict();
  const bool breaks = report().record && report().record->breaks_requirements();
  const bool finds = breaks || found == Verdict::kDisagree || found == Verdict::kUnresolved;
  return finds ? kExitFindings : kExitDone;
}

std::string SpecRun::text(bool colour) const {
  return report().study ? study_table(report(), colour)
                        : report_table(report().members.front(), colour);
}

std::string SpecRun::json() const {
  const ReportFiles* const files = parts_->record.files();
  if (files == nullptr && report().study) throw std::runtime_error(parts_->error);
  return files != nullptr ? files->json(report()) : report_json(report());
}

const Trajectory& SpecRun::trajectory(EngineKind engine) const {
  return parts_->trajectories[static_cast<std::size_t>(engine)];
}

std::string SpecRun::save(const std::string& folder) const {
  if (empty()) return "nothing to write: the run was interrupted before its first member";
  if (folder.empty()) return kNoFolder;
  if (std::string error = try_files(first_paths(folder)); !error.empty()) return error;
  return report().study ? save_study(folder) : save_single(folder);
}

/// As if it were flown again, into files.
std::string SpecRun::save_single(const std::string& folder) const {
  Report written = report();  // with what the page draws
  ReportedMember& member = written.members.front();
  SharedOutput output{OutputFolder(folder)};
  MemberFiles files(member.bundle, {0, parts_->netcdf}, written.provenance, output);
  const auto& [bsm, mujoco] = parts_->trajectories;
  replay(member.bundle.model, {&bsm, &mujoco}, files);
  files.land();
  files.publish(member);
  return output.error.empty() ? write_report(written, output.folder) : output.error;
}

std::string SpecRun::save_study(const std::string& folder) const {
  const SharedOutput& flown = parts_->record.output();
  if (!parts_->error.empty()) return parts_->error;
  if (!flown.error.empty()) return flown.error;
  OutputFolder saved(folder);
  std::string error;
  flown.folder.for_each_written([&](std::size_t member, const std::string& name) {
    if (error.empty()) error = copy_file(flown.folder, saved, member, name);
  });
  if (error.empty()) error = parts_->record.files()->write(report(), folder);
  if (error.empty()) saved.remove_leftovers();
  return error;
}

SpecRun fly(CompiledSpec compiled, const RunRequest& request) {
  const StudyPlan* const study = compiled.spec.study();
  auto parts = std::make_unique<SpecRun::Parts>(request, study);
  if (study != nullptr)
    parts->fly_study(compiled.spec, request);
  else
    parts->fly_single(std::move(compiled.bundle), request);
  parts->stopped = request.options.stopped();
  SpecRun run(std::move(parts));
  if (run.empty()) return run;
  std::string& error = run.parts_->error;
  if (!error.empty()) return run;
  if (!request.keeps_results)
    error =
        run.parts_->record.write([&request](double done) { request.options.show("write", done); });
  else if (!request.folder.empty())
    error = run.save(request.folder);
  return run;
}

std::vector<std::string> first_paths(const std::string& folder) {
  std::vector<std::string> files = report_paths(folder);
  if (files.empty()) return files;
  for (const EngineName& engine : kEngines)
    files.push_back((fs::path(folder) / (std::string(engine.key) + ".csv")).string());
  return files;
}

Provenance provenance_of(const RunOptions& options, const std::string& program) {
  Provenance made = provenance(options.instructions);
  if (!program.empty()) made.program = program;
  return made;
}

}  // namespace twincraft
