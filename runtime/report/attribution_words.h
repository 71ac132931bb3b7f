// What an attribution found, in words. Tested by tests/runtime/attribution_test.cpp.
#pragma once

#include <string>

#include "compiler/ir/model.h"
#include "runtime/study/attribution.h"

namespace twincraft {

/// `linear in wheel mass, slope 1.00`; `fourth order in the step, 4.01`; `quadratic in speed, 2.00`
std::string law_words(const ScalingLaw& law);

/// `99.9 %`
std::string share_words(double share);

/// `rounding`, `the integrator's error, fourth order in the step, 3.98`, `not explained by these`
std::string remainder_words(const Attribution& attribution);

/// One sentence that names the dominant causes and what is left without any.
std::string conclusion(const Attribution& attribution, const Model& model);

/// How shares and laws are measured.
std::string_view attribution_method();

}  // namespace twincraft
