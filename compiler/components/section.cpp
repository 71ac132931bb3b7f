#include "compiler/components/section.h"

#include <fmt/format.h>

#include "compiler/ir/number.h"

namespace twincraft {

void check_acts(const std::optional<std::vector<Schedule::Interval>>& during, Span span,
                std::string_view who, const Context& context, Diagnostics& diagnostics) {
  if (!during) return;
  for (const Schedule::Interval& interval : *during)
    if (interval.start < context.duration && interval.end > 0.0) return;
  diagnostics.warning(Code::kNeverActs, span,
                      fmt::format("{} does not act in the run, which is from 0 to {} s", who,
                                  shortest(context.duration)));
}

}  // namespace twincraft
