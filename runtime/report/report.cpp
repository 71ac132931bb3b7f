// See report.h. Tested by tests/runtime/report_test.cpp.
#include "runtime/report/report.h"

#include <algorithm>

namespace twincraft {

bool Report::complete() const {
  return std::all_of(members.begin(), members.end(),
                     [](const ReportedMember& member) { return member.result.complete; });
}

Verdict Report::verdict() const {
  const auto is = [](Verdict verdict) {
    return [verdict](const ReportedMember& member) { return member.result.verdict() == verdict; };
  };
  if (std::any_of(members.begin(), members.end(), is(Verdict::kDisagree)))
    return Verdict::kDisagree;
  const bool all_agree = std::all_of(members.begin(), members.end(), is(Verdict::kAgree));
  return all_agree ? Verdict::kAgree : Verdict::kNotJudged;
}

}  // namespace twincraft
