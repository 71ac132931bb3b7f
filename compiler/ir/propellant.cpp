// See propellant.h. Tested by tests/compiler/ir_test.cpp.
#include "compiler/ir/propellant.h"

namespace twincraft {

double Tank::content_at(double time) const {
  Drain drain{.full = content};
  for (const Schedule::Entry& entry : mass_flow.entries)
    if (entry.time < time) drain.change(entry.time, entry.value);
  return drain.content(time);
}

}  // namespace twincraft
