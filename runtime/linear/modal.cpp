#include "runtime/linear/modal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "compiler/ir/number.h"
#include "runtime/linear/amplification.h"

namespace twincraft {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr double kMargin = 0.9;          // of the stability limit: rates change along a run
constexpr double kErrorLimit = 0.05;     // of a coordinate's motion
constexpr double kUnstable = 1.0e9;      // severity: graver than any loss
constexpr double kLittleDamping = 0.02;  // euler and rk2 are unstable below it, if slowly
constexpr double kGrowth = 7.0;          // e-foldings over the run that such a mode may not have
constexpr double kSwings = 0.5;          // a hub rate is judged by modes that swing
constexpr double kDamped = 0.7;
// What the advice aims at: well inside the limits, so that the advised run is resolved.
constexpr double kAdvisedMargin = 0.5;
constexpr double kAdvisedError = 0.01;
constexpr double kCarries = 0.005;  // of a coordinate's motion: a mode that counts

std::string mode_words(const Mode& mode) {
  const double zeta = mode.damping_ratio();
  if (zeta > 0.999) return fmt::format("is damped at {:.3g} 1/s", mode.rate());
  std::string words = mode.is_rotation ? fmt::format("nutates at {:.3g} rad/s", mode.rate())
                                       : fmt::format("swings at {:.3g} rad/s", mode.rate());
  if (zeta > 5.0e-4) return words + fmt::format(", damped {:.2g} %", 100.0 * zeta);
  return words + ", undamped";
}

std::string subject(const std::string& coordinate) {
  return coordinate == "rotation" ? "the hub" : coordinate;
}

double carried(const Mode& mode, int entry) {
  const double share = std::abs(mode.shape[entry] * mode.weight / mode.s);
  return mode.is_pair() ? 2.0 * share : share;
}

}  // namespace

ModalJudge::ModalJudge(const Model& model, double step)
    : tableau_(tableau_of(model.simulation.method)),
      step_(step),
      duration_(model.simulation.duration),
      is_low_order_(tableau_.order < 4),
      stable_(kInfinity),
      advised_(kInfinity) {}

void ModalJudge::see(const OwnMotion& motion, const ModalInstant& instant,
                     const Amplitudes& amplitudes) {
  for (const Mode& mode : instant.modes) {
    note_fastest(mode);
    judge_stability(instant, mode);
  }
  if (instant.is_driven) judge_errors(motion, instant, amplitudes);
}

void ModalJudge::note_fastest(const Mode& mode) {
  if (fastest_ && mode.rate() <= fastest_->rate) return;
  const double zeta = mode.damping_ratio();
  const char* kind = zeta > kDamped ? "damped" : mode.is_rotation ? "rotation" : "undamped";
  fastest_ = {mode.coordinate, mode.rate(), std::max(0.0, zeta), kind};
}

void ModalJudge::judge_stability(const ModalInstant& instant, const Mode& mode) {
  const double growth = std::log(std::abs(amplification(tableau_, step_ * mode.s)));
  const double true_growth = std::max(0.0, step_ * mode.s.real());
  const bool is_true_growth = mode.s.real() > 0.0;
  const double rate = mode.rate();
  const double limit = stability_limit(tableau_, is_true_growth ? Complex(0.0, rate) : mode.s);
  // Growth of a tenth over the run, for the methods that always grow a little.
  const bool grows_slowly =
      is_low_order_ && !is_true_growth && mode.damping_ratio() < kLittleDamping;
  double stable = limit / rate;
  if (grows_slowly) {
    const double per_run = 1.0 / (rate * duration_);
    stable = (tableau_.order == 1 ? 0.2 * per_run : std::cbrt(0.8 * per_run)) / rate;
  }
  const double steps = std::max(1.0, (duration_ - instant.time) / step_);
  const bool fails = grows_slowly ? growth * steps > kGrowth : step_ * rate > kMargin * limit;
  if (fails && instant.time <= destroyed_ && growth - true_growth > worst_growth_) {
    worst_growth_ = growth - true_growth;
    destroyer_ = Finding{ResolutionRule::kStability, kUnstable, mode.coordinate, std::nullopt,
                         stability_words(instant, mode, stable)};
  }
  if (is_true_growth) return;
  all_.push_back(mode.s);
  stable_ = std::min(stable_, stable);
  advised_ = std::min(advised_, grows_slowly ? stable : kAdvisedMargin * limit / rate);
  if (fails)
    findings_.push_back({ResolutionRule::kStability, kUnstable * (1.0 + step_ * rate),
                         mode.coordinate, std::nullopt, stability_words(instant, mode, stable)});
}

