// The rules, one function each, in the order of ResolutionRule. Where the figures come from:
// docs/resolution.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>

#include "compiler/ir/number.h"
#include "runtime/engine/measure.h"
#include "runtime/linear/judge.h"

namespace twincraft {
namespace {

constexpr double kErrorLimit = 0.05;       // of a coordinate's motion
constexpr double kAttitudeLimit = 0.8;     // [deg]
constexpr double kAcceptedAttitude = 1.0;  // [deg] of an adaptive method's own estimates
constexpr double kLeastAttitude = 0.1;     // [deg] of a hub that hardly turns
constexpr double kTurnedShare = 0.03;      // of the angle turned
constexpr double kOrbitLimit = 1.0e-3;     // of the largest distance; along an orbit [rad]
constexpr double kLeastTravel = 1.0;       // [m]
constexpr double kEnergyLimit = 0.1;       // of what is exchanged
constexpr double kLeastMotion = 1.0e-6;    // [rad] or [m]: less is no motion
constexpr double kSlowest = 1.0e-3;        // a mode slower than this over the run is no mode
// Beyond this many states events are not looked at one by one: an instant costs a tenth of a
// second.
constexpr int kManyStates = 120;
constexpr std::size_t kFewStretches = 2;

const Observation* shown_at(std::span<const Observation> instants, double time) {
  const auto found =
      std::ranges::lower_bound(instants, time - time_tolerance(time), {}, &Observation::time);
  return found == instants.end() ? nullptr : &*found;
}

}  // namespace

double Judge::amplitude_of(std::size_t joint) const {
  return std::max(run_.motion->half_range(static_cast<int>(joint)), kLeastMotion);
}

Amplitudes Judge::amplitudes_at(double time) const {
  Amplitudes amplitudes;
  const std::size_t joints = model_.assembly.links.size() - 1;
  for (std::size_t joint = 0; joint < joints; ++joint) {
    if (run_.motion == nullptr) {
      amplitudes.joint_between.push_back(kLeastMotion);
      continue;
    }
    const double whole = amplitude_of(joint);
    const auto between = run_.motion->half_range(static_cast<int>(joint), time);
    amplitudes.joint_between.push_back(
        between ? std::min(whole, std::max({*between, 0.01 * whole, kLeastMotion})) : whole);
  }
  if (run_.motion != nullptr)
    amplitudes.rate =
        std::max({run_.motion->rate_half_range(), 1.0e-3 * run_.motion->largest_rate(), 1.0e-9});
  else
    amplitudes.rate = std::max(1.0e-3 * model_.initial.omega_BN_B.norm(), 1.0e-9);
  return amplitudes;
}

void Judge::see_modes(OwnMotion& motion, const Observation& seen, double inputs_at,
                      const Eigen::VectorXd& drive, bool near_empty) {
  const double slowest = kSlowest / model_.simulation.duration;
  ModalInstant instant{seen.time, !drive.isZero(0.0), near_empty,
                       decompose(motion, motion.jacobian(seen, inputs_at), drive, slowest)};
  modal_.see(motion, instant, amplitudes_at(seen.time));
}

void Judge::look_at_modes() {
  if (model_.simulation.translation) return;
  OwnMotion motion(model_);
  if (motion.size() > kMostStates) return;
  const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(motion.size());
  const std::size_t stretches = motion.size() > kManyStates
                                    ? std::min(kFewStretches, inspection_.stretches.size())
                                    : inspection_.stretches.size();
  for (std::size_t i = 0; i < stretches; ++i) {
    const double begin = inspection_.stretches[i].begin;
    const Observation* seen = shown_at(run_.instants, begin);
    if (seen == nullptr || seen->time > run_.reached) break;
    Eigen::VectorXd drive = motion.rates(*seen, begin);
    // What an event changes is what sets modes going there; at the start all that moves does.
    const double before = std::nextafter(begin, 0.0);
    if (begin > 0.0) drive -= motion.rates(*seen, before);
    see_modes(motion, *seen, begin, drive, false);
  }
  const auto look = [&](double time, bool near_empty) {
    const Observation* seen = shown_at(run_.instants, time);
    if (seen != nullptr && seen->time <= run_.reached)
      see_modes(motion, *seen, seen->time, at_rest, near_empty);
  };
  for (const double time : inspection_.before) look(time, true);
  for (const double time : inspection_.along) look(time, false);
  const bool came_far = run_.motion != nullptr && run_.motion->last() &&
                        run_.motion->last()->time <= run_.reached && run_.reached > 0.0;
  if (came_far) {
    const Observation& last = *run_.motion->last();
    const bool is_draining = drains(model_);
    const bool has_all_mass = std::ranges::all_of(
        model_.tanks, [&](const Tank& tank) { return tank.share(last.time) > 1.0e-9; });
    if (has_all_mass) see_modes(motion, last, last.time, at_rest, is_draining);
  }
}

std::vector<Judge::Probe> Judge::made_probes() const {
  std::vector<Observation> where;
  for (const double time : inspection_.probes)
    if (const Observation* seen = shown_at(run_.instants, time)) where.push_back(*seen);
  if (run_.motion != nullptr) std::ranges::copy(run_.motion->jumps(), std::back_inserter(where));
  std::ranges::sort(where, {}, &Observation::time);
  Prober prober(model_);
  std::vector<Probe> probes;
  for (const Observation& seen : where) {
    const auto next = std::ranges::upper_bound(inspection_.events, seen.time + 1.0e-9 * step_);
    const double end = next == inspection_.events.end() ? model_.simulation.duration : *next;
    const bool is_twice = !probes.empty() && seen.time - probes.back().time < 0.5 * step_;
    if (is_twice || seen.time + step_ > end + 1.0e-9 * step_ || seen.time > run_.reached) continue;
    probes.push_back({seen.time, prober.probe(seen, step_)});
  }
  return probes;
}

/// Each probe stands for the steps until the next.
double Judge::summed(const std::vector<Probe>& probes,
                     const std::function<double(const LocalError&)>& part) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const bool is_last = i + 1 == probes.size();
    const double next = is_last ? model_.simulation.duration : probes[i + 1].time;
    sum += (next - probes[i].time) / step_ * part(probes[i].error);
  }
  return sum;
}

