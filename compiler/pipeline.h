// The compiler from text to bundle: load, read, check, lower, verify, emit. The file to read first.
// Tested by tests/compiler/pipeline_test.cpp, tests/golden and tests/malformed.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/ir/bundle.h"
#include "compiler/ir/campaign.h"

namespace twincraft {

/// What to compile: a spec's text and what the command line changes in it.
struct CompileRequest {
  std::string file;                      // as given; `-` is standard input
  std::vector<std::string> overrides;    // `PATH=VALUE`
  std::optional<std::string> text = {};  // of the spec, when it is no file; `file` is its name then
};

/// Names of targets, each of them in compiler/emit/target.h.
using Wanted = std::vector<std::string_view>;

/// Called before each member of a study that is checked: how many are done, and of how many.
using MemberProgress = std::function<void(std::size_t done, std::size_t planned)>;

/// A spec that was read without an error, with all that it is made of: its texts, its syntax tree
/// and the command line's changes. Copies share it. Any number of threads may compile from one at
/// once, each with diagnostics of its own; nothing compiled is kept.
///
/// Members and variants are read where they differ from the spec, and are what reading all of them
/// would give.
///
/// What is compiled holds the wanted targets and no others; it is nothing where the spec, as
/// changed, has errors. All faults of a stage are reported; a later stage runs only after an
/// earlier one without errors.
class LoadedSpec {
 public:
  /// The spec itself. @throws InternalError when the two halves of the model are not one machine;
  /// so do the others
  std::optional<Bundle> compile(const Wanted& wanted, Diagnostics& diagnostics) const;

  /// The study's members; nothing when the spec has none.
  const StudyPlan* study() const;
  /// @pre index < study()->members
  std::optional<Bundle> member(std::size_t index, const Wanted& wanted,
                               Diagnostics& diagnostics) const;
  /// Its campaign; nothing when the spec has none. The spec itself is the nominal vehicle.
  const CampaignPlan* campaign() const;
  /// The numbers drawn for a member, in the order of campaign()->drawn, SI.
  /// @pre index < campaign()->members, here and below
  std::vector<double> drawn(std::size_t index) const;
  /// The member as a vehicle; nothing when what was drawn gives none.
  std::optional<Bundle> campaign_member(std::size_t index, const Wanted& wanted,
                                        Diagnostics& diagnostics) const;
  /// What makes the member of the spec, `PATH=VALUE` each: given by `--set` it flies that member
  /// alone, to the last digit.
  std::vector<std::string> campaign_settings(std::size_t index) const;

  /// Report what is wrong with the members of a study beyond what is wrong with the spec itself,
  /// short of compiling them to the end. @pre compile() gave a bundle
  void check_members(Diagnostics& diagnostics, const MemberProgress& progress = {}) const;

  /// The spec with further changes, without its study or campaign.
  /// @param overrides  `PATH=VALUE`, after those of the command line
  std::optional<Bundle> variant(const std::vector<std::string>& overrides, const Wanted& wanted,
                                Diagnostics& diagnostics) const;

  /// The files that it was read from: the spec, then those that it extends, in turn. A text and
  /// standard input are no files.
  const std::vector<std::string>& files() const;

  /// Where `simulation` has `key`, or what stands for it.
  Span simulation_span(std::string_view key) const;

 private:
  struct Parts;
  friend struct LoadResult load_spec(const CompileRequest& request, Diagnostics& diagnostics);
  explicit LoadedSpec(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}

  std::shared_ptr<const Parts> parts_;
};

struct LoadResult {
  std::optional<LoadedSpec> spec = {};  // nothing when there were errors
  std::string io_error = {};            // the file could not be read: exit code 3
  bool bad_override = false;            // an override is no PATH=VALUE: exit code 2
};

/// Text to a spec in which every default is filled in and every reference holds.
LoadResult load_spec(const CompileRequest& request, Diagnostics& diagnostics);

/// The compiler contradicts itself: a bug of ours, with a text that asks to report it.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

/// The JSON Schema of the language (draft-07), as checked in under schemas/.
std::string json_schema();
/// The reference text generated from the field tables (Markdown).
std::string reference_markdown();

}  // namespace twincraft
