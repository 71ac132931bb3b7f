// What the judged figures of a report come to, in the words that terminal and page share.
#pragma once

#include <string>

#include "runtime/report/report.h"

namespace twincraft {

/// `the engines disagree; the energy balance of MuJoCo exceeds its tolerance`: every kind of
/// tolerance that a member broke. Empty when it broke none.
std::string exceeded_words(const Member& member);
/// Of the first member that broke any.
std::string exceeded_words(const Report& report);

/// One of its tolerances is of agreement.
bool judges_agreement(const Member& member);

/// `the engines agree`, or `every tolerance held` where agreement itself was not judged.
std::string held_words(const Report& report);
std::string held_words(const Member& member);

}  // namespace twincraft
