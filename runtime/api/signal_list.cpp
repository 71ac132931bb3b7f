#include "runtime/api/signal_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/diag/diagnostics.h"
#include "runtime/api/faults.h"

namespace twincraft::api {

void SignalList::add(const Signal& signal) {
  for (std::size_t i = 0; i < signal.size(); ++i) {
    names_.push_back(signal.component(i));
    units_.push_back(signal.unit);
    meanings_.push_back(signal.meaning);
    vectors_.push_back(signal.axes.empty() ? "" : signal.name);
  }
}

SignalList::Range SignalList::find(std::string_view name) const {
  if (const auto at = std::ranges::find(names_, name); at != names_.end())
    return {static_cast<std::size_t>(at - names_.begin()), 1};
  if (!name.empty())
    if (const auto at = std::ranges::find(vectors_, name); at != vectors_.end())
      return {static_cast<std::size_t>(at - vectors_.begin()),
              static_cast<std::size_t>(std::ranges::count(vectors_, name))};
  std::vector<std::string> known = names_;
  known.insert(known.end(), vectors_.begin(), vectors_.end());
  const std::string near = nearest(name, known);
  refuse(fmt::format("unknown {} {}{}", kind_, in_backticks(name),
                     near.empty() ? "" : fmt::format("; did you mean {}?", in_backticks(near))));
}

}  // namespace twincraft::api
