// See study.h. Of a grid the last path varies fastest, so a step along a path skips as many members
// as there are combinations of the paths after it. Tested by tests/compiler/study_test.cpp.
#include "compiler/ir/study.h"

#include <numeric>

namespace twincraft {
namespace {

std::size_t stride_of(const StudyPlan& plan, std::size_t path) {
  const auto after = plan.lengths.begin() + static_cast<std::ptrdiff_t>(path) + 1;
  return std::accumulate(after, plan.lengths.end(), std::size_t{1}, std::multiplies<>());
}

}  // namespace

std::size_t StudyPlan::baseline_of(std::size_t member) const {
  if (!is_grid) return 0;
  const std::size_t stride = stride_of(*this, *compare);
  return member - member / stride % lengths[*compare] * stride;
}

std::size_t StudyPlan::last_held_against(std::size_t baseline) const {
  const std::size_t others = lengths[*compare] - 1;
  return baseline + others * (is_grid ? stride_of(*this, *compare) : 1);
}

}  // namespace twincraft
