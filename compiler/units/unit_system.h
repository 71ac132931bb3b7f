// The one place that talks to UDUNITS-2: names and prefixes of units to a factor and a dimension.
// Tested by tests/compiler/units_test.cpp.
#pragma once

#include <string>
#include <string_view>

#include "compiler/units/dimension.h"

namespace twincraft {

struct Unit {
  double factor = 1.0;  // to the base units of `dimension`
  Dimension dimension;
  std::string error;  // empty: fine
  std::string hint;
};

/// What `text` means; a fault says why it means nothing. The database is read at the first call;
/// safe to call from several threads. Throws std::runtime_error when the database is unreadable.
Unit find_unit(std::string_view text);

}  // namespace twincraft
