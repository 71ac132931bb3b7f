#include "runtime/linear/motion_record.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compiler/analysis/truth.h"
#include "runtime/engine/measure.h"

namespace twincraft {
namespace {

constexpr std::size_t kJumps = 8;

// An exchange below this part of the kinetic and stored energy is no measure of a drift.
constexpr double kExchanged = 1.0e-6;

std::optional<KeplerOrbit> orbit_of(const Model& model, const Observation& start) {
  const double mu = model.gravity.mu;
  if (mu == 0.0 || model.gravity.bsm == GravityLaw::kNone) return std::nullopt;
  if (inapplicable(ReferenceKind::kKepler, model, model.gravity.bsm)) return std::nullopt;
  return KeplerOrbit(start.r_CN_N, start.v_CN_N, mu);
}

double norm_of_halves(const std::vector<Extent>& spans) {
  double sum = 0.0;
  for (const Extent& span : spans) sum += span.half() * span.half();
  return std::sqrt(sum);
}

void see(std::vector<Extent>& spans, const Vector3d& value) {
  for (std::size_t i = 0; i < 3; ++i) spans[i].see(value[static_cast<Eigen::Index>(i)]);
}

}  // namespace

void Extent::see(double value) {
  least = seen ? std::min(least, value) : value;
  greatest = seen ? std::max(greatest, value) : value;
  seen = true;
}

void OwnEnergy::see(const Observation& sample, const Books& books) {
  if (!started_) {
    kinetic_ = sample.own_kinetic;
    springs_ = sample.springs;
    work_ = books.own_work;
    started_ = true;
  }
  springs_span_.see(sample.springs);
  work_span_.see(books.own_work);
  largest_ = std::max(largest_, sample.own_kinetic + sample.springs);
  const double drift = std::abs(drift_of(sample, books));
  if (!(drift <= drift_)) drift_ = drift;  // NaN stays
}

double OwnEnergy::drift_of(const Observation& sample, const Books& books) const {
  return (sample.own_kinetic - kinetic_) + (sample.springs - springs_) - (books.own_work - work_);
}

double OwnEnergy::exchanged() const {
  return 2.0 * std::max(springs_span_.half(), work_span_.half());
}

bool OwnEnergy::is_exchanging() const { return exchanged() > kExchanged * largest_; }

double OwnEnergy::relative() const {
  const double scale = std::max(exchanged(), kExchanged * largest_);
  return drift_ == 0.0 ? 0.0 : drift_ / scale;
}

MotionRecord::MotionRecord(const Model& model, std::vector<double> events)
    : model_(model),
      events_(std::move(events)),
      joints_(events_.size() + 1, std::vector<Extent>(model.assembly.links.size() - 1)),
      samples_(events_.size() + 1),
      rates_(3),
      center_(3),
      joint_rates_(model.assembly.links.size() - 1) {
  jumps_.resize(joint_rates_.size() + 1);
}

std::size_t MotionRecord::stretch_of(double time) const {
  const double late = time + time_tolerance(time);
  return static_cast<std::size_t>(std::upper_bound(events_.begin(), events_.end(), late) -
                                  events_.begin());
}

void MotionRecord::see(const Observation& sample, const Books& books) {
  if (!first_) {
    first_ = sample;
    kepler_ = orbit_of(model_, sample);
    energy_0_ = sample.kinetic + sample.potential;
  }
  const std::size_t stretch = stretch_of(sample.time);
  ++samples_[stretch];
  for (std::size_t joint = 0; joint < sample.joint_position.size(); ++joint) {
    joints_[stretch][joint].see(sample.joint_position[joint]);
    joint_rates_[joint].see(sample.joint_rate[joint]);
    if (model_.assembly.links[joint + 1].joint.kind == JointKind::kHinge)
      hinge_rate_ = std::max(hinge_rate_, std::abs(sample.joint_rate[joint]));
  }
  twincraft::see(rates_, sample.omega_BN_B);
  twincraft::see(center_, sample.r_CN_N);
  largest_rate_ = std::max(largest_rate_, sample.omega_BN_B.norm());
  distance_ = std::max(distance_, sample.r_CN_N.norm());
  excursion_ = std::max(excursion_, principal_angle(first_->q_BN, sample.q_BN));
  energy_.see(sample, books);
  if (model_.gravity.mu != 0.0) see_orbit(sample, books);
  if (last_) see_jumps(sample);
  last_ = sample;
}

void MotionRecord::see_orbit(const Observation& sample, const Books& books) {
  const double r = sample.r_CN_N.norm();
  orbit_rate_ = std::max(orbit_rate_, sample.r_CN_N.cross(sample.v_CN_N).norm() / (r * r));
  if (kepler_) {
    const Vector3d truth = kepler_->at(sample.time - first_->time).r;
    const double error = (sample.r_CN_N - truth).norm();
    if (!(error <= kepler_error_)) kepler_error_ = error;
  }
  // The balance of the orbit's energy alone: what the vehicle's own motion lost is not its.
  const double energy = sample.mass * (0.5 * sample.v_CN_N.squaredNorm() - model_.gravity.mu / r);
  const double drift =
      sample.kinetic + sample.potential - energy_0_ - books.work - energy_.drift_of(sample, books);
  const double loss = std::abs(drift / energy);
  if (last_) orbit_drift_ += 0.5 * (loss + last_loss_) * (sample.time - last_->time);
  last_loss_ = loss;
}

void MotionRecord::see_jumps(const Observation& sample) {
  const Observation& before = *last_;
  for (std::size_t joint = 0; joint < sample.joint_rate.size(); ++joint)
    see_jump(joint, std::abs(sample.joint_rate[joint] - before.joint_rate[joint]));
  see_jump(sample.joint_rate.size(), (sample.omega_BN_B - before.omega_BN_B).norm());
}

void MotionRecord::see_jump(std::size_t rate, double size) {
  std::vector<Jump>& kept = jumps_[rate];
  const std::size_t room = 1 + kJumps / jumps_.size();
  if (!(size > 0.0) || (kept.size() == room && size <= kept.back().size)) return;
  if (kept.size() == room) kept.pop_back();
  const auto at =
      std::find_if(kept.begin(), kept.end(), [size](const Jump& jump) { return jump.size < size; });
  kept.insert(at, {size, *last_});
}

std::vector<Observation> MotionRecord::jumps() const {
  std::vector<std::pair<double, const Jump*>> ranked;
  for (std::size_t rate = 0; rate < jumps_.size(); ++rate) {
    const bool is_joint = rate < joint_rates_.size();
    const double range = is_joint ? joint_rates_[rate].half() : rate_half_range();
    for (const Jump& jump : jumps_[rate]) ranked.emplace_back(jump.size / range, &jump);
  }
  std::ranges::stable_sort(ranked, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Observation> found;
  for (const auto& one : ranked) {
    if (found.size() == kJumps) break;
    const Observation& before = one.second->before;
    const bool is_there = std::ranges::any_of(
        found, [&before](const Observation& seen) { return seen.time == before.time; });
    if (!is_there) found.push_back(before);
  }
  std::ranges::sort(found, {}, &Observation::time);
  return found;
}

double MotionRecord::half_range(int joint) const {
  Extent span;
  for (const std::vector<Extent>& stretch : joints_) {
    const Extent& there = stretch[static_cast<std::size_t>(joint)];
    if (!there.seen) continue;
    span.see(there.least);
    span.see(there.greatest);
  }
  return span.half();
}

std::optional<double> MotionRecord::half_range(int joint, double time) const {
  const std::size_t stretch = stretch_of(time);
  if (samples_[stretch] < 3) return std::nullopt;
  return joints_[stretch][static_cast<std::size_t>(joint)].half();
}

double MotionRecord::rate_half_range() const { return norm_of_halves(rates_); }

double MotionRecord::travel() const { return norm_of_halves(center_); }

double MotionRecord::drift_in_orbit() const {
  if (!first_) return 0.0;
  const double mu = model_.gravity.mu;
  const double inverse_a = 2.0 / first_->r_CN_N.norm() - first_->v_CN_N.squaredNorm() / mu;
  const double mean_motion = std::sqrt(mu * std::pow(std::abs(inverse_a), 3.0));
  return 1.5 * mean_motion * orbit_drift_;
}

}  // namespace twincraft
