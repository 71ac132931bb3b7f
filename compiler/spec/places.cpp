// A walk along the field tables and, beside it, the values as the spec writes them resolved.
#include "compiler/spec/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compiler/schema/table_info.h"

namespace twincraft {
namespace {

using Path = std::vector<std::string>;

std::string joined_path(const Path& path) { return fmt::format("{}", fmt::join(path, ".")); }

/// Of the tables that a value may have, the one that this value has: sorts are told by `type`.
const TableInfo& table_of(const std::vector<const TableInfo*>& tables, const Json& value) {
  const auto suits = [&value](const TableInfo* table) {
    const FieldInfo* type = find_field(*table, "type");
    if (type == nullptr || !type->schema.contains("enum")) return true;
    const Json& words = type->schema["enum"];
    return std::ranges::find(words, value.value("type", Json())) != words.end();
  };
  const auto found = std::ranges::find_if(tables, suits);
  return found == tables.end() ? *tables.front() : **found;
}

bool is_list_of_numbers(const Json& value) {
  return value.is_array() && !value.empty() &&
         std::ranges::all_of(value, [](const Json& item) { return item.is_number(); });
}

/// All numbers of lists and lists in lists.
void collect(const Json& value, std::vector<double>& numbers) {
  if (value.is_number()) numbers.push_back(value.get<double>());
  for (const Json& item : value.is_array() ? value : Json::array()) collect(item, numbers);
}

class Walk {
 public:
  Walk(const Spec& spec, const Path& path, Span span, Diagnostics& diagnostics)
      : spec_(spec), path_(path), span_(span), diagnostics_(diagnostics) {}

  /// The step `depth` of the path, from a map.
  void from_map(const TableInfo& table, const Json& map, std::size_t depth) {
    const std::string& key = path_[depth];
    const FieldInfo* field = find_field(table, key);
    if (field == nullptr) return report_unknown(table, depth);
    way_.push_back(key);
    if (depth + 1 == path_.size())
      arrive(*field, map.value(key, Json()), depth);
    else if (!map.contains(key))
      report_absent(depth);
    else
      go_on(*field, map[key], depth + 1);
    way_.pop_back();
  }

  std::vector<Place> places() && { return std::move(places_); }

 private:
  Diagnostic& error(Code code, std::size_t depth, std::string message) {
    Span span = span_;
    for (std::size_t i = 0; i < depth; ++i) span.column += static_cast<int>(path_[i].size()) + 1;
    span.length = static_cast<int>(path_[depth].size());
    return diagnostics_.error(code, span, std::move(message));
  }

  void go_on(const FieldInfo& field, const Json& value, std::size_t depth) {
    if (field.tables.empty() || !value.is_structured()) {
      error(Code::kCampaignPath, depth,
            fmt::format("`{}` is a value, which has no parts", joined_path(way_)));
    } else if (value.is_object()) {
      from_map(table_of(field.tables, value), value, depth);
    } else {
      into_members(field, value, depth);
    }
  }

  void into_members(const FieldInfo& field, const Json& members, std::size_t depth) {
    const std::string& step = path_[depth];
    std::vector<std::string> names;
    bool any = false;
    for (const Json& member : members) {
      if (!member.is_object()) continue;
      names.push_back(member.value("name", ""));
      if (step != "*" && step != names.back()) continue;
      any = true;
      if (depth + 1 == path_.size()) return report_shape(depth, "a component");
      way_.push_back(names.back());
      from_map(table_of(field.tables, member), member, depth + 1);
      way_.pop_back();
    }
    if (any) return;
    const std::string near = nearest(step, names);
    error(Code::kCampaignPath, depth,
          step == "*"
              ? fmt::format("`{}` has no members", joined_path(way_))
              : fmt::format("`{}` has no member named {}", joined_path(way_), in_backticks(step)))
        .with_hint(near.empty() ? "" : fmt::format("did you mean `{}`?", near));
  }

