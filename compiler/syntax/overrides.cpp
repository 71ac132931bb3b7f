// Where a path leads: maps by key, lists by the `name` of a member or to all of them by `*`.
// Tested by tests/compiler/overrides_test.cpp.
#include "compiler/syntax/overrides.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/syntax/load.h"

namespace twincraft {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_word(std::string_view segment) {
  const auto fits = [](char c) { return is_letter(c) || is_digit(c) || c == '_' || c == '-'; };
  return !segment.empty() && is_letter(segment[0]) && std::ranges::all_of(segment, fits);
}

/// Empty when `segment` can be a step of a path.
std::string fault_of(std::string_view segment) {
  if (segment == "*" || is_word(segment)) return {};
  if (segment.empty()) return "an empty step in the path";
  if (std::ranges::all_of(segment, is_digit)) {
    return fmt::format("{} is a number, members of a list go by name", in_backticks(segment));
  }
  return fmt::format("{} is neither a key nor a name", in_backticks(segment));
}

/// One override at work: descends from the root along its path, all branches of a `*`.
class Setter {
 public:
  Setter(const Override& setting, Diagnostics& diagnostics)
      : override_(setting), diagnostics_(diagnostics) {}

  bool descend(Node& node, std::size_t depth) {
    switch (node.kind) {
      case Node::Kind::kNull:
        if (step(depth) == "*") return report_no_members(depth);
        node = new_map();
        [[fallthrough]];
      case Node::Kind::kMap:
        return descend_map(node, depth);
      case Node::Kind::kList:
        return descend_list(node, depth);
      case Node::Kind::kScalar:
        break;
    }
    error(Code::kOverrideThroughValue, depth,
          fmt::format("{} is {}, which has no parts", shown_parent(depth), describe(node)))
        .with_hint(fmt::format("set {} itself", shown_parent(depth)));
    return false;
  }

 private:
  const std::string& step(std::size_t depth) const { return override_.path[depth]; }
  bool is_last(std::size_t depth) const { return depth + 1 == override_.path.size(); }
  bool removes() const { return override_.value.is_null(); }

  /// The path above `depth` for messages.
  std::string shown_parent(std::size_t depth) const {
    if (depth == 0) return "the spec";
    return in_backticks(fmt::format(
        "{}", fmt::join(override_.path.begin(),
                        override_.path.begin() + static_cast<std::ptrdiff_t>(depth), ".")));
  }

  Diagnostic& error(Code code, std::size_t depth, std::string message) {
    Span span = override_.span;
    for (std::size_t i = 0; i < depth; ++i) span.column += static_cast<int>(step(i).size()) + 1;
    span.length = static_cast<int>(step(depth).size());
    return diagnostics_.error(code, span, std::move(message));
  }

  Node new_map() const {
    Node map;
    map.kind = Node::Kind::kMap;
    map.span = override_.span;
    return map;
  }

  bool descend_map(Node& map, std::size_t depth) {
    const std::string& key = step(depth);
    if (key == "*") {
      error(Code::kOverrideThroughValue, depth,
            fmt::format("`*` stands for the members of a list, {} is a map", shown_parent(depth)));
      return false;
    }
    const auto found = std::ranges::find(map.keys, key, &Node::Key::name);
    const bool missing = found == map.keys.end();
    const auto index = found - map.keys.begin();
    if (missing && removes()) return report_missing_key(map, depth);
    if (is_last(depth) && removes()) {
      map.keys.erase(found);
      map.items.erase(map.items.begin() + index);
      return true;
    }
    if (missing) {
      map.keys.push_back({key, override_.span});
      map.items.emplace_back();
    }
    Node& value = map.items[static_cast<std::size_t>(index)];
    if (!is_last(depth)) return descend(value, depth + 1);
    value = override_.value;
    return true;
  }

  bool report_missing_key(const Node& map, std::size_t depth) {
    std::vector<std::string> keys;
    for (const Node::Key& key : map.keys) keys.push_back(key.name);
    Diagnostic& fault = error(
        Code::kOverrideNoSuchMember, depth,
        fmt::format("{} has no {} to remove", shown_parent(depth), in_backticks(step(depth))));
    if (const std::string near = nearest(step(depth), keys); !near.empty()) {
      fault.with_hint(fmt::format("did you mean `{}`?", near));
    }
    return false;
  }

  /// Names of the members in order; empty for a member without one.
  static std::vector<std::string> names_of(const Node& list) {
    std::vector<std::string> names;
    for (const Node& member : list.items) {
      const Node* name = member.is_map() ? member.find("name") : nullptr;
      names.push_back(name != nullptr && name->is_scalar() ? name->scalar : std::string());
    }
    return names;
  }

