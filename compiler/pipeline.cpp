// The stages of a compilation, in order. Tested by tests/compiler/pipeline_test.cpp.
#include "compiler/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "compiler/analysis/verify.h"
#include "compiler/bundling.h"
#include "compiler/emit/json.h"
#include "compiler/ir/digest.h"
#include "compiler/member_faults.h"
#include "compiler/schema/manual.h"
#include "compiler/schema/partial.h"
#include "compiler/spec/campaign_members.h"
#include "compiler/spec/spec.h"
#include "compiler/syntax/extends.h"
#include "compiler/syntax/load.h"
#include "compiler/syntax/overrides.h"

namespace twincraft {
namespace {

/// A spec as it is on disk and on the command line, before it means anything.
struct Tree {
  Node root;
  Origin origin;
  std::vector<Override> changes;  // of the command line, in `root` already
  std::vector<std::string> files;
};

/// Text to syntax tree, with what it extends and with the command line's changes in it.
std::optional<Tree> load(const Source& source, const CompileRequest& request, Sources& sources,
                         Diagnostics& diagnostics) {
  std::optional<Node> root = parse(source, diagnostics);
  if (!root || diagnostics.has_errors()) return std::nullopt;
  std::optional<Extended> whole =
      resolve_extends(*root, source, request.file, sources, diagnostics);
  if (!whole || diagnostics.has_errors()) return std::nullopt;
  Tree tree{std::move(*root), {source.name(), sha256(whole->text)}, {}, std::move(whole->files)};
  if (!request.text && request.file != "-") tree.files.insert(tree.files.begin(), request.file);
  for (const std::string& text : request.overrides) {
    std::optional<Override> change = parse_override(text, sources, diagnostics);
    if (!change) continue;
    apply(*change, tree.root, diagnostics);
    tree.changes.push_back(std::move(*change));
  }
  if (diagnostics.has_errors()) return std::nullopt;
  return tree;
}

/// Of the command line: those in a study are read later.
bool has_bad_override(const Diagnostics& diagnostics) {
  const auto is_bad = [](const Diagnostic& fault) { return fault.code == Code::kOverrideForm; };
  return std::ranges::any_of(diagnostics.all(), is_bad);
}

/// What other specs are made of by changes: members of a study, variants.
struct Base {
  Node root;
  // Read from `root`. Nothing where that gave a diagnostic, which a changed spec is to give again.
  std::optional<Spec> spec;

