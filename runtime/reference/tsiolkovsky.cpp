// See tsiolkovsky.h. Tested by tests/runtime/reference_test.cpp.
#include "runtime/reference/tsiolkovsky.h"

#include <cmath>
#include <limits>

#include "compiler/ir/inputs.h"

namespace twincraft {

Rocket::Rocket(const Model& model) {
  const std::vector<double> times = phases(model);
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    Phase phase;
    phase.start = times[i];
    phase.mass = hub_properties(model, phase.start).mass;
    for (const Drain& tank : inputs_at(model, phase.start).tanks) phase.flow += tank.flow;
    phase.force_B = load_force(model, phase.start);
    if (i > 0) phase.before = after(phases_.back(), phase.start);
    phases_.push_back(phase);
  }
}

namespace {

/// (x + (1 - x) ln(1 - x)) / x^2, which is 1/2 + x/6 + x^2/12 + ..., of a burnt share x in [0, 1).
long double path_factor(long double x) {
  if (x > 0.25L) return (x + (1.0L - x) * std::log1p(-x)) / (x * x);
  long double power = 1.0L, sum = 0.5L;
  for (int k = 3; power > std::numeric_limits<long double>::epsilon(); ++k) {
    power *= x;
    sum += power / static_cast<long double>(k * (k - 1));
  }
  return sum;
}

}  // namespace

Rocket::Gain Rocket::after(const Phase& phase, double time) {
  // Of the burnt share x = mdot t / m: ln(m0/m1) is -log1p(-x), and t - m1/mdot ln(m0/m1) is
  // m/mdot (x + (1 - x) log1p(-x)), whose terms would cancel to x^2/2 when x is small.
  const long double t = static_cast<long double>(time) - phase.start;
  const long double x = phase.flow * t / phase.mass;
  const long double velocity = x > 0.0L ? -std::log1p(-x) / phase.flow : t / phase.mass;
  const long double position = t * t / phase.mass * path_factor(x);
  Gain gain = phase.before;
  gain.velocity += static_cast<double>(velocity) * phase.force_B;
  gain.position += static_cast<double>(t) * phase.before.velocity +
                   static_cast<double>(position) * phase.force_B;
  return gain;
}

Rocket::Gain Rocket::at(double time) const {
  std::size_t phase = 0;
  while (phase + 1 < phases_.size() && phases_[phase + 1].start <= time) ++phase;
  return after(phases_[phase], time);
}

std::vector<Deviation> tsiolkovsky_deviations(const Model& model,
                                              std::span<const Observation> samples) {
  const Rocket rocket(model);
  const Observation& start = samples.front();
  Deviation velocity{.metric = "velocity_m_s"};
  Deviation position{.metric = "position_m"};
  Deviation relative{.metric = "delta_v_relative"};
  for (const Observation& sample : samples) {
    const Rocket::Gain gain = rocket.at(sample.time);
    const double off = (sample.v_CN_N - start.v_CN_N - start.q_BN * gain.velocity).norm();
    const Vector3d r = start.r_BN_N + sample.time * start.v_BN_N + start.q_BN * gain.position;
    velocity.see(off, sample.time);
    position.see((sample.r_BN_N - r).norm(), sample.time);
    if (gain.velocity.norm() > 0.0) relative.see(off / gain.velocity.norm(), sample.time);
  }
  return {relative, velocity, position};
}

}  // namespace twincraft
