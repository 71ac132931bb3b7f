// See study_outputs.h.
#include "runtime/delivery/study_outputs.h"

#include "compiler/ir/engine_kind.h"
#include "runtime/campaign/requirements.h"

namespace twincraft {

void StudyOutputs::take(std::size_t engine, const Observation& sample, const Books& books) {
  if (engine == static_cast<std::size_t>(EngineKind::kBsm)) reducer_.take(sample);
  if (next_) next_->take(engine, sample, books);
}

void StudyOutputs::take_pair(const Observation& bsm, const Observation& mujoco,
                             std::span<const double> metrics) {
  if (next_) next_->take_pair(bsm, mujoco, metrics);
}

void StudyOutputs::land() {
  if (next_) next_->land();
}

void StudyOutputs::publish(ReportedMember& member) {
  const std::vector<std::optional<double>> values = reducer_.results();
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    const OutputColumn column = column_of(plan_[i]);
    member.outputs.push_back({column.name, column.unit, values[i], column.below, column.above,
                              holds(column, values[i])});
  }
  if (next_) next_->publish(member);
}

}  // namespace twincraft
