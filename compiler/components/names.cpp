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

std::vector<std::string> Names::all(const std::string& what) const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_) {
    if (entry.what == what) names.push_back(name);
  }
  return names;
}

void check_mount(const std::string& mount, Span span, const std::string& who, const Names& names,
                 Diagnostics& diagnostics) {
  const std::string what = names.what(mount);
  if (mount == "hub" || what == "body") return;
  std::vector<std::string> mounts = names.all("body");
  std::string advice = mounts.empty() ? "mount it on `hub`" : "mount it on `hub` or on a body";
  if (what == "panel") advice += "; a chain that carries things is made of `bodies`";
  if (!what.empty()) {
    diagnostics
        .error(Code::kMountNotAllowed, span,
               fmt::format("{} cannot be mounted on {} `{}`", who, what, mount))
        .with_hint(advice);
    return;
  }
  mounts.push_back("hub");
  const std::string likely = nearest(mount, mounts);
  diagnostics
      .error(Code::kUnknownComponent, span,
             fmt::format("{} is mounted on unknown `{}`", who, mount))
      .with_hint(likely.empty() ? advice : fmt::format("did you mean `{}`?", likely));
}

void check_tank(const std::string& tank, Span span, const std::string& who, const Names& names,
                Diagnostics& diagnostics) {
  if (names.what(tank) == "tank") return;
  std::vector<std::string> tanks;
  for (const std::string& name : names.all()) {
    if (names.what(name) == "tank") tanks.push_back(name);
  }
  Diagnostic& unknown = diagnostics.error(
      Code::kUnknownComponent, span, fmt::format("`{}`, which {} names, is no tank", tank, who));
  const std::string near = nearest(tank, tanks);
  if (!near.empty()) unknown.with_hint(fmt::format("did you mean `{}`?", near));
}

}  // namespace twincraft
