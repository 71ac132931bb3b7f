#include "runtime/study/resolve.h"

#include <fmt/format.h>

#include <algorithm>

namespace twincraft {
namespace {

using Status = EngineRun::Status;

RunShown shown(const EngineRun& run, const MotionRecord& record) {
  const Trajectory& trajectory = run.trajectory;
  const auto steps = static_cast<double>(std::max(1L, trajectory.counts.accepted));
  return {&record, trajectory.instants, trajectory.t_end, trajectory.t_end / steps,
          trajectory.accepted};
}

void explain(const Model& model, const Inspection& inspection, const MotionRecord& record,
             EngineRun& run, Member& member) {
  const Resolution why = explain_failure(model, inspection, shown(run, record));
  run.reason = fmt::format("stopped at t = {:.9g} s: {}", run.trajectory.t_end,
                           why.reasons.empty() ? run.reason : why.reasons.front());
  if (!member.resolution || member.resolution->reasons.empty()) member.resolution = why;
}

}  // namespace

void judge_member(const Model& model, const Inspection& inspection,
                  std::span<const MotionRecord* const> records, Member& member) {
  std::vector<const OwnEnergy*> energies;
  for (std::size_t i = 0; i < records.size(); ++i) {
    EngineRun& run = member.engines[i];
    run.own_energy = figures_of(records[i]->energy());
    if (run.status == Status::kFailed) explain(model, inspection, *records[i], run, member);
    if (run.status == Status::kOk) energies.push_back(&records[i]->energy());
  }
  if (member.failed()) return;
  for (std::size_t i = 0; i < records.size() && !member.resolution; ++i)
    if (member.engines[i].status == Status::kOk)
      member.resolution =
          judge_resolution(model, inspection, shown(member.engines[i], *records[i]), energies);
}

}  // namespace twincraft
