// See names.h. Tested by tests/compiler/spec_test.cpp.
#include "compiler/components/names.h"

#include <fmt/format.h>

namespace twincraft {

void Names::add(const std::string& name, const std::string& what, Span span,
                Diagnostics& diagnostics) {
  const auto [entry, is_new] = entries_.try_emplace(name, Entry{what, span});
  if (is_new) return;
  const Entry& first = entry->second;
  diagnostics
      .error(Code::kDuplicateName, span,
             fmt::format("{} `{}` has the name of a {}", what, name, first.what))
      .with_hint("names are unique in the whole file")
      .with_note(first.span, fmt::format("{} `{}` is named here", first.what, name));
}

std::string Names::what(const std::string& name) const {
  const auto entry = entries_.find(name);
  return entry == entries_.end() ? std::string() : entry->second.what;
}

std::vector<std::string> Names::all() const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_) names.push_back(name);
  return names;
}

void check_mount(const std::string& mount, Span span, const std::string& who, const Names& names,
                 Diagnostics& diagnostics) {
  if (mount == "hub") return;
  const std::string what = names.what(mount);
  if (!what.empty()) {
    diagnostics
        .error(Code::kMountNotAllowed, span,
               fmt::format("{} cannot be mounted on {} `{}`", who, what, mount))
        .with_hint("mount it on `hub`");
    return;
  }
  Diagnostic& unknown = diagnostics.error(Code::kUnknownComponent, span,
                                          fmt::format("{} is mounted on unknown `{}`", who, mount));
  unknown.with_hint(nearest(mount, {"hub"}).empty() ? "mount it on `hub`" : "did you mean `hub`?");
}

}  // namespace twincraft
