// From what was found to what to type: steps as people write them, and the gravest finding first.
#pragma once

#include <string>
#include <vector>

#include "runtime/linear/resolution.h"

namespace twincraft {

/// One rule that fails.
struct Finding {
  ResolutionRule rule = ResolutionRule::kStability;
  double severity = 1.0;        // how many times the limit; an unstable mode is the gravest
  std::string coordinate;       // that names it; empty when none does
  std::optional<double> error;  // relative to the coordinate's motion
  std::string text;             // without the cure
};

/// The largest of 1, 2 and 5 times a power of ten that is not above `step`.
double nice_step(double step);

/// Sorts the findings into `resolution`: rule, worst, reasons. The cure, a sentence if there is
/// one, ends the gravest.
void conclude(std::vector<Finding> findings, std::string_view cure, Resolution& resolution);

/// `12 %`, `0.3 %`, `all`
std::string loss_words(double share);

}  // namespace twincraft
