// See replay.h. Tested by tests/runtime/html_test.cpp and tests/runtime/delivery_test.cpp.
#include "runtime/study/replay.h"

#include "runtime/compare/pairing.h"

namespace twincraft {

void replay(const Model& model, const std::array<const Trajectory*, 2>& trajectories,
            MemberWatch& watch) {
  AgreementMeter meter(metric_laws(model));
  Pairing pairing([&](const Observation& a, const Observation& b) {
    meter.take(a, b);
    watch.take_pair(a, b, meter.now());
  });
  const auto left = [&trajectories](std::size_t engine, std::size_t i) {
    return i < trajectories[engine]->samples.size();
  };
  for (std::size_t i = 0; left(0, i) || left(1, i); ++i)
    for (const std::size_t engine : {0U, 1U}) {
      if (!left(engine, i)) continue;
      const Trajectory& trajectory = *trajectories[engine];
      watch.take(engine, trajectory.samples[i], trajectory.books[i]);
      pairing.add(engine, trajectory.samples[i]);
    }
}

}  // namespace twincraft