void Judge::look_at_probes() {
  const std::vector<Probe> probes = made_probes();
  if (probes.empty()) return;
  if (!model_.simulation.translation) {
    judge_attitude(probes);
    judge_joints(probes);
  }
  if (model_.gravity.mu == 0.0) judge_center(probes);
}

void Judge::judge_attitude(const std::vector<Probe>& probes) {
  const double turned =
      run_.motion != nullptr ? kDegrees * run_.motion->attitude_excursion() : 180.0;
  const double limit = std::min(kAttitudeLimit, std::max(kLeastAttitude, kTurnedShare * turned));
  const double error =
      kDegrees * summed(probes, [](const LocalError& local) { return local.attitude; });
  attitude_deg_ = error;
  advise_from(error, limit);
  if (error <= limit) return;
  const double rate =
      run_.motion != nullptr ? run_.motion->largest_rate() : model_.initial.omega_BN_B.norm();
  findings_.push_back(
      {ResolutionRule::kAttitude, error / limit, "rotation", std::nullopt,
       fmt::format("the vehicle turns {:.2g} rad per step, attitude errs by about {:.2g} deg "
                   "(limit {:.2g} deg)",
                   rate * step_, error, limit)});
}

void Judge::judge_joints(const std::vector<Probe>& probes) {
  if (run_.motion == nullptr) return;
  for (std::size_t joint = 0; joint + 1 < model_.assembly.links.size(); ++joint) {
    const double error =
        summed(probes, [joint](const LocalError& local) { return local.joint[joint]; }) /
        amplitude_of(joint);
    note_joint(ResolutionRule::kProbes, joint, error, "what its steps get wrong adds up to");
    advise_from(error, kErrorLimit);
  }
}

void Judge::note_joint(ResolutionRule rule, std::size_t joint, double error,
                       std::string_view what) {
  if (error > worst_error_) {
    worst_error_ = error;
    worst_coordinate_ = joint_name(model_, joint);
  }
  if (error <= kErrorLimit) return;
  findings_.push_back(
      {rule, error / kErrorLimit, joint_name(model_, joint), error,
       fmt::format("{}: {} {} of its motion (limit {:.0f} %)", joint_name(model_, joint), what,
                   loss_words(error), 100.0 * kErrorLimit)});
}

