// Balances and what they are relative to. Tested by tests/runtime/conservation_test.cpp.
#include "runtime/study/conservation.h"

#include <algorithm>
#include <cmath>

#include "runtime/study/agreement.h"

namespace twincraft {
namespace {

// Below this share of the kinetic energy a total is a difference of large terms, not a scale.
constexpr double kCancelled = 1.0e-6;
// Below this share of the angular momentum on an arm of 1 m a momentum is no scale: it is that of
// token masses, or so small that the rounding of what a fast wheel's rim exchanges (m Omega^2 r of
// a wheel off the axis, before it cancels) is as large as what is balanced.
constexpr double kAtRest = 1.0e-5;
// Below this share of impulse or momentum on an arm of 1 m an angular momentum is rounding.
constexpr double kRounding = 1.0e-12;

double relative(double imbalance, double scale) {
  return imbalance == 0.0 ? 0.0 : imbalance / scale;
}

struct Scales {
  Peak energy, kinetic, momentum, H, impulse;

  explicit Scales(const Trajectory& trajectory) {
    for (const Observation& sample : trajectory.samples) {
      energy.see(std::abs(sample.kinetic + sample.potential), sample.time);
      kinetic.see(sample.kinetic, sample.time);
      momentum.see(sample.momentum_scale, sample.time);
      H.see(sample.H_scale, sample.time);
    }
    for (const Books& books : trajectory.books) impulse.see(books.impulse_N.norm(), 0.0);
  }

  double energy_scale() const {
    return energy.maximum < kCancelled * kinetic.maximum ? kinetic.maximum : energy.maximum;
  }

  /// In a vehicle at rest with wheels that spin, forces cancel and next to nothing moves.
  double momentum_scale() const {
    return momentum.maximum > kAtRest * H.maximum ? momentum.maximum : H.maximum;
  }

  /// A vehicle that never turns has the rounding of forces and momenta on arms of about a metre for
  /// an angular momentum.
  double angular_scale() const {
    const double on_an_arm = std::max(impulse.maximum, momentum.maximum);
    return H.maximum > kRounding * on_an_arm ? H.maximum : on_an_arm;
  }
};

}  // namespace

ConservationCurve::ConservationCurve(const Trajectory& trajectory) : trajectory_(&trajectory) {
  const Scales scales(trajectory);
  energy_scale_ = scales.energy_scale();
  momentum_scale_ = scales.momentum_scale();
  H_scale_ = scales.angular_scale();
}

Conservation ConservationCurve::at(std::size_t sample) const {
  const Observation& start = trajectory_->samples.front();
  const Observation& now = trajectory_->samples[sample];
  const Books& books = trajectory_->books[sample];
  // Change first, then the books: the totals may be far larger than either.
  const double gained = (now.kinetic - start.kinetic) + (now.potential - start.potential);
  const Vector3d momentum = now.momentum - start.momentum - books.impulse_N;
  const Vector3d H = now.H_PntC_N - start.H_PntC_N - books.angular_impulse_N;
  return {relative(std::abs(gained - books.work), energy_scale_),
          relative(momentum.norm(), momentum_scale_), relative(H.norm(), H_scale_)};
}

Conservation conservation_of(const Trajectory& trajectory) {
  if (trajectory.samples.empty()) return {};
  const ConservationCurve curve(trajectory);
  Peak energy, momentum, angular_momentum;
  for (std::size_t i = 0; i < trajectory.samples.size(); ++i) {
    const Conservation now = curve.at(i);
    energy.see(now.energy, trajectory.samples[i].time);
    momentum.see(now.momentum, trajectory.samples[i].time);
    angular_momentum.see(now.angular_momentum, trajectory.samples[i].time);
  }
  return {energy.maximum, momentum.maximum, angular_momentum.maximum};
}

std::optional<bool> Balance::pass() const {
  if (!tolerance) return std::nullopt;
  return maximum <= *tolerance;  // false for NaN
}

}  // namespace twincraft
