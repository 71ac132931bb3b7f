// Values that are kept as they were written, because what they mean is known only later: that of a
// sweep when its path is set, a sigma when the unit of what it spreads is found. Tested by
// tests/compiler/study_test.cpp and campaign_test.cpp.
#pragma once

#include <string>

#include "compiler/schema/table.h"

namespace twincraft {

/// Anything.
Kind<Node> any_value();
/// A number with or without a unit. @param text  for the reference
Kind<Node> any_quantity(std::string text);

/// A node as JSON: plain numbers as numbers, everything else as the text it is.
Json json_of(const Node& node);

/// The path under the key `set`, without its quotes.
Span path_span(const Written& where);

}  // namespace twincraft
