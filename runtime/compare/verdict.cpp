// See verdict.h.
#include "runtime/compare/verdict.h"

#include <algorithm>
#include <array>

namespace twincraft {

std::string_view verdict_name(Verdict verdict) {
  constexpr std::array<std::string_view, 6> kNames{"agree",      "disagree", "unresolved",
                                                   "not_judged", "failed",   "interrupted"};
  return kNames[static_cast<std::size_t>(verdict)];
}

Verdict judge(std::span<const JudgedFigure> figures, bool whole_run) {
  const bool all_held = std::ranges::all_of(figures, &JudgedFigure::held);
  if (!all_held) return Verdict::kDisagree;
  return whole_run && !figures.empty() ? Verdict::kAgree : Verdict::kNotJudged;
}

}  // namespace twincraft
