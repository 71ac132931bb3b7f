// See bundling.h. Tested by tests/compiler/pipeline_test.cpp.
#include "compiler/bundling.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "compiler/emit/json.h"
#include "compiler/emit/target.h"
#include "compiler/ir/digest.h"

namespace twincraft {
namespace {

/// The value at some steps down a resolved value, the first one where they mean several.
const Json* find_value(const Json& resolved, std::span<const std::string> steps) {
  const Json* value = &resolved;
  for (const std::string& step : steps) {
    const auto fits = [&step](const Json& member) {
      return step == "*" || (member.is_object() && member.value("name", "") == step);
    };
    if (value->is_array()) {
      const auto member = std::find_if(value->begin(), value->end(), fits);
      if (member == value->end()) return nullptr;
      value = &*member;
    } else {
      if (!value->is_object() || !value->contains(step)) return nullptr;
      value = &(*value)[step];
    }
  }
  return value;
}

std::optional<double> number_of(const Json* value) {
  if (value == nullptr) return std::nullopt;
  if (value->is_number()) return value->get<double>();
  if (!value->is_array() || value->empty()) return std::nullopt;
  double sum = 0.0;
  for (const Json& component : *value) {
    if (!component.is_number()) return std::nullopt;
    sum += component.get<double>() * component.get<double>();
  }
  return std::sqrt(sum);
}

std::vector<Setting> settings_of(const std::vector<Override>& changes, const Spec& spec) {
  std::vector<Setting> settings;
  std::string section_name;
  Json section;  // changes of one section mostly follow one another
  for (const Override& change : changes) {
    settings.push_back(setting_of(change));
    if (change.path.front() != section_name) {
      section_name = change.path.front();
      section = spec_table().write_key(spec, section_name);
    }
    settings.back().value = number_of(find_value(section, std::span(change.path).subspan(1)));
  }
  return settings;
}

/// What a target says of the model, at the components that it is about.
void tell(const std::vector<Remark>& remarks, const Spec& spec, Diagnostics& diagnostics) {
  for (const Remark& remark : remarks) {
    const Span span = name_span(spec, remark.component).value_or(spec.span_of("name"));
    if (remark.is_refusal)
      diagnostics.warning(Code::kHalfRefused, span, remark.text);
    else
      diagnostics.note(Code::kHalfRewritten, span, remark.text);
  }
}

}  // namespace

Bundle emit(Model model, const Spec& spec, const Origin& origin,
            const std::vector<Override>& changes, const Wanted& wanted, Diagnostics& diagnostics) {
  const Json resolved = wanted.empty() ? Json() : spec_table().write(spec);
  Bundle bundle;
  for (const std::string_view name : wanted) {
    const Target& target = *find_target(name);
    Printed printed = target.print(model, resolved);
    tell(printed.remarks, spec, diagnostics);
    if (!printed.refusal.empty()) {
      bundle.refused.insert_or_assign(std::string(name), std::move(printed.refusal));
      continue;
    }
    std::string digest = sha256(printed.text);
    bundle.emitted.insert_or_assign(std::string(name),
                                    Emitted{std::move(printed.text), std::move(digest)});
    if (name == kResolved) bundle.resolved_json = json_text(resolved);
  }
  bundle.spec_file = origin.file;
  bundle.spec_sha256 = origin.sha256;
  bundle.settings = settings_of(changes, spec);
  bundle.model = std::move(model);
  return bundle;
}

}  // namespace twincraft
