// Follows the chain of files; merging itself is in merge.cpp. Tested by
// tests/compiler/extends_test.cpp and tests/malformed.
#include "compiler/syntax/extends.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "compiler/syntax/load.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

/// The entry of `key`, taken out of `map`.
std::optional<Node> take(Node& map, std::string_view key) {
  const auto found = std::ranges::find(map.keys, key, &Node::Key::name);
  if (found == map.keys.end()) return std::nullopt;
  const auto item = map.items.begin() + (found - map.keys.begin());
  Node value = std::move(*item);
  map.keys.erase(found);
  map.items.erase(item);
  return value;
}

const std::string* name_of(const Node& member) {
  const Node* name = member.is_map() ? member.find("name") : nullptr;
  return name != nullptr && name->is_scalar() ? &name->scalar : nullptr;
}

bool is_inside(const fs::path& path, const fs::path& tree) {
  return std::mismatch(tree.begin(), tree.end(), path.begin(), path.end()).first == tree.end();
}

/// The nearest folder from `folder` upwards that is marked; `folder` itself when none is.
fs::path tree_of(const fs::path& folder) {
  std::error_code ignored;
  for (fs::path above = folder;; above = above.parent_path()) {
    if (fs::exists(above / kTreeMarker, ignored)) return above;
    if (above == above.parent_path()) return folder;
  }
}

/// Names of all components of a spec: the members of its sections' lists.
std::vector<std::string> component_names(const Node& spec) {
  std::vector<std::string> names;
  for (const Node& section : spec.items) {
    if (!section.is_list()) continue;
    for (const Node& member : section.items) {
      if (const std::string* name = name_of(member)) names.push_back(*name);
    }
  }
  return names;
}

/// @return whether a component of that name was there
bool erase_component(Node& spec, const std::string& name) {
  std::size_t erased = 0;
  for (Node& section : spec.items) {
    if (!section.is_list()) continue;
    erased += std::erase_if(section.items, [&name](const Node& member) {
      const std::string* own = name_of(member);
      return own != nullptr && *own == name;
    });
  }
  return erased > 0;
}

/// One spec file on disk.
struct Place {
  fs::path shown;   // from the working folder, for messages and for what it extends
  fs::path actual;  // without links
};

class Resolver {
 public:
  Resolver(Sources& sources, Diagnostics& diagnostics)
      : sources_(sources), diagnostics_(diagnostics) {}

  /// @return whether there was no fault
  bool start(Node& root, const std::string& file) {
    std::error_code fault;
    const fs::path shown(file);
    const fs::path folder = fs::canonical(folder_of(shown), fault);
    const fs::path actual = fault ? fs::path() : fs::canonical(shown, fault);
    // A `drop` alone needs no place, and is a fault of its own.
    if (const Node* target = root.find("extends"); fault && target != nullptr) {
      unreadable(*target, shown, fault);
      return false;
    }
    tree_ = tree_of(folder);
    return extend(root, {shown, actual});
  }

  const std::string& texts() const { return texts_; }
  const std::vector<std::string>& files() const { return files_; }

