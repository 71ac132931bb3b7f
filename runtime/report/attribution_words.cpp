// See attribution_words.h. Tested by tests/runtime/attribution_test.cpp.
#include "runtime/report/attribution_words.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "runtime/report/words.h"

namespace twincraft {
namespace {

/// An exponent this near to a whole number has its name.
constexpr double kNear = 0.15;
/// A cause is worth naming from here on, for or against the difference.
constexpr double kWorthNaming = 0.05;

/// 0 when it is near none.
int whole(double exponent) {
  const double nearest = std::round(exponent);
  return std::abs(exponent - nearest) <= kNear ? static_cast<int>(nearest) : 0;
}

std::string order_words(double order) {
  constexpr std::array kNames{"first", "second", "third",   "fourth",
                              "fifth", "sixth",  "seventh", "eighth"};
  const int name = whole(order);
  if (name < 1 || name > static_cast<int>(kNames.size()))
    return fmt::format("order {:.2f} in the step", order);
  return fmt::format("{} order in the step, {:.2f}", kNames.at(static_cast<std::size_t>(name - 1)),
                     order);
}

std::string named(const AttributedCause& cause) {
  const std::string law = cause.law ? fmt::format("; {}", law_words(*cause.law)) : "";
  return fmt::format("the {} ({}{})", cause.cause.name, share_words(cause.share), law);
}

std::vector<std::string> dominant(const Attribution& attribution) {
  std::vector<std::string> names;
  for (const AttributedCause& cause : attribution.causes)
    if (std::abs(cause.share) >= kWorthNaming) names.push_back(named(cause));
  return names;
}

std::string amount(double value, const Attribution& attribution, const Model& model) {
  return quantity(value, words_of(attribution.subject.metric, model).unit);
}

/// `joint angles (`cam`)`
std::string subject_words(const Subject& subject, const Model& model) {
  const std::string label = words_of(subject.metric, model).label;
  return subject.joint ? fmt::format("{} (`{}`)", label, subject.coordinate) : label;
}

/// How much of MuJoCo's rounding there may be.
std::string predicted(const Attribution& attribution, const Model& model) {
  if (attribution.kind != Remainder::kMujocoRounding) return {};
  const double limit = attribution.subject.unit * attribution.subject.mujoco_rounding;
  return fmt::format(" (it is predicted to stay below {})", amount(limit, attribution, model));
}

}  // namespace

std::string law_words(const ScalingLaw& law) {
  if (law.variable == "step") return order_words(law.exponent);
  switch (whole(law.exponent)) {
    case 1:
      return fmt::format("linear in {}, slope {:.2f}", law.variable, law.exponent);
    case 2:
      return fmt::format("quadratic in {}, {:.2f}", law.variable, law.exponent);
    default:
      return fmt::format("power {:.2f} of {}", law.exponent, law.variable);
  }
}

std::string share_words(double share) {
  if (std::isnan(share)) return "-";
  const std::string text = fmt::format("{:.1f} %", 100.0 * share);
  return text == "-0.0 %" ? "0.0 %" : text;
}

std::string remainder_words(const Attribution& attribution) {
  switch (attribution.kind) {
    case Remainder::kRounding:
      return "rounding";
    case Remainder::kIntegrator:
      return fmt::format("the integrator's error, {}", order_words(*attribution.remainder_order));
    case Remainder::kMujocoRounding:
      return "rounding in MuJoCo, which refers all inertias to the vehicle's centre of mass";
    case Remainder::kUnknown:
      return "not run to the end";
    case Remainder::kUnexplained:
      break;
  }
  return "not explained by any cause that is known here";
}

std::string conclusion(const Attribution& attribution, const Model& model) {
  const std::string label = subject_words(attribution.subject, model);
  const std::string maximum = amount(attribution.maximum, attribution, model);
  if (attribution.is_rounding)
    return fmt::format(
        "nothing to explain: {} differs by {}, which is rounding (up to {})", label, maximum,
        amount(attribution.subject.unit * attribution.subject.rounding, attribution, model));
  if (attribution.kind == Remainder::kUnknown)
    return fmt::format("not explained to the end: {}", attribution.failure);
  const std::string remainder = amount(attribution.remainder, attribution, model);
  const std::vector<std::string> names = dominant(attribution);
  const std::string limit = predicted(attribution, model);
  if (names.empty())
    return fmt::format("{} differs by {}: {}{}", label, maximum, remainder_words(attribution),
                       limit);
  return fmt::format("{} {} the {} difference of {}; what remains, {}, is {}{}",
                     fmt::join(names, " and "), names.size() == 1 ? "carries" : "carry", label,
                     maximum, remainder, remainder_words(attribution), limit);
}

std::string_view attribution_method() {
  return "share: the part of the difference, sample by sample and with its direction, that goes "
         "when the cause alone is taken away, sum (e - e_without) . e over sum e . e, where e is "
         "the rotation vector from one engine's attitude to the other's (or the distance of the "
         "centres of mass) in inertial components, or the difference of one joint; shares of "
         "causes that add up add up to 100 %, a "
         "negative one works against the others. law: exponent of the largest e - e_without over "
         "the scaled variable, both with and without the cause, by least squares over what stands "
         "30 times out of the remainder. remainder: all causes taken away; rounding when below one "
         "unit in the last place per step, the integrator's when it falls with the step. Rounding "
         "in MuJoCo cannot be taken away. It is predicted from the sizes of the terms that MuJoCo "
         "sums, m r^2 about the vehicle's centre of mass, as an error of the accelerations that "
         "keeps its sign over the whole run.";
}

}  // namespace twincraft