  explicit Base(Node tree) : root(std::move(tree)) {
    Diagnostics diagnostics;
    Spec whole = spec_table().read(root, diagnostics);
    if (diagnostics.all().empty()) spec = std::move(whole);
  }
  Base(const Base&) = delete;  // the spec points into the tree
  Base& operator=(const Base&) = delete;
};

/// @param base  null, or what `root` was made of: the spec points into it, too
Spec read_sections(const Node& root, const Base* base, Diagnostics& diagnostics) {
  if (base == nullptr || !base->spec) return spec_table().read(root, diagnostics);
  return spec_table().reread(*base->spec, root, base->root, diagnostics);
}

/// Syntax tree to a spec in which every default is filled in and every reference holds.
std::optional<Spec> read(const Node& root, Diagnostics& diagnostics, const Base* base = nullptr) {
  if (!refuse_late_extends(root, diagnostics)) return std::nullopt;
  if (!check_format(root, diagnostics)) return std::nullopt;
  Spec spec = read_sections(root, base, diagnostics);
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

/// Spec to model, short of the proof and the printing.
std::optional<Model> lower_finite(const Spec& spec, Diagnostics& diagnostics) {
  std::optional<Model> model = lower(spec, diagnostics);
  if (!model || diagnostics.has_errors()) return std::nullopt;
  if (!check_finite(*model, spec.span(), diagnostics)) return std::nullopt;
  return model;
}

void remove_key(Node& map, std::string_view key) {
  const auto found = std::find_if(map.keys.begin(), map.keys.end(),
                                  [key](const Node::Key& one) { return one.name == key; });
  if (found == map.keys.end()) return;
  map.items.erase(map.items.begin() + (found - map.keys.begin()));
  map.keys.erase(found);
}

/// The tolerances of a spec are for its own step, not for all those that are tried out.
void remove_tolerances(Node& root) {
  remove_key(root, "agreement");
  if (Node* stored = root.find("stored")) remove_key(*stored, "tolerance");
}

/// A spec with the tree of its own that it points into, beside that of its base.
struct Changed {
  Node root;
  std::optional<Spec> spec;  // nothing: it has errors

  /// `base` with some changes: what they do not touch is not read again.
  Changed(const Base& base, const std::vector<Override>& changes, Diagnostics& diagnostics)
      : root(base.root) {
    for (const Override& change : changes) apply(change, root, diagnostics);
    if (!diagnostics.has_errors()) spec = read(root, diagnostics, &base);
  }
  Changed(const Changed&) = delete;
  Changed& operator=(const Changed&) = delete;
};

/// What a study asks of every flight. Where the spec gives no model, compiling it tells why.
void add_outputs(const Spec& spec, StudyPlan& plan, Diagnostics& diagnostics) {
  if (spec.study->outputs.empty()) return;
  Diagnostics known;
  if (const std::optional<Model> model = lower(spec, known))
    plan.outputs = plan_of(spec.study->outputs, *model, diagnostics);
}

/// Spec to bundle. @param changes  that made the spec what it is
std::optional<Bundle> bundle_of(const Spec& spec, const Origin& origin,
                                const std::vector<Override>& changes, const Wanted& wanted,
                                Diagnostics& diagnostics) {
  std::optional<Model> model = lower_finite(spec, diagnostics);
  if (!model) return std::nullopt;
  require_one_machine(*model);
  return emit(std::move(*model), spec, origin, changes, wanted, diagnostics);
}

constexpr std::size_t kEnoughFaults = 50;

// So many members of a study are checked, fewer of a large spec.
constexpr std::size_t kCheckedMembers = 10'000;
// Checking takes about a microsecond for every three of these units: some seconds in all.
constexpr std::size_t kCheckedWork = 10'000'000;

std::size_t count_values(const Node& node) {
  std::size_t count = 1;
  for (const Node& item : node.items) count += count_values(item);
  return count;
}

/// @param base  that the members are made of
std::size_t members_to_check(const Node& base, const Spec& spec) {
  Diagnostics known;  // compiling the spec itself has told
  const std::optional<Model> model = lower(spec, known);
  const std::size_t coordinates = model ? model->coordinates.size() : 0;
  const std::size_t work = count_values(base) + 10 * coordinates;
  return std::min(kCheckedMembers, std::max<std::size_t>(1, kCheckedWork / work));
}

}  // namespace

struct LoadedSpec::Parts {
  std::shared_ptr<const Sources> texts;
  Tree tree;
  Spec spec;  // points into the tree
  std::optional<StudyMembers> study;
  std::optional<CampaignMembers> campaign;
  std::shared_ptr<const Base> alone;    // without study and campaign: what variants are made of
  std::shared_ptr<const Base> members;  // what members of a study are made of

  void make_bases() {
    Node root = tree.root;
    remove_key(root, "study");
    remove_key(root, "campaign");
    alone = members = std::make_shared<const Base>(root);
    if (!study || !study->plan.is_work_precision) return;
    remove_tolerances(root);
    members = std::make_shared<const Base>(std::move(root));
  }