 private:
  static fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
  }

  bool extend(Node& own, const Place& place) {
    chain_.push_back(place.actual);
    const std::optional<Node> target = take(own, "extends");
    const std::optional<Node> dropped = take(own, "drop");
    if (!target) return !dropped || nothing_to_drop_from(*dropped);
    const std::optional<Place> next = locate(*target, place);
    if (!next) return false;
    std::optional<Node> base = read(*target, *next);
    if (!base || !extend(*base, *next)) return false;
    if (!check_same_format(*base, own)) return false;
    const bool good = !dropped || drop(*dropped, *base);
    own = merge(std::move(*base), std::move(own));
    return good;
  }

  /// Where `target`, written in the file at `from`, is; it may be read.
  std::optional<Place> locate(const Node& target, const Place& from) {
    if (!target.is_scalar() || target.scalar.empty()) {
      diagnostics_
          .error(target.is_null() ? Code::kNoValue : Code::kWrongType, target.span,
                 "`extends` names no file")
          .with_hint("write the path of a spec, from the folder of this one: `extends: base.yaml`");
      return std::nullopt;
    }
    if (fs::path(target.scalar).is_absolute()) {
      outside(target, "is an absolute path");
      return std::nullopt;
    }
    const fs::path shown = folder_of(from.shown) / target.scalar;
    std::error_code fault;
    const fs::path folder = fs::canonical(folder_of(from.shown), fault);
    if (!fault && !is_inside((folder / target.scalar).lexically_normal(), tree_)) {
      outside(target, "leaves the folder tree of the spec");
      return std::nullopt;
    }
    const fs::path actual = fault ? fs::path() : fs::canonical(shown, fault);
    if (fault) {
      unreadable(target, shown, fault);
      return std::nullopt;
    }
    if (!is_inside(actual, tree_)) {
      outside(target, "is a link that leads out of the folder tree of the spec");
      return std::nullopt;
    }
    return may_go_on(target, actual) ? std::optional<Place>({shown.lexically_normal(), actual})
                                     : std::nullopt;
  }

  /// Whether the chain can go on to `next`.
  bool may_go_on(const Node& target, const fs::path& next) {
    const auto found = std::ranges::find(chain_, next);
    if (found != chain_.end()) {
      const bool itself = found + 1 == chain_.end();
      diagnostics_
          .error(Code::kExtendsEndless, target.span,
                 fmt::format("{} {}", in_backticks(target.scalar),
                             itself ? "is this very file" : "extends this file in turn"))
          .with_hint("move what both share into a file of its own, and extend that");
      return false;
    }
    if (chain_.size() <= kMaximumExtends) return true;
    diagnostics_.error(Code::kExtendsEndless, target.span,
                       fmt::format("a chain of more than {} extended files", kMaximumExtends));
    return false;
  }

  std::optional<Node> read(const Node& target, const Place& place) {
    FileText file = read_file(place.actual.string(), target.scalar);
    if (!file.error.empty()) {
      diagnostics_.error(Code::kExtendsUnreadable, target.span, file.error);
      return std::nullopt;
    }
    const Source& source = sources_.add(place.shown.string(), std::move(file.text));
    texts_ += source.text();
    std::error_code fault;  // `..` after a link to a folder leads elsewhere than it reads
    const bool is_shown = fs::equivalent(place.shown, place.actual, fault);
    files_.push_back(is_shown ? source.name() : place.actual.string());
    return parse(source, diagnostics_);
  }

  /// The file on top must not hide that the one below is written in another language.
  bool check_same_format(const Node& base, const Node& own) {
    const Node* below = base.find("format");
    const Node* above = own.find("format");
    if (below == nullptr || above == nullptr || below->scalar == above->scalar) return true;
    diagnostics_
        .error(Code::kUnsupportedFormat, below->span,
               fmt::format("the extended spec has the format {}, this one has {}", describe(*below),
                           describe(*above)))
        .with_note(above->span, "extended by this one");
    return false;
  }

  bool drop(const Node& names, Node& base) {
    if (!names.is_list()) {
      diagnostics_
          .error(names.is_null() ? Code::kNoValue : Code::kWrongType, names.span,
                 "`drop` is not a list of names")
          .with_hint("write `drop: [wing_m, rw_z]`");
      return false;
    }
    const std::vector<std::string> known = component_names(base);
    bool good = true;
    for (const Node& name : names.items) good = drop_one(name, known, base) && good;
    return good;
  }

  bool drop_one(const Node& name, const std::vector<std::string>& known, Node& base) {
    if (!name.is_scalar()) {
      diagnostics_.error(Code::kWrongType, name.span,
                         fmt::format("`drop` lists {}, not a name", describe(name)));
      return false;
    }
    if (erase_component(base, name.scalar)) return true;
    const std::string near = nearest(name.scalar, known);
    const bool twice = near == name.scalar;
    diagnostics_
        .error(Code::kDropUnknown, name.span,
               fmt::format("{} {}", in_backticks(name.scalar),
                           twice ? "is dropped already" : "is no component of the extended spec"))
        .with_hint(near.empty() || twice ? "" : fmt::format("did you mean `{}`?", near));
    return false;
  }

  bool nothing_to_drop_from(const Node& dropped) {
    diagnostics_
        .error(Code::kDropUnknown, dropped.span,
               "`drop` without `extends`: there is nothing to drop from")
        .with_hint("`drop` removes components of the spec that this one extends");
    return false;
  }

  void outside(const Node& target, std::string_view what) {
    diagnostics_
        .error(Code::kExtendsOutside, target.span,
               fmt::format("{} {}", in_backticks(target.scalar), what))
        .with_hint(fmt::format(
            "extended files lie in the folder of the compiled spec or below; an empty file `{}` in "
            "a folder further up widens that to its tree",
            kTreeMarker));
  }

  void unreadable(const Node& target, const fs::path& shown, std::error_code fault) {
    std::string reason = fault.message();
    if (!reason.empty() && reason[0] >= 'A' && reason[0] <= 'Z') {
      reason[0] = static_cast<char>(reason[0] + 32);
    }
    Diagnostic& error =
        diagnostics_.error(Code::kExtendsUnreadable, target.span,
                           fmt::format("cannot read {}: {}", in_backticks(target.scalar), reason));
    // What lies in a folder outside the tree is nobody's business.
    const fs::path folder = fs::canonical(folder_of(shown), fault);
    if (fault || !is_inside(folder, tree_)) return;
    const std::string near = near_file(shown.string());
    if (!near.empty()) error.with_hint(fmt::format("did you mean {}?", in_backticks(near)));
  }

  Sources& sources_;
  Diagnostics& diagnostics_;
  fs::path tree_;
  std::vector<fs::path> chain_;  // from the compiled file on
  std::string texts_;
  std::vector<std::string> files_;
};

}  // namespace

std::optional<Extended> resolve_extends(Node& root, const Source& source, const std::string& file,
                                        Sources& sources, Diagnostics& diagnostics) {
  const Node* target = root.find("extends");
  if (target == nullptr && root.find("drop") == nullptr) return Extended{source.text(), {}};
  if (target != nullptr && file == "-") {
    diagnostics
        .error(Code::kExtendsNowhere, target->span,
               "a spec from standard input is in no folder, so it cannot extend a file")
        .with_hint("give the spec as a file");
    return std::nullopt;
  }
  Resolver resolver(sources, diagnostics);
  if (!resolver.start(root, file)) return std::nullopt;
  return Extended{source.text() + resolver.texts(), resolver.files()};
}

bool refuse_late_extends(const Node& root, Diagnostics& diagnostics) {
  bool good = true;
  for (const Node::Key& key : root.keys) {
    if (key.name != "extends" && key.name != "drop") continue;
    diagnostics
        .error(Code::kExtendsNowhere, key.span,
               fmt::format("`{}` cannot be set: files are merged before overrides", key.name))
        .with_hint(key.name == "drop" ? "remove a component by `--set panels.wing_m=null`"
                                      : "write `extends` into the spec");
    good = false;
  }
  return good;
}

}  // namespace twincraft