  void report_unknown(const TableInfo& table, std::size_t depth) {
    std::vector<std::string> keys;
    for (const FieldInfo& field : table.fields) keys.push_back(field.key);
    const std::string near = nearest(path_[depth], keys);
    error(Code::kCampaignPath, depth,
          fmt::format("{} has no key {}", table.name, in_backticks(path_[depth])))
        .with_hint(near.empty() ? "its keys are " + words_text(keys, "and")
                                : fmt::format("did you mean `{}`?", near));
  }

  void report_absent(std::size_t depth) {
    error(Code::kCampaignPath, depth,
          fmt::format("the spec has no `{}` to draw about", joined_path(way_)))
        .with_hint("write its nominal value");
  }

  void report_shape(std::size_t depth, const std::string& what) {
    error(Code::kCampaignForm, depth,
          fmt::format("`{}` cannot be drawn: {}", joined_path(way_), what));
  }

  void arrive(const FieldInfo& field, const Json& value, std::size_t depth) {
    using Form = Numbers::Form;
    if (field.tables.size() == 1 && field.tables.front() == &attitude_table().info())
      return add_attitude();
    const Numbers& numbers = field.numbers;
    if (numbers.form == Form::kNone)
      return report_shape(depth, field.tables.empty() ? field.kind : "a map");
    if (value.is_null()) return report_absent(depth);
    Place place{joined_path(way_), Place::Form::kNumber, numbers.unit, {}};
    collect(value, place.values);
    if (numbers.form == Form::kInertia && value.is_array()) return add_inertia(std::move(place));
    if (is_list_of_numbers(value)) {
      place.form = numbers.form == Form::kVector      ? Place::Form::kVector
                   : numbers.form == Form::kDirection ? Place::Form::kDirection
                                                      : Place::Form::kList;
    } else if (!value.is_number()) {
      return report_shape(depth, value.is_string()  ? "the word `" + value.get<std::string>() + "`"
                                 : value.is_array() ? "a schedule of several points"
                                                    : "a map");
    }
    places_.push_back(std::move(place));
  }

  void add_inertia(Place place) {
    place.form = Place::Form::kInertia;
    if (place.values.size() == 3) {
      const std::vector<double> m = place.values;
      place.values = {m[0], 0.0, 0.0, 0.0, m[1], 0.0, 0.0, 0.0, m[2]};
    }
    places_.push_back(std::move(place));
  }

  void add_attitude() {
    const Quaterniond q = way_.front() == "initial" ? attitude(spec_.initial, spec_.environment)
                                                    : orientation_of(way_[1]);
    places_.push_back(
        {joined_path(way_), Place::Form::kAttitude, "rad", {q.w(), q.x(), q.y(), q.z()}});
  }

  Quaterniond orientation_of(const std::string& body) const {
    const auto found = std::ranges::find(spec_.bodies, body, &BodySpec::name);
    return found != spec_.bodies.end() && found->orientation
               ? orientation(*found->orientation, PointState{})
               : Quaterniond::Identity();
  }

  const Spec& spec_;
  const Path& path_;
  Span span_;
  Diagnostics& diagnostics_;
  Path way_;  // with the names of members in the place of `*`
  std::vector<Place> places_;
};

}  // namespace

std::string describe(Place::Form form) {
  switch (form) {
    case Place::Form::kNumber:
      return "a number";
    case Place::Form::kList:
      return "a list of numbers";
    case Place::Form::kVector:
      return "a vector";
    case Place::Form::kDirection:
      return "a direction";
    case Place::Form::kInertia:
      return "an inertia tensor";
    case Place::Form::kAttitude:
      return "an attitude";
  }
  return {};
}

std::vector<Place> places_of(const Spec& spec, const Json& resolved,
                             const std::vector<std::string>& path, Span span,
                             Diagnostics& diagnostics) {
  Walk walk(spec, path, span, diagnostics);
  walk.from_map(spec_table().info(), resolved, 0);
  return std::move(walk).places();
}

}  // namespace twincraft
