// From compiler to variants to attribution to report.
#include "runtime/delivery/attribution_run.h"

#include <fmt/format.h>

#include <utility>

#include "compiler/files/output.h"
#include "runtime/delivery/report_files.h"
#include "runtime/delivery/spec_run.h"
#include "runtime/report/attribution_table.h"
#include "runtime/report/json.h"
#include "runtime/study/in_order.h"
#include "runtime/study/mujoco_rounding.h"
#include "runtime/study/run_study.h"

namespace twincraft {
namespace {

/// Only the engines are asked: references judge neither of them here.
MemberSpec without_references(MemberSpec spec) {
  if (spec.bundle) spec.bundle->model.references.clear();
  return spec;
}

MemberSpec compile_variant(const LoadedSpec& loaded, const Overrides& changes) {
  return without_references(compile_member(
      [&](Diagnostics& diagnostics) { return loaded.variant(changes, {kMjcf}, diagnostics); }));
}

/// Why the engines' trajectories can not be compared to their end; empty when they can.
std::string fault_of(const Member& member) {
  for (const EngineRun& run : member.engines)
    if (!run.reason.empty()) return fmt::format("{}: {}", run.name, run.reason);
  return {};
}

const Trajectory& trajectory_of(const Member& member, std::size_t engine) {
  return member.engines.at(engine).trajectory;
}

ErrorSeries error_of(const Subject& subject, const Member& member) {
  return error_of(subject, trajectory_of(member, 0), trajectory_of(member, 1));
}

VariantResult result_of(const Subject& subject, const Member& member) {
  VariantResult result;
  result.failure = fault_of(member);
  if (result.failure.empty()) result.error = error_of(subject, member);
  return result;
}

/// Variants several at a time; of each only its error is kept.
std::vector<VariantResult> run_variants(const LoadedSpec& spec, const Subject& subject,
                                        const std::vector<Overrides>& changes,
                                        const RunOptions& options, int jobs) {
  RunOptions quiet = options;
  quiet.progress = nullptr;  // of variants, not inside them
  std::vector<VariantResult> results;
  OrderedWork<VariantResult> plan;
  plan.count = changes.size();
  plan.work = [&](std::size_t index) {
    return result_of(subject, run_one(compile_variant(spec, changes[index]), quiet).member.result);
  };
  plan.deliver = [&](VariantResult result) {
    results.push_back(std::move(result));
    options.show("variants",
                 static_cast<double>(results.size()) / static_cast<double>(changes.size()));
  };
  plan.may_go_on = [&options] { return !options.stopped(); };
  in_order(plan, jobs);
  return results;
}

/// Attitude, unless that is rounding and the centre of mass or a joint is not.
Subject choose(const ReportedMember& member) {
  const Trajectory& mujoco = trajectory_of(member.result, 1);
  std::vector<Subject> subjects =
      subjects_of(member.bundle.model, trajectory_of(member.result, 0), mujoco);
  for (Subject& subject : subjects) {
    if (error_of(subject, member.result).maximum() <= subject.rounding) continue;
    subject.mujoco_rounding = mujoco_rounding(member.bundle, subject, mujoco);
    return subject;
  }
  return subjects.front();
}

/// Why there is nothing to attribute; empty when there is.
std::string nothing_to_attribute(const Member& result) {
  if (const std::string fault = fault_of(result); !fault.empty())
    return fmt::format("nothing to attribute: {}", fault);
  if (result.unresolved())
    return fmt::format("nothing to attribute: the run is unresolved: {}",
                       result.resolution->reasons.front());
  return {};
}

}  // namespace

Wanted wanted_by_attribution(bool reports) {
  Wanted wanted = wanted_by_run(reports);
  if (!reports) wanted.push_back(kResolved);  // causes are read from it
  return wanted;
}

std::string AttributionRun::text(bool colour) const {
  if (!attributed()) return {};
  const char* const note = has_study_ ? "\nthe spec itself was run; its study was left out\n" : "";
  return attribution_table(report_, colour) + note;
}

std::string AttributionRun::json() const { return report_json(report_); }

std::string AttributionRun::save(const std::string& folder) const {
  if (folder.empty()) return kNoFolder;
  if (std::string error = try_files(report_paths(folder)); !error.empty()) return error;
  return write_report(report_, OutputFolder(folder));
}

AttributionRun attribute(CompiledSpec compiled, const AttributionRequest& request) {
  RunOptions options = request.options;
  options.trials = 0;
  options.keep_samples = true;
  AttributionRun run;
  run.has_study_ = compiled.spec.study() != nullptr;
  Report& report = run.report_ = Report{provenance_of(options, request.program), {}};
  report.members.push_back(
      run_one(without_references({std::move(compiled.bundle), {}}), options).member);
  const ReportedMember& member = report.members.front();
  run.complaint_ = nothing_to_attribute(member.result);
  if (run.complaint_.empty()) {
    const Subject subject = choose(member);
    report.attribution =
        attribute(member.bundle, subject, error_of(subject, member.result),
                  [&](const std::vector<Overrides>& changes) {
                    return run_variants(compiled.spec, subject, changes, options, request.jobs);
                  });
    if (!run.complete())
      run.complaint_ = fmt::format("a variant failed: {}", report.attribution->failure);
  }
  if (options.stopped())
    run.code_ = kExitInterrupted;
  else if (!run.complete())
    run.code_ = run.attributed() || member.result.failed() ? kExitFailure : kExitFindings;
  return run;
}

}  // namespace twincraft
