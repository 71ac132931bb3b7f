// Balances and what they are relative to. Tested by tests/runtime/conservation_test.cpp.
#include "runtime/study/conservation.h"

#include <cmath>

#include "runtime/study/agreement.h"

namespace twincraft {
namespace {

// Below this share of the kinetic energy a total is a difference of large terms, not a scale.
constexpr double kCancelled = 1.0e-6;

double relative(double imbalance, double scale) {
  return imbalance == 0.0 ? 0.0 : imbalance / scale;
}

struct Scales {
  Peak energy, kinetic, momentum, H;

  explicit Scales(const Trajectory& trajectory) {
    for (const Observation& sample : trajectory.samples) {
      energy.see(std::abs(sample.kinetic + sample.potential), sample.time);
      kinetic.see(sample.kinetic, sample.time);
      momentum.see(sample.momentum_scale, sample.time);
      H.see(sample.H_scale, sample.time);
    }
  }

  double energy_scale() const {
    return energy.maximum < kCancelled * kinetic.maximum ? kinetic.maximum : energy.maximum;
  }
};

}  // namespace

Conservation conservation_of(const Trajectory& trajectory) {
  if (trajectory.samples.empty()) return {};
  const Observation& start = trajectory.samples.front();
  Peak energy, momentum, angular_momentum;
  for (std::size_t i = 0; i < trajectory.samples.size(); ++i) {
    const Observation& now = trajectory.samples[i];
    const Books& books = trajectory.books[i];
    // Change first, then the books: the totals may be far larger than either.
    const double gained = (now.kinetic - start.kinetic) + (now.potential - start.potential);
    energy.see(std::abs(gained - books.work), now.time);
    momentum.see((now.momentum - start.momentum - books.impulse_N).norm(), now.time);
    angular_momentum.see((now.H_PntC_N - start.H_PntC_N - books.angular_impulse_N).norm(),
                         now.time);
  }
  const Scales scales(trajectory);
  return {relative(energy.maximum, scales.energy_scale()),
          relative(momentum.maximum, scales.momentum.maximum),
          relative(angular_momentum.maximum, scales.H.maximum)};
}

}  // namespace twincraft
