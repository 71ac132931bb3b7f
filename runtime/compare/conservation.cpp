// Balances and what they are relative to. Tested by tests/runtime/conservation_test.cpp.
#include "runtime/compare/conservation.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

const BalanceRow* find_balance(std::string_view key) {
  const auto* row = std::ranges::find(kBalances, key, &BalanceRow::key);
  return row == kBalances.end() ? nullptr : row;
}

double ConservationMeter::relative(double imbalance, double scale) {
  return imbalance == 0.0 ? 0.0 : imbalance / scale;
}

void ConservationMeter::widen_scales(const Observation& sample, const Books& books) {
  energy_scale_.see(std::abs(sample.kinetic + sample.potential), sample.time);
  kinetic_scale_.see(sample.kinetic, sample.time);
  momentum_scale_.see(sample.momentum_scale, sample.time);
  H_scale_.see(sample.H_scale, sample.time);
  impulse_scale_.see(books.impulse_N.norm(), sample.time);
}

void ConservationMeter::take(const Observation& sample, const Books& books) {
  if (!start_) start_ = Start{sample.kinetic, sample.potential, sample.momentum, sample.H_PntC_N};
  widen_scales(sample, books);
  // Change first, then the books: the totals may be far larger than either.
  const double gained = (sample.kinetic - start_->kinetic) + (sample.potential - start_->potential);
  const Vector3d momentum = sample.momentum - start_->momentum - books.impulse_N;
  const Vector3d H = sample.H_PntC_N - start_->H - books.angular_impulse_N;
  now_ = {std::abs(gained - books.work), momentum.norm(), H.norm()};
  energy_.see(now_.energy, sample.time);
  momentum_.see(now_.momentum, sample.time);
  angular_momentum_.see(now_.angular_momentum, sample.time);
}

Conservation ConservationMeter::scales() const {
  const double energy = energy_scale_.maximum < kCancelled * kinetic_scale_.maximum
                            ? kinetic_scale_.maximum
                            : energy_scale_.maximum;
  // In a vehicle at rest with wheels that spin, forces cancel and next to nothing moves.
  const double momentum = momentum_scale_.maximum > kAtRest * H_scale_.maximum
                              ? momentum_scale_.maximum
                              : H_scale_.maximum;
  // A vehicle that never turns has the rounding of forces and momenta on arms of about a metre for
  // an angular momentum.
  const double on_an_arm = std::max(impulse_scale_.maximum, momentum_scale_.maximum);
  const double H = H_scale_.maximum > kRounding * on_an_arm ? H_scale_.maximum : on_an_arm;
  return {energy, momentum, H};
}

Conservation ConservationMeter::result() const {
  const Conservation scale = scales();
  return {relative(energy_.maximum, scale.energy), relative(momentum_.maximum, scale.momentum),
          relative(angular_momentum_.maximum, scale.angular_momentum)};
}

Conservation conservation_of(const Trajectory& trajectory) {
  ConservationMeter meter;
  for (std::size_t i = 0; i < trajectory.samples.size(); ++i)
    meter.take(trajectory.samples[i], trajectory.books[i]);
  return meter.result();
}

std::optional<bool> Balance::pass() const {
  if (!tolerance) return std::nullopt;
  return maximum <= *tolerance;  // false for NaN
}

}  // namespace twincraft
