// See samples.h.
#include "runtime/simulate/samples.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "runtime/engine/engine.h"
#include "runtime/reference/stored.h"

namespace twincraft {
namespace {

// No wheel, hinge or hub turns a hundred million radians a second, nothing outruns light, and no
// slide is longer than a thousand kilometres: such a state is finite and still no motion.
constexpr double kAbsurdRate = 1.0e8;          // [rad/s]
constexpr double kAbsurdSpeed = 2.998e8;       // [m/s]
constexpr double kAbsurdDisplacement = 1.0e6;  // [m]

/// Fine whatever the coordinates measure, as nearly every state is.
bool is_moderate(std::span<const double> state, const StateLayout& layout) {
  static_assert(kAbsurdDisplacement < kAbsurdRate && kAbsurdDisplacement < kAbsurdSpeed);
  const double* from = state.data() + StateLayout::velocity();  // an attitude is small
  const double* to = state.data() + layout.size();
  return std::transform_reduce(from, to, from, 0.0) < kAbsurdDisplacement * kAbsurdDisplacement;
}

}  // namespace

bool SampleTimes::at(double landing) const {
  return landing >= next_ - tolerance_ || is_stored_time(model_.stored, landing);
}

void SampleTimes::taken(double landing) {
  const double interval = model_.simulation.record;
  count_ += 1.0;  // as a rule, and a quotient is a hundredth of a small recorded step
  if (count_ * interval <= landing + tolerance_ || (count_ - 1.0) * interval > landing + tolerance_)
    count_ = std::floor((landing + tolerance_) / interval) + 1.0;
  next_ = count_ * interval;
}

void refuse_absurd(std::span<const double> state, const StateLayout& layout, const Model& model) {
  if (is_moderate(state, layout)) return;
  Observation seen;
  unpack(state, layout, seen);
  const auto refuse = [](const std::string& name, double value, std::string_view unit) {
    throw NumericalFailure(fmt::format("`{}` is absurd: {:.3g} {}", name, value, unit));
  };
  if (!(seen.omega_BN_B.squaredNorm() < kAbsurdRate * kAbsurdRate))
    refuse("omega_BN_B", seen.omega_BN_B.norm(), "rad/s");
  if (!(seen.v_BN_N.squaredNorm() < kAbsurdSpeed * kAbsurdSpeed))
    refuse("v_BN_N", seen.v_BN_N.norm(), "m/s");
  for (const Coordinate& coordinate : model.coordinates) {
    const CoordinateQuantity& quantity = coordinate.quantity();
    const bool slides = coordinate.is_length();
    const double rate = rate_of(coordinate, seen);
    if (!(std::abs(rate) < (slides ? kAbsurdSpeed : kAbsurdRate)))
      refuse(coordinate.name + ".rate", rate, quantity.rate_unit);
    if (slides && !(std::abs(position_of(coordinate, seen)) < kAbsurdDisplacement))
      refuse(coordinate.name + ".position", position_of(coordinate, seen), quantity.unit);
  }
}

}  // namespace twincraft
