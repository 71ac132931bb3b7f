#include "compiler/member_faults.h"

#include <fmt/format.h>

#include <algorithm>

namespace twincraft {
namespace {

bool is_known(const Diagnostic& fault, const Diagnostics& diagnostics) {
  const auto same = [&fault](const Diagnostic& other) {
    return other.code == fault.code && other.span == fault.span && other.message == fault.message;
  };
  return std::any_of(diagnostics.all().begin(), diagnostics.all().end(), same);
}

bool covers(const Span& outer, const Span& inner) {
  return inner.source == outer.source && inner.line == outer.line && inner.column >= outer.column &&
         inner.column + inner.length <= outer.column + outer.length;
}

/// A fault of a member with notes at the values that made the member, unless one is its place.
Diagnostic in_member(Diagnostic fault, std::size_t index, const std::vector<Override>& changes) {
  for (const Override& change : changes) {
    if (covers(change.value.span, fault.span) || covers(change.span, fault.span)) return fault;
  }
  for (const Override& change : changes)
    fault.with_note(change.value.span, fmt::format("set by member {} of the study", index + 1));
  return fault;
}

}  // namespace

void take_new_faults(const Diagnostics& of_member, std::size_t index,
                     const std::vector<Override>& changes, Diagnostics& diagnostics) {
  for (const Diagnostic& fault : of_member.all()) {
    // What is worth a note in one spec is not in hundreds of members.
    if (fault.severity == Severity::kNote || is_known(fault, diagnostics)) continue;
    diagnostics.take(in_member(fault, index, changes));
  }
}

}  // namespace twincraft
