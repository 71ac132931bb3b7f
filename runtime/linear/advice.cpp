#include "runtime/linear/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace twincraft {
namespace {

constexpr std::size_t kMostReasons = 3;

}  // namespace

double nice_step(double step) {
  if (!(step > 0.0) || !std::isfinite(step)) return step;
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double digit : {5.0, 2.0})
    if (step >= digit * power * (1.0 - 1.0e-9)) return digit * power;
  return step >= power * (1.0 - 1.0e-9) ? power : 0.5 * power;
}

std::string step_words(double step) {
  constexpr std::array<std::pair<double, std::string_view>, 4> kUnits{
      {{1.0, "s"}, {1.0e-3, "ms"}, {1.0e-6, "us"}, {1.0e-9, "ns"}}};
  // A tenth of a second is still written in seconds.
  for (const auto& [unit, name] : kUnits)
    if (step >= 0.0999 * unit) return fmt::format("{:.3g} {}", step / unit, name);
  return fmt::format("{:.3g} s", step);
}

std::string loss_words(double share) {
  if (!(share < 9.995)) return "far more than all";
  return share < 1.0 ? fmt::format("{:.2g} %", 100.0 * share)
                     : fmt::format("{:.0f} %", 100.0 * share);
}

void conclude(std::vector<Finding> findings, std::string_view cure, Resolution& resolution) {
  if (findings.empty()) return;
  // What is as grave to a percent is told of the first instant at which it was found.
  std::ranges::stable_sort(findings, std::greater(), [](const Finding& finding) {
    return std::round(100.0 * std::log(finding.severity));
  });
  const Finding& gravest = findings.front();
  resolution.resolved = false;
  resolution.rule = gravest.rule;
  resolution.worst_coordinate = gravest.coordinate;
  resolution.worst_error = gravest.error;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const auto before = findings.begin() + static_cast<std::ptrdiff_t>(i);
    const bool is_told = std::any_of(findings.begin(), before, [&](const Finding& told) {
      return told.rule == findings[i].rule && told.coordinate == findings[i].coordinate;
    });
    if (!is_told && resolution.reasons.size() < kMostReasons)
      resolution.reasons.push_back(findings[i].text);
  }
  if (!cure.empty()) resolution.reasons.front() += fmt::format(". {}", cure);
}

}  // namespace twincraft
