// See samples.h.
#include "runtime/simulate/samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/engine/engine.h"
#include "runtime/reference/stored.h"

namespace twincraft {
namespace {

// No wheel, hinge or hub turns a hundred million radians a second, nothing outruns light, and no
// slide is longer than a thousand kilometres: such a state is finite and still no motion.
constexpr double kAbsurdRate = 1.0e8;          // [rad/s]
constexpr double kAbsurdSpeed = 2.998e8;       // [m/s]
constexpr double kAbsurdDisplacement = 1.0e6;  // [m]

bool are_below(const std::vector<double>& values, double bound) {
  return std::ranges::all_of(values, [bound](double value) { return std::abs(value) < bound; });
}

/// Fine whatever the coordinates measure, as nearly every sample is.
bool is_moderate(const Observation& seen) {
  return are_below(seen.joint_position, kAbsurdDisplacement) &&
         are_below(seen.joint_rate, kAbsurdRate) && are_below(seen.wheel_rate, kAbsurdRate);
}

}  // namespace

bool SampleTimes::at(double landing) const {
  return landing >= next_ - tolerance_ || is_stored_time(model_.stored, landing);
}

void SampleTimes::taken(double landing) {
  const double interval = model_.simulation.record;
  next_ = (std::floor((landing + tolerance_) / interval) + 1.0) * interval;
}

void refuse_absurd(const Observation& seen, const Model& model) {
  const auto refuse = [](const std::string& name, double value, std::string_view unit) {
    throw NumericalFailure(fmt::format("`{}` is absurd: {:.3g} {}", name, value, unit));
  };
  if (!(seen.omega_BN_B.squaredNorm() < kAbsurdRate * kAbsurdRate))
    refuse("omega_BN_B", seen.omega_BN_B.norm(), "rad/s");
  if (!(seen.v_BN_N.squaredNorm() < kAbsurdSpeed * kAbsurdSpeed))
    refuse("v_BN_N", seen.v_BN_N.norm(), "m/s");
  if (is_moderate(seen)) return;
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
