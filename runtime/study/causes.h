// Why two engines of one spec may differ: what in the language makes them differ on purpose or by
// construction, how to take it away and how to make it larger or smaller. A table; a new cause is a
// row. MuJoCo's diagonalisation of inertias is no cause here: the language has no switch for it.
// Tested by tests/runtime/attribution_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "compiler/ir/bundle.h"

namespace twincraft {

/// Changes to a spec, `PATH=VALUE` each.
using Overrides = std::vector<std::string>;

/// The cause's variable times `factor`.
struct Scaling {
  double factor = 1.0;
  Overrides set;
};

struct Cause {
  std::string key;                // `wheel_mass`
  std::string name;               // `token wheel mass`
  Overrides remove;               // one machine in this respect
  std::string variable;           // `wheel mass`; empty: it has no size
  std::vector<Scaling> scalings;  // without factor 1
  std::string not_scaled;         // why there are none
};

/// Those that apply to the spec as it stands.
std::vector<Cause> causes_of(const Bundle& bundle);

/// The plan's step times `factor`, sampled at least where the plan itself is; nothing of an
/// adaptive method, whose errors do not follow the step.
std::vector<Scaling> step_scaling(const Model& model, double factor);

}  // namespace twincraft