std::string ModalJudge::stability_words(const ModalInstant& instant, const Mode& mode,
                                        double stable) const {
  std::string when;
  if (instant.time > 0.0) when = fmt::format(" at t = {:.9g} s", instant.time);
  if (instant.near_empty) when += ", its tank near empty";
  return fmt::format("{} {}{}: {} is stable below {:.3g} s, the step is {} s",
                     subject(mode.coordinate), mode_words(mode), when, tableau_.name, stable,
                     shortest(step_));
}

void ModalJudge::judge_errors(const OwnMotion& motion, const ModalInstant& instant,
                              const Amplitudes& amplitudes) {
  std::vector<double> errors;
  for (const Mode& mode : instant.modes)
    errors.push_back(mode_error(tableau_, mode.s, step_, duration_ - instant.time));
  for (int entry = 0; entry < motion.joints() + 3; ++entry)
    judge_error(motion, instant, entry, amplitudes, errors);
}

void ModalJudge::judge_error(const OwnMotion& motion, const ModalInstant& instant, int entry,
                             const Amplitudes& amplitudes, const std::vector<double>& errors) {
  const bool is_joint = entry < motion.joints();
  double error = 0.0, excited = 0.0, largest = -1.0;
  const Mode* worst = nullptr;
  for (std::size_t k = 0; k < instant.modes.size(); ++k) {
    const Mode& mode = instant.modes[k];
    if (!is_joint && mode.damping_ratio() >= kSwings) continue;
    const double part = carried(mode, entry);
    excited += part;
    error += part * errors[k];
    if (part * errors[k] <= largest) continue;
    largest = part * errors[k];
    worst = &mode;
  }
  if (worst == nullptr) return;
  const auto joint = static_cast<std::size_t>(entry);
  const double moved = is_joint ? amplitudes.joint_between[joint] : amplitudes.rate;
  const double amplitude = std::max(moved, excited);
  const double relative = error / amplitude;
  for (const Mode& mode : instant.modes) {
    if (!is_joint && mode.damping_ratio() >= kSwings) continue;
    if (carried(mode, entry) / amplitude <= kCarries) continue;
    const double remaining = duration_ - instant.time;
    excited_.push_back({mode.s, remaining});
  }
  if (!(relative > kErrorLimit)) return;
  const std::string& name = motion.coordinate(entry);
  findings_.push_back({ResolutionRule::kModalError, relative / kErrorLimit, name, relative,
                       error_words(instant, *worst, name, relative)});
}

std::string ModalJudge::error_words(const ModalInstant& instant, const Mode& mode,
                                    const std::string& name, double error) const {
  const double period = 2.0 * std::numbers::pi / std::abs(mode.s.imag());
  std::string text = fmt::format("{} {}", subject(mode.coordinate), mode_words(mode));
  if (instant.time > 0.0) text += fmt::format(" from t = {:.9g} s", instant.time);
  text += fmt::format(": {} at {} s", tableau_.name, shortest(step_));
  if (mode.is_pair())
    text += fmt::format(" gives a period {:.3g} steps and loses {} of its motion", period / step_,
                        loss_words(error));
  else
    text += fmt::format(" loses {} of its motion", loss_words(error));
  if (name != mode.coordinate) text = fmt::format("{}, through {}", subject(name), text);
  if (mode.is_pair() && mode.damping_ratio() < kLittleDamping)
    text += fmt::format(" in {:.0f} periods", (duration_ - instant.time) / period);
  return text + fmt::format(" (limit {:.0f} %)", 100.0 * kErrorLimit);
}

double ModalJudge::advised_step() const {
  double advised = advised_;
  for (const Excited& mode : excited_)
    advised = std::min(advised, step_for_mode_error(tableau_, mode.s, std::min(step_, advised),
                                                    mode.remaining, kAdvisedError));
  return advised;
}

double ModalJudge::advised_step_of(const Tableau& tableau) const {
  double advised = kInfinity;
  for (const std::complex<double>& s : all_)
    advised = std::min(advised, kAdvisedMargin * stability_limit(tableau, s) / std::abs(s));
  for (const Excited& mode : excited_) {
    const double most = std::min(advised, 1.0 / std::abs(mode.s));
    advised = std::min(advised,
                       step_for_mode_error(tableau, mode.s, most, mode.remaining, kAdvisedError));
  }
  return advised;
}

}  // namespace twincraft
