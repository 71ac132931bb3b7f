// What the judged figures of a report come to, in the words that terminal and page share.
#pragma once

#include <span>
#include <string>

#include "runtime/study/results.h"

namespace twincraft {

/// `the engines disagree; the energy balance of MuJoCo exceeds its tolerance`: every kind of
/// tolerance among these figures, which did not hold. Empty when there are none.
std::string exceeded_words(std::span<const JudgedFigure> exceeded);

/// `the engines agree`, or `every tolerance held` where agreement itself was not judged.
std::string held_words(const Report& report);
std::string held_words(const Member& member);

}  // namespace twincraft
