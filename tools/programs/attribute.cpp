// Flags to compiler to variants to attribution to report to exit code.
// Tested by tests/agreement/attribution_test.cpp.
#include "tools/programs/attribute.h"

#include <fmt/format.h>
#include <unistd.h>

#include "runtime/report/attribution_table.h"
#include "runtime/report/attribution_words.h"
#include "runtime/study/in_order.h"
#include "runtime/study/mujoco_rounding.h"
#include "runtime/study/run_study.h"
#include "tools/programs/command.h"
#include "tools/programs/interrupt.h"

namespace twincraft {
namespace {

/// Text in lines of at most `width` characters.
std::string wrapped(std::string_view text, std::size_t width) {
  std::string lines;
  while (text.size() > width) {
    const std::size_t end = text.rfind(' ', width);
    lines += fmt::format("{}\n", text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines.append(text);
}

void describe(CommandLine& line, CommonOptions& options) {
  describe_input(line, options, "report.json and report.html");
  describe_instructions(line, options);
  describe_jobs(line, options, "variants at a time (default: all cores)");
  describe_talk(line, options);
  line.set_column(28);
  line.add_footer(fmt::format(
      "Variants: co-moving frame, token masses and inertias taken away, one gravity law, one\n"
      "attitude chart; each as far as it applies. A study is left out: the spec itself is run.\n"
      "{}\n\n"
      "Exit: 0 explained, 1 faults in the spec, 2 usage, 3 input/output, 4 numerical failure,\n"
      "130/143 interrupted.\n\n"
      "Example: scsim attribute models/paper/rw_panels.yaml --set engines.mujoco.compensate=false",
      wrapped(attribution_method(), 92)));
}

/// Only the engines are asked: references judge neither of them here.
MemberSpec without_references(std::optional<Bundle> bundle) {
  if (bundle) bundle->model.references.clear();
  return {std::move(bundle), {}};
}

MemberSpec compile_variant(const LoadedSpec& loaded, const Overrides& changes) {
  Diagnostics diagnostics;
  MemberSpec spec = without_references(loaded.variant(changes, {kMjcf}, diagnostics));
  for (const Diagnostic& fault : diagnostics.all())
    if (!spec.bundle && fault.severity == Severity::kError && spec.refusal.empty())
      spec.refusal = fault.message;
  return spec;
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
    if (options.progress)
      options.progress("variants",
                       static_cast<double>(results.size()) / static_cast<double>(changes.size()));
  };
  plan.may_go_on = [&options] { return !*options.stop; };
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

int deliver(const Report& report, bool has_study, const CommonOptions& options) {
  const int written = write_report(report, options);
  if (written == kExitDone && !options.folder.empty())
    tell_written({"report.json", "report.html"}, options);
  if (!prints_report(options)) return written;
  const std::string note =
      has_study ? "\nthe spec itself was run; its study was left out\n" : std::string();
  const int printed = print(attribution_table(report, wants_colour(STDOUT_FILENO)) + note);
  return written != kExitDone ? written : printed;
}

/// Says why, if the spec itself can not be flown to its end. @return the exit code
int check_flown(const Member& result) {
  const std::string fault = fault_of(result);
  if (fault.empty()) return kExitDone;
  complain(fmt::format("nothing to attribute: {}", fault));
  if (const int interrupted = interrupt_exit_code(); interrupted != 0) return interrupted;
  return result.failed() ? kExitFailure : kExitFindings;
}

/// Says why, if what was flown is not the vehicle's motion. @return the exit code
int check_resolved(const Member& result) {
  if (!result.unresolved()) return kExitDone;
  complain(fmt::format("nothing to attribute: the run is unresolved: {}",
                       result.resolution->reasons.front()));
  return kExitFindings;
}

int exit_code(const Attribution& attribution) {
  if (const int interrupted = interrupt_exit_code(); interrupted != 0) return interrupted;
  if (attribution.complete) return kExitDone;
  complain(fmt::format("a variant failed: {}", attribution.failure));
  return kExitFailure;
}

int explain(CompiledSpec compiled, const CommonOptions& options) {
  ProgressBar bar(stderr);
  RunOptions run = watched_run(options, bar);
  run.trials = 0;
  Report report{provenance_of(options), {}};
  report.members.push_back(run_one(without_references(std::move(compiled.bundle)), run).member);
  const ReportedMember& member = report.members.front();
  bar.clear();
  int code = check_flown(member.result);
  if (code == kExitDone) code = check_resolved(member.result);
  if (code != kExitDone) {
    const int written = write_report(report, options);
    return written != kExitDone ? written : code;
  }
  const Subject subject = choose(member);
  report.attribution =
      attribute(member.bundle, subject, error_of(subject, member.result),
                [&](const std::vector<Overrides>& changes) {
                  return run_variants(compiled.spec, subject, changes, run, jobs_of(options));
                });
  bar.clear();
  const int delivered = deliver(report, compiled.spec.study() != nullptr, options);
  return delivered != kExitDone ? delivered : exit_code(*report.attribution);
}

}  // namespace

int attribute_command(int argc, char** argv) {
  CommandLine line{"Explains why the two engines differ on a spec: how much each cause carries.",
                   "scsim attribute"};
  CommonOptions options;
  describe(line, options);
  if (const std::optional<int> code = line.parse(argc, argv)) return *code;
  if (const std::optional<int> code = settle_flags("scsim attribute", options)) return *code;
  Wanted wanted = wanted_by_run(options);
  wanted.push_back(kResolved);  // causes are read from it
  std::optional<CompiledSpec> compiled;
  if (const int code = compile_spec(options, wanted, compiled); code != kExitDone) return code;
  // The run itself and a variant per job, of both engines.
  const int code_of_memory = check_memory(*compiled, 2.0 * (1.0 + jobs_of(options)), options);
  if (code_of_memory != kExitDone) return code_of_memory;
  if (const int code = check_writable(report_files(options)); code != kExitDone) return code;
  return explain(*std::move(compiled), options);
}

}  // namespace twincraft
