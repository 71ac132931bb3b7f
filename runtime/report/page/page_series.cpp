// See page_series.h. Tested by tests/runtime/html_test.cpp.
#include "runtime/report/page/page_series.h"

#include <nlohmann/json.hpp>

#include "runtime/compare/pairing.h"

namespace twincraft {
namespace {

/// The samples that a member kept, as if it were flown again.
void replay(const ReportedMember& member, PageSeries& series) {
  AgreementMeter meter(metric_laws(member.bundle.model));
  Pairing pairing([&](const Observation& a, const Observation& b) {
    meter.take(a, b);
    series.take_pair(a, b, meter.now());
  });
  const std::vector<EngineRun>& engines = member.result.engines;
  const auto left = [&engines](std::size_t engine, std::size_t i) {
    return i < engines[engine].trajectory.samples.size();
  };
  for (std::size_t i = 0; left(0, i) || left(1, i); ++i)
    for (const std::size_t engine : {0U, 1U}) {
      if (!left(engine, i)) continue;
      const Trajectory& trajectory = engines[engine].trajectory;
      series.take(engine, trajectory.samples[i], trajectory.books[i]);
      pairing.add(engine, trajectory.samples[i]);
    }
}

}  // namespace

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
  replay(member, *series);
  return series;
}

}  // namespace twincraft