  bool descend_list(Node& list, std::size_t depth) {
    const std::vector<std::string> names = names_of(list);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (step(depth) == "*" || step(depth) == names[i]) chosen.push_back(i);
    }
    if (chosen.empty()) return report_missing_member(list, names, depth);
    bool any = false;
    // From the back, so that removing one leaves the places of the others.
    for (auto i = chosen.rbegin(); i != chosen.rend(); ++i) any |= set_member(list, *i, depth);
    return any;
  }

  bool set_member(Node& list, std::size_t index, std::size_t depth) {
    Node& member = list.items[index];
    if (!is_last(depth)) return descend(member, depth + 1);
    if (removes()) {
      list.items.erase(list.items.begin() + static_cast<std::ptrdiff_t>(index));
      return true;
    }
    Node value = override_.value;
    const Node* name = member.is_map() ? member.find("name") : nullptr;
    if (name != nullptr && value.is_map() && value.find("name") == nullptr) {
      value.keys.push_back({"name", override_.span});
      value.items.push_back(*name);
    }
    member = std::move(value);
    return true;
  }

  bool report_no_members(std::size_t depth) {
    error(Code::kOverrideNoSuchMember, depth,
          fmt::format("{} has no members", shown_parent(depth)));
    return false;
  }

  bool report_missing_member(const Node& list, const std::vector<std::string>& names,
                             std::size_t depth) {
    const std::string parent = shown_parent(depth);
    const bool nameless = std::ranges::all_of(names, &std::string::empty);
    if (nameless && !list.items.empty()) {
      error(Code::kOverrideThroughValue, depth,
            fmt::format("{} is a list without named members", parent))
          .with_hint(fmt::format("set {} as a whole", parent));
      return false;
    }
    if (list.items.empty()) return report_no_members(depth);
    Diagnostic& fault =
        error(Code::kOverrideNoSuchMember, depth,
              fmt::format("{} has no member named {}", parent, in_backticks(step(depth))));
    const std::string near = nearest(step(depth), names);
    fault.with_hint(near.empty() ? fmt::format("its members are {}", shown(names))
                                 : fmt::format("did you mean `{}`?", near));
    return false;
  }

  /// The first few names, in backticks.
  static std::string shown(const std::vector<std::string>& names) {
    constexpr std::size_t kShown = 8;
    std::vector<std::string> quoted;
    for (const std::string& name : names) {
      if (!name.empty() && quoted.size() < kShown) quoted.push_back(in_backticks(name));
    }
    return fmt::format("{}{}", fmt::join(quoted, ", "), names.size() > kShown ? ", ..." : "");
  }

  const Override& override_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::vector<std::string> parse_path(std::string_view text, const Span& span,
                                    Diagnostics& diagnostics) {
  std::vector<std::string> path;
  bool good = true;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('.', begin), text.size());
    const std::string_view segment = text.substr(begin, end - begin);
    if (const std::string fault = fault_of(segment); !fault.empty()) {
      Span place = span;
      place.column += static_cast<int>(begin);
      place.length = std::max(1, static_cast<int>(segment.size()));
      diagnostics.error(Code::kOverrideForm, place, fault)
          .with_hint("a path is keys and names joined by dots, such as `wheels.rw_x.torque`");
      good = false;
    }
    path.emplace_back(segment);
    begin = end + 1;
  }
  if (good && path.size() > static_cast<std::size_t>(kMaximumDepth)) {
    diagnostics.error(Code::kOverrideForm, span, "the path is too long");
    good = false;
  }
  return good ? path : std::vector<std::string>();
}

std::optional<Override> parse_override(std::string_view text, Sources& sources,
                                       Diagnostics& diagnostics) {
  const std::string name(trimmed(text.substr(0, text.find('='))));
  const Source& source = sources.add(name.empty() ? "--set" : "--set " + name, std::string(text));
  const std::string_view whole = source.text();
  const std::size_t equals = whole.find('=');
  const std::string_view path_text = trimmed(whole.substr(0, equals));
  const Span span = source.span(whole.find(path_text), path_text.size());
  if (equals == std::string_view::npos || path_text.empty()) {
    diagnostics
        .error(Code::kOverrideForm, span,
               path_text.empty() ? "an override without a path" : "an override without `=`")
        .with_hint("write `PATH=VALUE`, such as `simulation.step=0.01`");
    return std::nullopt;
  }
  Override result;
  result.span = span;
  result.path = parse_path(path_text, span, diagnostics);
  std::optional<Node> value = parse_value(source, diagnostics, equals + 1);
  if (result.path.empty() || !value) return std::nullopt;
  result.value = std::move(*value);
  return result;
}

bool apply(const Override& setting, Node& root, Diagnostics& diagnostics) {
  return Setter(setting, diagnostics).descend(root, 0);
}

}  // namespace twincraft
