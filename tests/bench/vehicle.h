// A spec compiled for a benchmark: stepped by RK4, for so many steps whatever it says.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "compiler/ir/bundle.h"

namespace twincraft::bench {

/// The spec can not be compiled; the text is what the compiler says.
struct BadSpec : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @param settings  `PATH=VALUE`, as on the command line
/// @throws BadSpec
Bundle compiled(const std::string& spec, const std::vector<std::string>& settings = {});

/// Let the run be `steps` steps of RK4.
void set_steps(Model& model, long steps);

}  // namespace twincraft::bench
