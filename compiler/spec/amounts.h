// The amounts of a dispersion, in the unit of what they are of or in `%` of its nominal value, as
// numbers. Tested by tests/compiler/campaign_test.cpp.
#pragma once

#include <string>

#include "compiler/draws/distribution.h"
#include "compiler/spec/campaign.h"

namespace twincraft {

/// What an amount is of.
struct NominalNumber {
  std::string name;  // for messages: `hub.mass`
  std::string unit;  // SI
  double value = 0.0;
};

/// The key of the one distribution that is written: `normal`.
std::string distribution_of(const DispersionSpec& dispersion);
/// The same with its amounts: "normal, sigma 2 %, truncate 3".
std::string words_of(const DispersionSpec& dispersion);

/// How one number is drawn. What is wrong is reported. @pre a distribution of numbers is written
draws::Distribution read_distribution(const DispersionSpec& dispersion, const NominalNumber& of,
                                      Diagnostics& diagnostics);

/// A standard deviation, not negative; `%` is of the magnitude of the nominal value.
double read_sigma(const Node& written, const NominalNumber& of, Diagnostics& diagnostics);

}  // namespace twincraft
