// See attribution.h: first every variant that is known from the start, then the cumulative ones,
// whose order follows from the shares.
#include "runtime/study/attribution.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

#include "compiler/ir/angle.h"

namespace twincraft {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// A contribution this many times what is left without any cause bends a slope by a hundredth.
constexpr double kOutOfTheNoise = 30.0;
/// Half of Euler's order; a difference of the machines has order zero.
constexpr double kLeastOrder = 0.5;
/// Rounding is another at another step, and may come out a little smaller by chance.
constexpr double kOrderByChance = 1.5;

std::string_view path_of(std::string_view change) { return change.substr(0, change.find('=')); }

/// Where both change one place, `b` has the last word.
Overrides together(const Overrides& a, const Overrides& b) {
  Overrides all;
  std::copy_if(a.begin(), a.end(), std::back_inserter(all), [&b](const std::string& change) {
    return std::none_of(b.begin(), b.end(), [&change](const std::string& later) {
      return path_of(later) == path_of(change);
    });
  });
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

/// Variants, each of them run once however often it is asked for.
class Variations {
 public:
  Variations(ErrorSeries as_is, const RunVariants& run) : run_(run) {
    asked_.emplace_back();
    results_.push_back({std::move(as_is), {}});
  }

  /// Its number. The order of changes, each to a place of its own, makes no difference.
  std::size_t ask(Overrides variant) {
    std::sort(variant.begin(), variant.end());
    const auto known = std::find(asked_.begin(), asked_.end(), variant);
    const auto number = static_cast<std::size_t>(known - asked_.begin());
    if (known == asked_.end()) asked_.push_back(std::move(variant));
    return number;
  }

  /// All that were asked for since the last time.
  void run() {
    if (asked_.size() == results_.size()) return;
    const auto begin = asked_.begin() + static_cast<std::ptrdiff_t>(results_.size());
    std::vector<VariantResult> results = run_({begin, asked_.end()});
    results.resize(static_cast<std::size_t>(asked_.end() - begin), {{}, "interrupted"});
    std::move(results.begin(), results.end(), std::back_inserter(results_));
  }

  const ErrorSeries* error(std::size_t number) const {
    const VariantResult& result = results_.at(number);
    return result.error ? &*result.error : nullptr;
  }

  double maximum(std::size_t number) const {
    return error(number) != nullptr ? error(number)->maximum() : std::nan("");
  }

  /// Largest difference of two variants.
  double contribution(std::size_t with, std::size_t without) const {
    if (error(with) == nullptr || error(without) == nullptr) return std::nan("");
    return difference(*error(with), *error(without)).maximum();
  }

  std::string first_failure() const {
    for (const VariantResult& result : results_)
      if (!result.error) return result.failure;
    return {};
  }

 private:
  const RunVariants& run_;
  std::vector<Overrides> asked_;
  std::vector<VariantResult> results_;
};

/// One cause and the numbers of its variants.
struct Asked {
  struct Scaled {
    double factor = 1.0;
    std::size_t with = 0, without = 0;  // 0: the spec as it is
  };
  Cause cause;
  std::size_t alone = 0;
  std::vector<Scaled> scaled;  // the spec as it is among them; largest first
};

Asked ask(const Cause& cause, Variations& variations) {
  Asked asked{cause, variations.ask(cause.remove), {}};
  asked.scaled.push_back({1.0, 0, asked.alone});
  for (const Scaling& scaling : cause.scalings)
    asked.scaled.push_back({scaling.factor, variations.ask(scaling.set),
                            variations.ask(together(scaling.set, cause.remove))});
  std::sort(asked.scaled.begin(), asked.scaled.end(),
            [](const auto& a, const auto& b) { return a.factor > b.factor; });
  return asked;
}

/// @param noise  SI
void find_law(const Asked& asked, const Variations& variations, double noise, double unit,
              AttributedCause& result) {
  result.no_law = asked.cause.not_scaled;
  if (asked.cause.scalings.empty()) return;
  ScalingLaw law;
  law.variable = asked.cause.variable;
  std::vector<double> x, y;
  for (const Asked::Scaled& scaled : asked.scaled) {
    const double contribution = variations.contribution(scaled.with, scaled.without);
    if (std::isnan(contribution)) continue;
    law.factors.push_back(scaled.factor);
    law.contributions.push_back(unit * contribution);
    if (contribution <= kOutOfTheNoise * noise) continue;
    x.push_back(scaled.factor);
    y.push_back(contribution);
  }
  if (x.size() < 2) {
    const bool all_flown = law.factors.size() == asked.scaled.size();
    result.no_law = all_flown ? "too little to measure a law" : "not run to the end";
    return;
  }
  law.exponent = log_slope(x, y);
  result.law = std::move(law);
}

double share_of(const Variations& variations, std::size_t without) {
  if (variations.error(without) == nullptr) return std::nan("");
  return share(*variations.error(0), *variations.error(without));
}

/// By the size of the share, for or against; what could not be run comes last.
bool carries_more(const AttributedCause& a, const AttributedCause& b) {
  if (std::isnan(a.share) || std::isnan(b.share)) return !std::isnan(a.share);
  return std::abs(a.share) > std::abs(b.share);
}

void remove_one_after_another(Variations& variations, double unit,
                              std::vector<AttributedCause>& causes) {
  Overrides removed;
  std::vector<std::size_t> numbers;
  for (const AttributedCause& each : causes) {
    removed = together(removed, each.cause.remove);
    numbers.push_back(variations.ask(removed));
  }
  variations.run();
  for (std::size_t i = 0; i < causes.size(); ++i)
    causes[i].maximum_left = unit * variations.maximum(numbers[i]);
}

/// @param all, halved  without any cause; and at half the step (`all` itself: there is no half)
void judge_remainder(const Variations& variations, std::size_t all, std::size_t halved,
                     Attribution& result) {
  const double left = variations.maximum(all), at_half = variations.maximum(halved);
  result.remainder = result.subject.unit * left;
  result.kind = std::isnan(left) ? Remainder::kUnknown : Remainder::kUnexplained;
  if (left <= result.subject.rounding) {
    result.kind = Remainder::kRounding;
  } else if (halved != all && at_half > 0.0) {
    result.remainder_order = std::log2(left / at_half);
    if (*result.remainder_order > kLeastOrder) result.kind = Remainder::kIntegrator;
  }
  const bool falls_with_the_step = result.remainder_order.value_or(0.0) > kOrderByChance;
  if (result.kind != Remainder::kRounding && left <= result.subject.mujoco_rounding &&
      !falls_with_the_step)
    result.kind = Remainder::kMujocoRounding;
}

/// @param steps  rounding adds up over them
std::optional<Subject> worst_joint(const Model& model, const Trajectory& a, const Trajectory& b,
                                   double steps) {
  std::optional<Subject> worst;
  double largest = 0.0;  // in units of rounding
  for (const Coordinate& coordinate : model.coordinates) {
    if (coordinate.is_wheel()) continue;
    double size = 0.0;
    for (const Observation& sample : a.samples)
      size = std::max(size, std::abs(position_of(coordinate, sample)));
    Subject subject{std::string(kind_of(coordinate).metric),
                    find_metric_row(kind_of(coordinate).metric)->scale, kEpsilon * steps * size,
                    coordinate.entry(), coordinate.name};
    const double off = error_of(subject, a, b).maximum();
    if (!(off > largest * subject.rounding)) continue;
    largest = off / subject.rounding;
    worst = std::move(subject);
  }
  return worst;
}

}  // namespace

std::vector<Subject> subjects_of(const Model& model, const Trajectory& a, const Trajectory& b) {
  const auto steps = static_cast<double>(std::max(a.counts.accepted, b.counts.accepted));
  double distance = 1.0;  // [m] of a vehicle at the origin: the size of a vehicle
  for (const Observation& sample : a.samples) distance = std::max(distance, sample.r_CN_N.norm());
  std::vector<Subject> subjects;
  if (!model.simulation.translation)
    subjects.push_back({"attitude_deg", kDegrees, kEpsilon * steps});
  subjects.push_back({"com_position_m", 1.0, kEpsilon * steps * distance});
  if (std::optional<Subject> joint = worst_joint(model, a, b, steps))
    subjects.push_back(std::move(*joint));
  return subjects;
}

ErrorSeries error_of(const Subject& subject, const Trajectory& a, const Trajectory& b) {
  if (subject.joint) return joint_error(*subject.joint, a, b);
  return subject.metric == "attitude_deg" ? attitude_error(a, b) : position_error(a, b);
}

Attribution attribute(const Bundle& bundle, const Subject& subject, ErrorSeries as_is,
                      const RunVariants& run) {
  Attribution result;
  result.subject = subject;
  const double maximum = as_is.maximum();
  result.maximum = result.remainder = subject.unit * maximum;
  result.is_rounding = maximum <= subject.rounding;
  result.complete = true;
  if (result.is_rounding) return result;

  Variations variations(std::move(as_is), run);
  std::vector<Asked> asked;
  Overrides everything;
  for (const Cause& cause : causes_of(bundle)) {
    asked.push_back(ask(cause, variations));
    everything = together(everything, cause.remove);
  }
  const std::size_t all = variations.ask(everything);
  std::size_t halved = all;
  for (const Scaling& scaling : step_scaling(bundle.model, 0.5))
    halved = variations.ask(together(everything, scaling.set));
  variations.run();
  judge_remainder(variations, all, halved, result);

  const double left = variations.maximum(all);
  const double noise = std::isnan(left) ? subject.rounding : std::min(left, subject.rounding);
  for (const Asked& each : asked) {
    AttributedCause cause{each.cause,
                          share_of(variations, each.alone),
                          subject.unit * variations.maximum(each.alone),
                          {},
                          {},
                          0.0};
    find_law(each, variations, noise, subject.unit, cause);
    result.causes.push_back(std::move(cause));
  }
  std::stable_sort(result.causes.begin(), result.causes.end(), carries_more);
  remove_one_after_another(variations, subject.unit, result.causes);
  result.failure = variations.first_failure();
  result.complete = result.failure.empty();
  return result;
}

}  // namespace twincraft
