#include "runtime/report/verdict_words.h"

#include <fmt/color.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "runtime/report/judgement.h"

namespace twincraft {
namespace {

std::string paint(std::string_view text, fmt::color shade, bool colour) {
  return colour ? fmt::format(fmt::fg(shade), "{}", text) : std::string(text);
}

fmt::color shade_of(Verdict verdict) {
  if (verdict == Verdict::kAgree) return fmt::color::green;
  return verdict == Verdict::kUnresolved ? fmt::color::orange : fmt::color::red;
}

std::string why_not_judged(const Member& member) {
  for (const EngineRun& run : member.engines)
    if (!run.reason.empty()) return fmt::format("{}: {}", engine_label(run.name), run.reason);
  if (member.comparison && !member.comparison->same_times)
    return "the engines were not sampled at the same times";
  return "the spec gives no tolerance";
}

/// The first engine in this state, and why: `BSM stopped at t = 1.4 s: ...`.
std::string engine_words(const Member& member, bool (*is_it)(const EngineRun&)) {
  const auto found = std::ranges::find_if(member.engines, is_it);
  if (found == member.engines.end()) return {};
  return fmt::format("{} {}", engine_label(found->name), found->reason);
}

std::string failure_words(const Member& member) {
  const auto has_failed = [](const EngineRun& run) {
    return run.status == EngineRun::Status::kFailed;
  };
  if (std::ranges::all_of(member.engines, has_failed) &&
      member.engines[0].reason == member.engines[1].reason)
    return "both engines " + member.engines[0].reason;
  return engine_words(member, has_failed);
}

std::string interruption_words(const Member& member) {
  const std::string words = engine_words(member, [](const EngineRun& run) {
    return run.trajectory.status == Trajectory::Status::kInterrupted;
  });
  return words.empty() ? "before all was done" : words;
}

std::string unresolved_words(const Member& member) {
  std::string text;
  for (const std::string& reason : member.resolution->reasons)
    text += fmt::format("{}{}", text.empty() ? "" : "\n  ", reason);
  return text;
}

/// Members with this verdict.
std::size_t count(const Report& report, Verdict verdict) {
  return report.summary()->count(verdict);
}

std::string members(std::size_t count) {
  return fmt::format("{} {}", count, count == 1 ? "member" : "members");
}

std::string study_words(const Report& report) {
  switch (report.verdict()) {
    case Verdict::kAgree:
      return held_words(report) + " in every member";
    case Verdict::kDisagree:
      return fmt::format("{}, in {}", exceeded_words(report.summary()->exceeded()),
                         members(count(report, Verdict::kDisagree)));
    case Verdict::kUnresolved:
      return fmt::format("unresolved: the step of {} does not resolve the vehicle",
                         members(count(report, Verdict::kUnresolved)));
    case Verdict::kFailed:
      return fmt::format("{} failed", members(count(report, Verdict::kFailed)));
    case Verdict::kInterrupted:
      return fmt::format("interrupted after {} of {}", report.summary()->members(),
                         members(report.study->members));
    case Verdict::kNotJudged:
      break;
  }
  return "not judged in every member";
}

}  // namespace

std::string verdict_line(const Member& member, bool colour) {
  const Verdict verdict = member.verdict();
  switch (verdict) {
    case Verdict::kAgree:
      return paint(held_words(member), shade_of(verdict), colour);
    case Verdict::kDisagree:
      return paint(exceeded_words(member.exceeded()), shade_of(verdict), colour);
    case Verdict::kUnresolved:
      return paint("unresolved", shade_of(verdict), colour) + ": " + unresolved_words(member);
    case Verdict::kFailed:
      return paint("failed", shade_of(verdict), colour) + ": " + failure_words(member);
    case Verdict::kInterrupted:
      return paint("interrupted", shade_of(verdict), colour) + ": " + interruption_words(member);
    case Verdict::kNotJudged:
      break;
  }
  std::string text = "not judged; " + why_not_judged(member);
  if (member.resolution && !member.resolution->resolved)
    text += "\nnot resolved, and that is not judged: " + unresolved_words(member);
  return text;
}

std::string verdict_line(const Report& report, bool colour) {
  if (report.study->is_work_precision) return "not judged; a work-precision study has no verdict";
  std::string text = study_words(report);
  if (report.verdict() != Verdict::kNotJudged)
    text = paint(text, shade_of(report.verdict()), colour);
  const std::size_t unresolved = count(report, Verdict::kUnresolved);
  if (unresolved > 0 && report.verdict() != Verdict::kUnresolved)
    text += fmt::format("; {} unresolved", members(unresolved));
  return text;
}

std::string verdict_cell(const Member& member) {
  if (member.refused) return "refused";
  switch (member.verdict()) {
    case Verdict::kAgree:
      return "agree";
    case Verdict::kDisagree:
      return "DISAGREE";
    case Verdict::kUnresolved:
      return "unresolved";
    case Verdict::kFailed:
      return std::ranges::count(member.engines, EngineRun::Status::kFailed, &EngineRun::status) > 1
                 ? "failed"
                 : engine_label(std::ranges::find(member.engines, EngineRun::Status::kFailed,
                                                  &EngineRun::status)
                                    ->name) +
                       " failed";
    case Verdict::kInterrupted:
      return "interrupted";
    case Verdict::kNotJudged:
      break;
  }
  return "not judged";
}

}  // namespace twincraft