void Judge::judge_center(const std::vector<Probe>& probes) {
  const double travel =
      std::max(kLeastTravel, run_.motion != nullptr ? run_.motion->travel() : 0.0);
  const double error =
      summed(probes, [](const LocalError& local) { return local.center; }) / travel;
  advise_from(error, kErrorLimit);
  if (error <= kErrorLimit) return;
  findings_.push_back({ResolutionRule::kTranslation, error / kErrorLimit, "", error,
                       fmt::format("the centre of mass errs by about {:.2g} m of {:.2g} m",
                                   error * travel, travel)});
}

void Judge::judge_orbit() {
  if (model_.gravity.mu == 0.0) return;
  const MotionRecord& motion = *run_.motion;
  const bool is_kepler = motion.is_kepler();
  const double error =
      is_kepler ? motion.kepler_error() / motion.largest_distance() : motion.drift_in_orbit();
  advise_from(error, kOrbitLimit);
  if (error <= kOrbitLimit) return;
  const double metres = error * motion.largest_distance();
  findings_.push_back(
      {ResolutionRule::kTranslation, error / kOrbitLimit, "orbit", error,
       fmt::format("the centre of mass is {} {:.2g} km off its orbit: {} at {} s takes {:.2g} rad "
                   "of it in a step",
                   is_kepler ? "" : "about", 1.0e-3 * metres, tableau_of(method()).name,
                   shortest(step_), motion.fastest_orbit_rate() * step_)});
}

void Judge::judge_turning() {
  const double rate = std::max(run_.motion->largest_rate(), run_.motion->largest_hinge_rate());
  const double turn = rate * step_;
  if (turn <= std::numbers::pi) return;
  advised_ = std::min(advised_, 0.5 / rate);
  findings_.push_back({ResolutionRule::kRotation, turn / std::numbers::pi, "rotation", std::nullopt,
                       fmt::format("the vehicle or a hinge turns {:.2g} rad in a step, more than "
                                   "half a turn",
                                   turn)});
}

void Judge::judge_energy(std::span<const OwnEnergy* const> energies) {
  if (drains(model_)) return;  // what leaves takes energy along that no exchange measures
  for (const OwnEnergy* energy : energies) {
    const double lost = energy->relative();
    if (lost <= kEnergyLimit || !energy->is_exchanging()) continue;
    advised_ = std::min(advised_, 0.5 * step_);
    findings_.push_back({ResolutionRule::kEnergy, lost / kEnergyLimit, "", lost,
                         fmt::format("the energy of the vehicle's own motion is off by {:.2g} J, "
                                     "{} of what is exchanged (limit {:.0f} %)",
                                     energy->drift(), loss_words(lost), 100.0 * kEnergyLimit)});
    return;
  }
}

void Judge::look_at_motion(std::span<const OwnEnergy* const> energies) {
  judge_orbit();
  if (model_.simulation.translation) return;
  if (!is_adaptive(model_)) judge_turning();
  judge_energy(energies);
}

void Judge::look_at_accepted_errors() {
  const double attitude = kDegrees * run_.accepted.attitude;
  attitude_deg_ = attitude;
  tolerance_factor_ = std::max(tolerance_factor_, attitude / kAcceptedAttitude);
  if (attitude > kAcceptedAttitude)
    findings_.push_back({ResolutionRule::kAdaptive, attitude / kAcceptedAttitude, "rotation",
                         std::nullopt,
                         fmt::format("the errors that the tolerance lets pass turn the hub by "
                                     "{:.2g} deg (limit {:.0f} deg)",
                                     attitude, kAcceptedAttitude)});
  for (std::size_t joint = 0; joint < run_.accepted.joint.size(); ++joint) {
    const double error = run_.accepted.joint[joint] / amplitude_of(joint);
    tolerance_factor_ = std::max(tolerance_factor_, error / kErrorLimit);
    note_joint(ResolutionRule::kAdaptive, joint, error,
               "the errors that the tolerance lets pass add up to");
  }
}

}  // namespace twincraft
