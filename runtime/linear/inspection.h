// When a run is looked at to judge its resolution: at its start, around its events, and along it.
// Decided before the run, so that the run can show itself at those instants.
#pragma once

#include <vector>

#include "compiler/ir/model.h"

namespace twincraft {

/// From one event to the next: inputs do not change inside.
struct Stretch {
  double begin = 0.0, end = 0.0;  // [s]
};

struct Inspection {
  std::vector<double> events;       // [s] all of them, inside the run
  std::vector<Stretch> stretches;   // those that are looked at; the first begins at 0
  std::vector<double> probes;       // [s] where steps are repeated at half the step; ascending
  std::vector<double> before;       // [s] one step before an event, where a tank is emptiest
  std::vector<double> along;        // [s] 25, 50 and 75 % of the run
  std::vector<double> all() const;  // [s] every instant that the run must show; ascending
};

/// Of many events those that shake the vehicle most, from its initial state, are looked at.
Inspection plan_inspection(const Model& model);

/// Does a tank lose mass during the run?
bool drains(const Model& model);

}  // namespace twincraft
