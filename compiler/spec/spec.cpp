// The sections of a spec and what must hold between them. Tested by tests/compiler/spec_test.cpp.
#include "compiler/spec/spec.h"

#include <fmt/format.h>

#include <algorithm>

namespace twincraft {
namespace {

constexpr const char* kFormat = "spacecraft/1";

// A vehicle of this size takes a second or two to compile; a slip in a number of segments, or
// malice, would fill the memory.
constexpr int kMostCoordinates = 10'000;

constexpr const char* kExtendsDoc =
    "Another spec that this one starts from: a path from the folder of this file. Maps merge by "
    "key and lists of named members by `name`; other values and lists replace what they meet, and "
    "an explicit `null` takes an inherited key away. The file lies in the folder tree of the "
    "compiled spec: its folder and those below, or the tree of the nearest folder above that holds "
    "a file `.twincraft`. At most 16 files follow one another. The digest in a report is that of "
    "the texts of all files, the compiled one first.";

}  // namespace

bool names_stored(const Spec& spec) {
  return std::ranges::find(spec.references, ReferenceKind::kStored) != spec.references.end();
}

const Table<Spec>& spec_table() {
  static const Table<Spec> table = Table<Spec>{
      "spec",
      "One spacecraft, its surroundings, and the run that compares both engines on it. A plain "
      "number is in SI units; a text such as `12 deg` carries its unit. Quotes "
      "about either change nothing. Units are those of UDUNITS-2. Where its database rounds a "
      "multiple of the pound, the exact value holds: a slug is 1 lbf s2/ft. In SI units no "
      "quantity may exceed 1e30, and one that must be positive, other than a time, is at least "
      "1e-30: the engines form products of up to ten quantities, and a double ends at 1e-308 and "
      "1e308.",
      {
          required(
              "format", &Spec::format, text(),
              "The language's version: `spacecraft/1`. By convention the first key; the keys of a "
              "map have no order, so another place is no fault."),
          optional("extends", &Spec::extends, maybe(text()), kExtendsDoc),
          optional("drop", &Spec::drop, maybe(list_of(name())),
                   "Names of components of the extended spec to leave out. They are removed before "
                   "this spec's own are put in."),
          required("name", &Spec::name, name(), "Names the emitted files."),
          optional("description", &Spec::description, text(), "Free text."),
          required("hub", static_cast<HubSpec Spec::*>(&Spec::hub), object(hub_table()),
                   "The body that carries the rest."),
#define TWINCRAFT_SECTION(Struct, key, noun, kind, doc) \
  optional(#key, static_cast<std::vector<Struct> Spec::*>(&Spec::key), list_of(kind), doc),
#include "compiler/components/sections.def"
#undef TWINCRAFT_SECTION
          optional("environment", &Spec::environment, object(environment_table()),
                   "Default: deep space."),
          optional("initial", &Spec::initial, object(initial_table()),
                   "Default: at rest at the origin of N."),
          optional("simulation", &Spec::simulation, object(simulation_table()),
                   "Integrator, step, duration."),
          optional("engines", &Spec::engines, object(engines_table()),
                   "Controls of the comparison."),
          optional("agreement", &Spec::agreement, object(agreement_table()),
                   "Tolerances of the verdict."),
          optional("references", &Spec::references, list_of(reference_kind()),
                   "Truths to compare each engine with: `kepler`, the two-body orbit; `spin_up`, a "
                   "rigid body under a constant torque about a principal axis; `torque_free`, a "
                   "rigid body that tumbles by itself; `tsiolkovsky`, the rocket equation; "
                   "`stored`, the states of the section `stored`. One that does not apply to the "
                   "vehicle is an error."),
          optional("stored", &Spec::stored, maybe(object(stored_table())),
                   "States computed elsewhere, for `references: [stored]`."),
          optional("study", &Spec::study, maybe(object(study_table())),
                   "Run many variants of this spec instead of one."),
          optional("campaign", &Spec::campaign, maybe(object(campaign_table())),
                   "Run many members with drawn values instead of one."),
      }}.at_most_one_of({"study", "campaign"});
  return table;
}

bool check_format(const Node& root, Diagnostics& diagnostics) {
  const Node* format = root.find("format");
  if (format == nullptr || !format->is_scalar() || format->scalar == kFormat) return true;
  diagnostics
      .error(Code::kUnsupportedFormat, format->span,
             fmt::format("format `{}` is not read by this program", format->scalar))
      .with_hint(fmt::format("it reads `{}`", kFormat));
  return false;
}

void check(const Spec& spec, Diagnostics& diagnostics) {
  const Size size = size_of(spec, kMostCoordinates);
  if (size.too_many_at) {
    diagnostics
        .error(
            Code::kTooManyParts, *size.too_many_at,
            fmt::format("here the vehicle gets more than {} joints and wheels", kMostCoordinates))
        .with_hint("check the numbers of `segments`");
    return;
  }
  check(spec, spec.simulation.duration, diagnostics);
  check(spec.initial, spec.environment, diagnostics);
  check(spec.simulation, oscillators(spec), size.coordinates, diagnostics);
  check(spec.engines, spec.environment, diagnostics);
  check(spec.agreement, spec.references, diagnostics);
  if (spec.stored)
    check(*spec.stored, names_stored(spec), spec.environment, spec.simulation.duration,
          diagnostics);
  check_point_mass(spec, diagnostics);
  if (spec.study) members_of(*spec.study, diagnostics);
}

}  // namespace twincraft
