// The analytic engine of a point mass: Newton's second law.
// Tested by tests/runtime/point_mass_test.cpp.
#pragma once

#include <memory>

#include "runtime/engine/engine.h"

namespace twincraft::bsm {

/// @pre the plan of `model` is a translation
std::unique_ptr<Engine> make_point_mass_engine(const Model& model);

}  // namespace twincraft::bsm
