// The stages of a compilation, in order. Tested by tests/compiler/pipeline_test.cpp.
#include "compiler/pipeline.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <utility>

#include "compiler/analysis/verify.h"
#include "compiler/emit/assembly_json.h"
#include "compiler/emit/json.h"
#include "compiler/emit/mjcf.h"
#include "compiler/emit/resolved.h"
#include "compiler/schema/manual.h"
#include "compiler/schema/partial.h"
#include "compiler/spec/spec.h"
#include "compiler/syntax/extends.h"
#include "compiler/syntax/load.h"
#include "compiler/syntax/overrides.h"

namespace twincraft {
namespace {

/// A spec as bundles name it.
struct Origin {
  std::string file;
  std::string sha256;  // of all files it is made of
};

/// Text to syntax tree, with what it extends and with the command line's changes in it.
/// @param origin, changes  receive what the tree is made of
std::optional<Node> load(const Source& source, const CompileRequest& request, Sources& sources,
                         Origin& origin, std::vector<Override>& changes, Diagnostics& diagnostics) {
  std::optional<Node> root = parse(source, diagnostics);
  if (!root || diagnostics.has_errors()) return std::nullopt;
  const std::optional<std::string> text_of_all =
      resolve_extends(*root, source, request.file, sources, diagnostics);
  if (!text_of_all || diagnostics.has_errors()) return std::nullopt;
  origin = {source.name(), sha256(*text_of_all)};
  for (const std::string& text : request.overrides) {
    std::optional<Override> change = parse_override(text, sources, diagnostics);
    if (!change) continue;
    apply(*change, *root, diagnostics);
    changes.push_back(std::move(*change));
  }
  if (diagnostics.has_errors()) return std::nullopt;
  return root;
}

/// Of the command line: those in a study are read later.
bool has_bad_override(const Diagnostics& diagnostics) {
  const auto is_bad = [](const Diagnostic& fault) { return fault.code == Code::kOverrideForm; };
  return std::ranges::any_of(diagnostics.all(), is_bad);
}

/// Syntax tree to a spec in which every default is filled in and every reference holds.
std::optional<Spec> read(const Node& root, Diagnostics& diagnostics) {
  if (!refuse_late_extends(root, diagnostics)) return std::nullopt;
  if (!check_format(root, diagnostics)) return std::nullopt;
  Spec spec = spec_table().read(root, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  check(spec, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return spec;
}

bool check_finite(const Model& model, Span span, Diagnostics& diagnostics) {
  if (is_finite(model)) return true;
  diagnostics
      .error(Code::kOutOfRange, span,
             "the numbers of this spec are too large to compute with: its mass matrix or its "
             "initial state overflows")
      .with_hint("check the units of masses, lengths and inertias");
  return false;
}

void require_one_machine(const Model& model) {
  const std::vector<std::string> failures = verify(model);
  if (failures.empty()) return;
  throw InternalError(fmt::format("the two halves of `{}` are not one machine: {}", model.name,
                                  fmt::join(failures, "; ")));
}

/// The value at a path of the resolved spec, the first one where the path means several.
const Json* find_value(const Json& resolved, const std::vector<std::string>& path) {
  const Json* value = &resolved;
  for (const std::string& step : path) {
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

std::vector<Setting> settings_of(const std::vector<Override>& changes, const Json& resolved) {
  std::vector<Setting> settings;
  for (const Override& change : changes) {
    settings.push_back(setting_of(change));
    settings.back().value = number_of(find_value(resolved, change.path));
  }
  return settings;
}

Bundle emit(Model model, const Spec& spec, const Origin& origin,
            const std::vector<Override>& changes) {
  const Json resolved = spec_table().write(spec);
  Bundle bundle;
  if (model.mujoco_refusal.empty()) bundle.mjcf = emit_mjcf(model);
  bundle.assembly_json = emit_bsm(model);
  bundle.resolved_yaml = emit_resolved(resolved);
  bundle.resolved_json = json_text(resolved);
  bundle.spec_file = origin.file;
  bundle.spec_sha256 = origin.sha256;
  bundle.settings = settings_of(changes, resolved);
  bundle.emitted_sha256 = {{"bsm", sha256(bundle.assembly_json)},
                           {"resolved", sha256(bundle.resolved_yaml)}};
  if (!bundle.mjcf.empty()) bundle.emitted_sha256["mjcf"] = sha256(bundle.mjcf);
  bundle.model = std::move(model);
  return bundle;
}

/// A spec and the model it became.
struct Compiled {
  Spec spec;  // points into the syntax tree
  Model model;
};

/// Syntax tree to model, short of the proof and the printing.
std::optional<Compiled> compile_tree(const Node& root, Diagnostics& diagnostics) {
  std::optional<Spec> spec = read(root, diagnostics);
  if (!spec) return std::nullopt;
  std::optional<Model> model = lower(*spec, diagnostics);
  if (!model || diagnostics.has_errors()) return std::nullopt;
  if (!check_finite(*model, root.span, diagnostics)) return std::nullopt;
  return Compiled{std::move(*spec), std::move(*model)};
}

void remove_key(Node& map, std::string_view key) {
  const auto found = std::find_if(map.keys.begin(), map.keys.end(),
                                  [key](const Node::Key& one) { return one.name == key; });
  if (found == map.keys.end()) return;
  map.items.erase(map.items.begin() + (found - map.keys.begin()));
  map.keys.erase(found);
}

/// A tree with some changes, as a bundle of its own.
/// @param changes  applied one after the other
/// @param before   made the tree what it is; the bundle names them first
std::optional<Bundle> compile_changed(Node root, const std::vector<Override>& before,
                                      std::vector<Override> changes, const Origin& origin,
                                      Diagnostics& diagnostics) {
  for (const Override& change : changes) apply(change, root, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  std::optional<Compiled> compiled = compile_tree(root, diagnostics);
  if (!compiled) return std::nullopt;
  require_one_machine(compiled->model);
  changes.insert(changes.begin(), before.begin(), before.end());
  return emit(std::move(compiled->model), compiled->spec, origin, changes);
}

class VariantsOfSpec : public Variants {
 public:
  VariantsOfSpec(Node root, std::vector<Override> command_line, Origin origin, Sources& sources)
      : base_(std::move(root)),
        command_line_(std::move(command_line)),
        origin_(std::move(origin)),
        sources_(sources) {
    remove_key(base_, "study");
  }

  std::optional<Bundle> compile(const std::vector<std::string>& overrides,
                                Diagnostics& diagnostics) const override {
    const std::lock_guard lock(one_at_a_time_);  // neither Sources nor UDUNITS is for threads
    std::vector<Override> changes;
    for (const std::string& text : overrides)
      if (std::optional<Override> change = parse_override(text, sources_, diagnostics))
        changes.push_back(std::move(*change));
    if (diagnostics.has_errors()) return std::nullopt;
    return compile_changed(base_, command_line_, std::move(changes), origin_, diagnostics);
  }

 private:
  Node base_;
  std::vector<Override> command_line_;
  Origin origin_;
  Sources& sources_;
  mutable std::mutex one_at_a_time_;
};

class StudyOfSpec : public Study {
 public:
  StudyOfSpec(Node root, StudyMembers members, std::vector<Override> command_line, Origin origin)
      : base_(std::move(root)),
        members_(std::move(members)),
        command_line_(std::move(command_line)),
        origin_(std::move(origin)) {
    remove_key(base_, "study");
    // The tolerances of a spec are for its own step, not for all those that are tried out.
    if (members_.plan.is_work_precision) remove_tolerances();
  }

  const StudyPlan& plan() const override { return members_.plan; }
  const Node& base() const { return base_; }
  std::vector<Override> changes(std::size_t index) const { return members_.overrides(index); }

  std::optional<Bundle> compile(std::size_t index, Diagnostics& diagnostics) const override {
    const std::lock_guard lock(one_at_a_time_);  // UDUNITS is no library for threads
    return compile_changed(base_, command_line_, members_.overrides(index), origin_, diagnostics);
  }

  /// Whatever is wrong with one member, short of the proof and the printing.
  void check(std::size_t index, Diagnostics& diagnostics) const {
    Node root = base_;
    for (const Override& change : members_.overrides(index)) apply(change, root, diagnostics);
    if (!diagnostics.has_errors()) compile_tree(root, diagnostics);
  }

 private:
  void remove_tolerances() {
    remove_key(base_, "agreement");
    for (std::size_t i = 0; i < base_.keys.size(); ++i)
      if (base_.keys[i].name == "stored") remove_key(base_.items[i], "tolerance");
  }

  Node base_;
  StudyMembers members_;
  std::vector<Override> command_line_;
  Origin origin_;
  mutable std::mutex one_at_a_time_;
};

constexpr std::size_t kEnoughFaults = 50;

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

// Checking takes about a microsecond for every three of these units: some seconds in all.
constexpr std::size_t kCheckedWork = 10'000'000;

std::size_t count_values(const Node& node) {
  std::size_t count = 1;
  for (const Node& item : node.items) count += count_values(item);
  return count;
}

/// What is wrong with the members beyond what is wrong with the spec itself, each fault once.
void check_members(const StudyOfSpec& study, std::size_t coordinates, Span span,
                   const CompileRequest& request, Diagnostics& diagnostics) {
  const std::size_t members = study.plan().members;
  const std::size_t work = count_values(study.base()) + 10 * coordinates;
  const std::size_t checked =
      std::min({members, kCheckedMembers, std::max<std::size_t>(1, kCheckedWork / work)});
  for (std::size_t i = 0; i < checked; ++i) {
    if (request.progress) request.progress(i, checked);
    Diagnostics of_member;
    study.check(i, of_member);
    for (const Diagnostic& fault : of_member.all()) {
      // What is worth a note in one spec is not in hundreds of members.
      if (fault.severity == Severity::kNote || is_known(fault, diagnostics)) continue;
      diagnostics.take(in_member(fault, i, study.changes(i)));
    }
    if (diagnostics.error_count() >= kEnoughFaults) return;
  }
  if (members > checked)
    diagnostics.note(
        Code::kStudyNotChecked, span,
        fmt::format("the first {} of the study's {} members were checked", checked, members));
}

}  // namespace

CompileResult compile(const CompileRequest& request, Sources& sources, Diagnostics& diagnostics) {
  FileText file = request.text ? FileText{*request.text, {}} : read_file(request.file);
  if (!file.error.empty()) return {.io_error = file.error};
  const std::string name = request.file == "-" ? "<stdin>" : request.file;
  const Source& source = sources.add(name, std::move(file.text));

  Origin origin;
  std::vector<Override> changes;
  const std::optional<Node> root = load(source, request, sources, origin, changes, diagnostics);
  if (!root) return {.bad_override = has_bad_override(diagnostics)};
  std::optional<Compiled> compiled = compile_tree(*root, diagnostics);
  if (!compiled) return {};
  CompileResult result;
  if (const std::optional<StudySpec>& spec = compiled->spec.study) {
    auto study = std::make_unique<StudyOfSpec>(*root, members_of(*spec, diagnostics).value(),
                                               changes, origin);
    check_members(*study, compiled->model.coordinates.size(), spec->span(), request, diagnostics);
    if (diagnostics.has_errors()) return {};
    result.study = std::move(study);
  }
  require_one_machine(compiled->model);
  result.variants = std::make_unique<VariantsOfSpec>(*root, changes, origin, sources);
  result.step = compiled->spec.simulation.span_of("step");
  result.record_span = compiled->spec.simulation.span_of("record");
  result.bundle = emit(std::move(compiled->model), compiled->spec, origin, changes);
  return result;
}

std::string json_schema() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"$comment", "generated by `sccompile --schema > schemas/spacecraft.schema.json`"},
                 {"title", "Twincraft spacecraft specification, version 1"}};
  schema.update(whole_unless_extending(spec_table().schema()));
  return json_text(schema);
}

std::string reference_markdown() { return reference_text(spec_table().info()); }

std::string sha256(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("OpenSSL does not compute a SHA-256 digest");
  }
  std::string hex;
  for (unsigned int i = 0; i < length; ++i) hex += fmt::format("{:02x}", digest.at(i));
  return hex;
}

}  // namespace twincraft
