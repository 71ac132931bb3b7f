// The untyped half of field tables: which keys a map may have, and JSON Schema.
// Tested by tests/compiler/schema_test.cpp.
#include "compiler/schema/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "compiler/schema/own_kind.h"
#include "compiler/schema/synonyms.h"
#include "compiler/schema/table_info.h"

namespace twincraft {
namespace {

std::vector<std::string> known_keys(const TableInfo& info) {
  std::vector<std::string> keys;
  for (const FieldInfo& field : info.fields) keys.push_back(field.key);
  return keys;
}

/// What is said elsewhere for a thing counts more than what is spelt alike.
std::string hint_for_unknown(const TableInfo& info, const std::string& key,
                             const std::vector<std::string>& known) {
  if (std::string hint = hint_for_key(info, key); !hint.empty()) return hint;
  const std::string likely = nearest(key, known);
  return likely.empty() ? "its keys are " + words_text(known, "and")
                        : fmt::format("did you mean `{}`?", likely);
}

bool check_unknown_keys(const TableInfo& info, const Node& map, const std::string& label,
                        Diagnostics& diagnostics) {
  const std::vector<std::string> known = known_keys(info);
  bool good = true;
  for (const Node::Key& key : map.keys) {
    if (find_field(info, key.name) != nullptr) continue;
    good = false;
    diagnostics
        .error(Code::kUnknownKey, key.span,
               fmt::format("unknown key {} in {}", in_backticks(key.name), label))
        .with_hint(hint_for_unknown(info, key.name, known));
  }
  return good;
}

/// The first sentence of `doc` as part of a longer one.
std::string in_passing(const std::string& doc) {
  std::string text = doc.substr(0, std::min(doc.find(". "), doc.find_last_of('.')));
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

/// What to write: the keys of a map, the meaning of a text, the form of anything else.
std::string how_to_add(const FieldInfo& field) {
  if (field.tables.size() == 1 && field.kind == field.tables.front()->name) {
    std::vector<std::string> keys;
    for (const FieldInfo& part : field.tables.front()->fields)
      if (part.required) keys.push_back(part.key);
    if (!keys.empty()) return fmt::format("a map with {}", words_text(keys, "and"));
  }
  return field.kind == "text" || field.kind == "name" ? in_passing(field.doc) : field.kind;
}

bool check_missing_keys(const TableInfo& info, const Node& map, const std::string& label,
                        Diagnostics& diagnostics) {
  bool good = true;
  for (const FieldInfo& field : info.fields) {
    if (!field.required || map.find(field.key) != nullptr) continue;
    good = false;
    diagnostics
        .error(Code::kMissingKey, map.span, fmt::format("`{}` is missing in {}", field.key, label))
        .with_hint(fmt::format("add `{}`: {}", field.key, how_to_add(field)));
  }
  return good;
}

/// The keys of `group` that are written in `map`, in the order of writing.
std::vector<const Node::Key*> written_keys(const KeyGroup& group, const Node& map) {
  std::vector<const Node::Key*> written;
  for (const Node::Key& key : map.keys)
    if (std::find(group.keys.begin(), group.keys.end(), key.name) != group.keys.end())
      written.push_back(&key);
  return written;
}

bool check_group(const KeyGroup& group, const Node& map, const std::string& label,
                 Diagnostics& diagnostics) {
  const std::vector<const Node::Key*> written = written_keys(group, map);
  if (written.empty() && group.required) {
    diagnostics
        .error(Code::kMissingKey, map.span,
               fmt::format("{} has none of {}", label, words_text(group.keys, "and")))
        .with_hint("write exactly one of them");
  }
  for (std::size_t i = 1; i < written.size(); ++i) {
    diagnostics
        .error(Code::kExclusiveKeys, written[i]->span,
               fmt::format("`{}` and `{}` exclude each other in {}", written[0]->name,
                           written[i]->name, label))
        .with_note(written[0]->span, fmt::format("`{}` is written here", written[0]->name));
  }
  return written.size() == 1 || (written.empty() && !group.required);
}

Json exactly_one_schema(const std::vector<std::string>& keys) {
  Json choices = Json::array();
  for (const std::string& key : keys) choices.push_back({{"required", Json::array({key})}});
  return {{"oneOf", choices}};
}

Json at_most_one_schema(const std::vector<std::string>& keys) {
  Json pairs = Json::array();
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (std::size_t j = i + 1; j < keys.size(); ++j)
      pairs.push_back({{"required", Json::array({keys[i], keys[j]})}});
  return {{"not", {{"anyOf", pairs}}}};
}

Json field_schema(const FieldInfo& field) {
  Json schema = field.schema;
  schema["description"] = fmt::format("{} ({})", field.doc, field.kind);
  if (field.default_value) schema["default"] = *field.default_value;
  return schema;
}

/// Take out the defaults whose key excludes one that is there.
void leave_out_excluded(const TableInfo& info, Json& written) {
  const auto is_written = [&](const std::string& key) { return written.contains(key); };
  for (const KeyGroup& group : info.groups) {
    if (std::count_if(group.keys.begin(), group.keys.end(), is_written) < 2) continue;
    for (const std::string& key : group.keys) {
      const FieldInfo& field = *find_field(info, key);
      if (is_written(key) && field.default_value == written[key]) written.erase(key);
    }
  }
}

/// Whether every key of `before` is one of `node`, which may have more.
bool has_keys_of(const Node& node, const Node& before) {
  return node.is_map() && before.is_map() &&
         std::ranges::all_of(
             before.keys, [&node](const Node::Key& key) { return node.find(key.name) != nullptr; });
}

/// The map's own `name`, when it can be shown.
std::string own_name(const Node& map) {
  const Node* name = map.find("name");
  return name != nullptr && name->is_scalar() ? name->scalar : std::string();
}

}  // namespace

const FieldInfo* find_field(const TableInfo& info, std::string_view key) {
  const auto field = std::find_if(info.fields.begin(), info.fields.end(),
                                  [key](const FieldInfo& one) { return one.key == key; });
  return field == info.fields.end() ? nullptr : &*field;
}

FieldInfo required_field(std::string key, std::string doc, std::string kind, Json schema,
                         std::vector<const TableInfo*> tables) {
  FieldInfo field;
  field.key = std::move(key);
  field.doc = std::move(doc);
  field.kind = std::move(kind);
  field.required = true;
  field.schema = std::move(schema);
  field.tables = std::move(tables);
  return field;
}

void make_optional(FieldInfo& field, Json default_value) {
  field.required = false;
  if (!is_nothing(default_value)) field.default_value = std::move(default_value);
}

Span Written::span() const { return node == nullptr ? Span{} : node->span; }

Span Written::span_of(std::string_view key) const {
  const Node* value = node == nullptr ? nullptr : node->find(key);
  return value == nullptr ? span() : value->span;
}

bool Written::has(std::string_view key) const {
  return node != nullptr && node->find(key) != nullptr;
}

std::string label_of(const TableInfo& info, const Node& map, const ReadContext& outer) {
  const std::string name = own_name(map);
  if (!name.empty()) return fmt::format("{} {}", info.name, in_backticks(name));
  return outer.owner.empty() ? info.name : fmt::format("{} of {}", info.name, outer.owner);
}

bool check_keys(const TableInfo& info, const Node& map, const ReadContext& outer) {
  if (!map.is_map()) {
    ReadContext context{outer.diagnostics, outer.where.empty() ? info.name : outer.where};
    report_wrong_type(map, context, "a map", "its keys are " + words_text(known_keys(info), "and"));
    return false;
  }
  const std::string label = label_of(info, map, outer);
  bool good = check_unknown_keys(info, map, label, outer.diagnostics);
  good = check_missing_keys(info, map, label, outer.diagnostics) && good;
  for (const KeyGroup& group : info.groups)
    good = check_group(group, map, label, outer.diagnostics) && good;
  return good;
}

ReadContext field_context(const TableInfo& info, const std::string& key, const Node& map,
                          const ReadContext& outer) {
  const std::string label = label_of(info, map, outer);
  // A name that is at fault should not also be what its owner is called.
  const std::string where = fmt::format("`{}` of {}", key, key == "name" ? info.name : label);
  // The document owns everything; saying so in every message would help nobody.
  return {outer.diagnostics, where, outer.where.empty() ? std::string() : label};
}

void add_group(TableInfo& info, KeyGroup group) {
  for (const std::string& key : group.keys) {
    const FieldInfo* field = find_field(info, key);
    if (field == nullptr || field->required)
      throw std::logic_error("table " + info.name + ": " + key + " is not an optional field");
  }
  info.groups.push_back(std::move(group));
}

Json written_map(const TableInfo& info, std::vector<Json> values) {
  Json map = Json::object();
  // Growing would copy what is in it, because an ordered map's keys cannot be moved.
  map.get_ref<Json::object_t&>().reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const FieldInfo& field = info.fields[i];
    if (field.required || !is_nothing(values[i])) map[field.key] = std::move(values[i]);
  }
  leave_out_excluded(info, map);
  return map;
}

Json schema_of(const TableInfo& info) {
  Json schema = {{"type", "object"}, {"description", info.doc}, {"properties", Json::object()}};
  Json required_keys = Json::array();
  for (const FieldInfo& field : info.fields) {
    schema["properties"][field.key] = field_schema(field);
    if (field.required) required_keys.push_back(field.key);
  }
  if (!required_keys.empty()) schema["required"] = required_keys;
  schema["additionalProperties"] = false;
  for (const KeyGroup& group : info.groups)
    schema["allOf"].push_back(group.required ? exactly_one_schema(group.keys)
                                             : at_most_one_schema(group.keys));
  return schema;
}

bool is_nothing(const Json& value) {
  return value.is_null() || (value.is_string() && value.get_ref<const std::string&>().empty()) ||
         (value.is_structured() && value.empty());
}

struct AnyTable::Body {
  struct Member {
    AnyKind kind;
    std::size_t offset;  // in the struct
  };
  TableInfo info;
  std::vector<Member> members;  // parallel to info.fields
  Access access;
};

AnyTable::AnyTable(std::string_view name, std::string_view doc, Access access)
    : body_(std::make_shared<Body>()) {
  body_->info.name = name;
  body_->info.doc = doc;
  body_->access = access;
}
AnyTable::AnyTable(const AnyTable&) = default;
AnyTable& AnyTable::operator=(const AnyTable&) = default;
AnyTable::~AnyTable() = default;

const TableInfo& AnyTable::info() const { return body_->info; }
const std::string& AnyTable::name() const { return body_->info.name; }
Json AnyTable::schema() const { return schema_of(body_->info); }

void AnyTable::add(const AnyField& field, const void* defaults) {
  const AnyKind& kind = field.kind;
  FieldInfo info = required_field(std::string(field.key), std::string(field.doc), kind.text(),
                                  kind.schema(), kind.tables());
  info.numbers = kind.numbers();
  if (!field.required)
    make_optional(info, kind.write_from(static_cast<const char*>(defaults) + field.offset));
  body_->info.fields.push_back(std::move(info));
  body_->members.push_back({kind, field.offset});
}

void AnyTable::add_group(std::vector<std::string> keys, bool required) {
  twincraft::add_group(body_->info, {.keys = std::move(keys), .required = required});
}

bool AnyTable::fill(void* value, const Node& node, const ReadContext& outer) const {
  return read_members(value, node, nullptr, outer);
}

bool AnyTable::refill(void* value, const Node& node, const Node& before,
                      const ReadContext& outer) const {
  if (has_keys_of(node, before)) return read_members(value, node, &before, outer);
  reset(value);
  return fill(value, node, outer);
}

bool AnyTable::read_members(void* value, const Node& node, const Node* before,
                            const ReadContext& outer) const {
  const TableInfo& table = body_->info;
  char* const begin = static_cast<char*>(value);
  if (const auto written = body_->access.written)
    reinterpret_cast<Written*>(begin + *written)->node = &node;
  bool good = check_keys(table, node, outer);
  for (std::size_t i = 0; i < table.fields.size(); ++i) {
    const std::string& key = table.fields[i].key;
    const Node* item = node.find(key);
    if (item == nullptr) continue;
    const Node* item_before = before == nullptr ? nullptr : before->find(key);
    if (item_before != nullptr && *item == *item_before) continue;
    ReadContext context = field_context(table, key, node, outer);
    const Body::Member& member = body_->members[i];
    void* const place = begin + member.offset;
    good =
        (item_before == nullptr ? member.kind.read_into(place, *item, context)
                                : member.kind.reread_into(place, *item, *item_before, context)) &&
        good;
  }
  return good;
}

void AnyTable::reset(void* value) const { body_->access.reset(value); }

Json AnyTable::write_from(const void* value) const {
  std::vector<Json> items;
  items.reserve(body_->members.size());
  for (const Body::Member& member : body_->members)
    items.push_back(member.kind.write_from(static_cast<const char*>(value) + member.offset));
  return written_map(body_->info, std::move(items));
}

Json AnyTable::write_key_from(const void* value, std::string_view key) const {
  for (std::size_t i = 0; i < body_->members.size(); ++i) {
    const Body::Member& member = body_->members[i];
    if (body_->info.fields[i].key == key)
      return member.kind.write_from(static_cast<const char*>(value) + member.offset);
  }
  return nullptr;
}

namespace {

class ObjectKind : public KindBody {
 public:
  explicit ObjectKind(const AnyTable& table)
      : KindBody(table.name(), table.schema(), {&table.info()}, {}), table_(table) {}

  bool read(void* value, const Node& node, ReadContext& context) const override {
    table_.reset(value);
    return table_.fill(value, node, context);
  }
  bool reread(void* value, const Node& node, const Node& before,
              ReadContext& context) const override {
    return table_.refill(value, node, before, context);
  }
  Json write(const void* value) const override { return table_.write_from(value); }

 private:
  AnyTable table_;
};

}  // namespace

AnyKind object_kind(const AnyTable& table) { return AnyKind(std::make_shared<ObjectKind>(table)); }

}  // namespace twincraft