  /// `base` with some changes, after those of the command line.
  std::optional<Bundle> compile_changed(const Base& base, const std::vector<Override>& changes,
                                        const Wanted& wanted, Diagnostics& diagnostics) const {
    const Changed changed(base, changes, diagnostics);
    if (!changed.spec) return std::nullopt;
    std::vector<Override> all = tree.changes;
    all.insert(all.end(), changes.begin(), changes.end());
    return bundle_of(*changed.spec, tree.origin, all, wanted, diagnostics);
  }
};

LoadResult load_spec(const CompileRequest& request, Diagnostics& diagnostics) {
  FileText file = request.text ? FileText{*request.text, {}} : read_file(request.file);
  if (!file.error.empty()) return {.io_error = file.error};
  const auto texts = std::make_shared<Sources>();
  diagnostics.keep(texts);
  const std::string name = request.file == "-" ? "<stdin>" : request.file;
  std::optional<Tree> tree =
      load(texts->add(name, std::move(file.text)), request, *texts, diagnostics);
  if (!tree) return {.bad_override = has_bad_override(diagnostics)};
  const auto parts = std::make_shared<LoadedSpec::Parts>();
  parts->texts = texts;
  parts->tree = std::move(*tree);
  std::optional<Spec> spec = read(parts->tree.root, diagnostics);
  if (!spec) return {};
  parts->spec = std::move(*spec);
  if (parts->spec.study) parts->study = members_of(*parts->spec.study, diagnostics);
  if (parts->study) add_outputs(parts->spec, parts->study->plan, diagnostics);
  if (parts->spec.campaign) parts->campaign = members_of(parts->spec, diagnostics);
  if (diagnostics.has_errors()) return {};
  parts->make_bases();
  return {.spec = LoadedSpec(parts)};
}

std::optional<Bundle> LoadedSpec::compile(const Wanted& wanted, Diagnostics& diagnostics) const {
  diagnostics.keep(parts_->texts);
  return bundle_of(parts_->spec, parts_->tree.origin, parts_->tree.changes, wanted, diagnostics);
}

const StudyPlan* LoadedSpec::study() const {
  return parts_->study ? &parts_->study->plan : nullptr;
}

std::optional<Bundle> LoadedSpec::member(std::size_t index, const Wanted& wanted,
                                         Diagnostics& diagnostics) const {
  diagnostics.keep(parts_->texts);
  return parts_->compile_changed(*parts_->members, parts_->study->overrides(index), wanted,
                                 diagnostics);
}

const CampaignPlan* LoadedSpec::campaign() const {
  return parts_->campaign ? &parts_->campaign->plan : nullptr;
}

std::vector<double> LoadedSpec::drawn(std::size_t index) const {
  return parts_->campaign->drawn(index);
}

std::optional<Bundle> LoadedSpec::campaign_member(std::size_t index, const Wanted& wanted,
                                                  Diagnostics& diagnostics) const {
  return variant(parts_->campaign->settings(index), wanted, diagnostics);
}

std::vector<std::string> LoadedSpec::campaign_settings(std::size_t index) const {
  std::vector<std::string> settings = parts_->campaign->settings(index);
  settings.insert(settings.begin(), "campaign=null");
  return settings;
}

std::optional<Bundle> LoadedSpec::variant(const std::vector<std::string>& overrides,
                                          const Wanted& wanted, Diagnostics& diagnostics) const {
  const auto texts = std::make_shared<Sources>();
  diagnostics.keep(parts_->texts);
  diagnostics.keep(texts);
  std::vector<Override> changes;
  for (const std::string& text : overrides)
    if (std::optional<Override> change = parse_override(text, *texts, diagnostics))
      changes.push_back(std::move(*change));
  if (diagnostics.has_errors()) return std::nullopt;
  return parts_->compile_changed(*parts_->alone, changes, wanted, diagnostics);
}

void LoadedSpec::check_members(Diagnostics& diagnostics, const MemberProgress& progress) const {
  if (!parts_->study) return;
  diagnostics.keep(parts_->texts);
  const std::size_t members = parts_->study->plan.members;
  const std::size_t checked =
      std::min(members, members_to_check(parts_->members->root, parts_->spec));
  for (std::size_t i = 0; i < checked; ++i) {
    if (progress) progress(i, checked);
    const std::vector<Override> changes = parts_->study->overrides(i);
    Diagnostics of_member;
    const Changed changed(*parts_->members, changes, of_member);
    if (changed.spec) lower_finite(*changed.spec, of_member);
    take_new_faults(of_member, i, changes, diagnostics);
    if (diagnostics.error_count() >= kEnoughFaults) return;
  }
  if (members > checked)
    diagnostics.note(
        Code::kStudyNotChecked, parts_->spec.study->span(),
        fmt::format("the first {} of the study's {} members were checked", checked, members));
}

const std::vector<std::string>& LoadedSpec::files() const { return parts_->tree.files; }

Span LoadedSpec::simulation_span(std::string_view key) const {
  return parts_->spec.simulation.span_of(key);
}

std::string json_schema() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"$comment", "generated by `sccompile --schema > schemas/spacecraft.schema.json`"},
                 {"title", "Twincraft spacecraft specification, version 1"}};
  schema.update(whole_unless_extending(spec_table().schema()));
  return json_text(schema);
}

std::string reference_markdown() { return reference_text(spec_table().info()); }

}  // namespace twincraft
