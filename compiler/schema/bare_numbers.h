// Plain numbers are SI, and people forget it: `angle: 45`, `[10 mm, 5, 3]`. What is written that
// way is read as it says, but said aloud. A number with its unit is never questioned. Tested by
// tests/compiler/bare_numbers_test.cpp.
#pragma once

#include <vector>

#include "compiler/schema/reading.h"

namespace twincraft {

/// Where plain numbers of a key end to be likely.
struct Usual {
  double largest = 0.0;        // in SI; 0: every number is likely
  double largest_whole = 0.0;  // of whole numbers, which are rarely meant in radians
  const char* meant = "";      // the unit that was likely meant
};

/// What angles and angular rates are; of other units every number is likely.
Usual usual_of(SiUnit si);
/// Speeds of wheels, which turn faster than anything else.
inline constexpr Usual kUsualWheelSpeed{1000.0, 1000.0, "rpm"};

/// Warns where one of `entries`, the scalars of one list or a single one, has a unit other than SI
/// and another has none; else where a plain number is not usual. @pre all are quantities in `si`
void judge_bare_numbers(const std::vector<const Node*>& entries, SiUnit si, const Usual& usual,
                        const ReadContext& context);

/// `node` is a number without a unit.
bool is_bare_number(const Node& node);

/// The warning for a number that is likely meant in another unit, at `node`.
/// @param consequence  "45 rad is 7.16 turns"
void warn_of_bare_number(const Node& node, const std::string& consequence, std::string_view meant,
                         SiUnit si, const ReadContext& context);

/// The scalars of lists and of lists in lists.
std::vector<const Node*> scalars_of(const Node& node);

}  // namespace twincraft
