// What flies: the hub and the components it carries, section by section, and the questions that are
// asked of all of them.
#pragma once

#include <optional>
#include <vector>

#include "compiler/components/hub.h"
#include "compiler/components/section.h"

#define TWINCRAFT_SECTION(...)
#include "compiler/components/sections.def"
#undef TWINCRAFT_SECTION

namespace twincraft {

struct Vehicle {
  HubSpec hub;
#define TWINCRAFT_SECTION(Struct, key, noun, kind, doc) std::vector<Struct> key;
#include "compiler/components/sections.def"
#undef TWINCRAFT_SECTION
};

/// How a section is called.
struct SectionName {
  const char* key;   // "wheels"
  const char* noun;  // of one: "wheel"
};

/// Call `visit(members, SectionName)` for every section, in the order of the language.
template <class Visit>
void for_each_section(const Vehicle& vehicle, const Visit& visit) {
#define TWINCRAFT_SECTION(Struct, key, noun, kind, doc) visit(vehicle.key, SectionName{#key, noun});
#include "compiler/components/sections.def"
#undef TWINCRAFT_SECTION
}

/// What makes the component `name` as deep in the tree as it is; nothing when none is called so.
std::optional<Span> depth_span(const Vehicle& vehicle, const std::string& name);

/// Where the component `name` is called so; nothing when none is.
std::optional<Span> name_span(const Vehicle& vehicle, const std::string& name);

/// Joints and wheels, summed up to the first component with which they are more than allowed.
struct Size {
  int coordinates = 0;
  std::optional<Span> too_many_at = {};
};
Size size_of(const Vehicle& vehicle, int most);

/// At t = 0 [kg].
double total_mass(const Vehicle& vehicle);

/// Everything that a step rule can follow.
std::vector<Oscillator> oscillators(const Vehicle& vehicle);

/// Unique names, references between components, and every component's own check.
/// @param duration  of the run [s]
void check(const Vehicle& vehicle, double duration, Diagnostics& diagnostics);

/// The hub, then what others are mounted on, then all components in the order of the language.
/// @pre check() found no error
void lower(const Vehicle& vehicle, ModelBuilder& builder);

}  // namespace twincraft
