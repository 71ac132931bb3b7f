// See page_series.h. Tested by tests/runtime/html_test.cpp.
#include "runtime/report/page/page_series.h"

#include <nlohmann/json.hpp>

#include "runtime/study/replay.h"

namespace twincraft {
PageSeries::PageSeries(const Model& model)
    : histories_(model), frames_{Frames(model), Frames(model)} {}

void PageSeries::take(std::size_t engine, const Observation& sample, const Books& books) {
  histories_.take(engine, sample, books);
  frames_.at(engine).take(sample);
}

void PageSeries::take_pair(const Observation& bsm, const Observation& mujoco,
                           std::span<const double> metrics) {
  histories_.take_pair(bsm, mujoco, metrics);
}

nlohmann::ordered_json histories_json(const ReportedMember& member) {
  return series_of(member)->histories().json(member.bundle.model, member.result);
}

std::shared_ptr<const PageSeries> series_of(const ReportedMember& member) {
  if (member.series) return member.series;
  auto series = std::make_shared<PageSeries>(member.bundle.model);
  const std::vector<EngineRun>& engines = member.result.engines;
  replay(member.bundle.model, {&engines.at(0).trajectory, &engines.at(1).trajectory}, *series);
  return series;
}

}  // namespace twincraft
