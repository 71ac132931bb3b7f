// See load.h. Tested by tests/compiler/loads_test.cpp.
#include "compiler/components/load.h"

#include <fmt/format.h>

namespace twincraft {

const Table<LoadSpec>& load_table() {
  static const Table<LoadSpec> table{
      "load",
      "A force and a torque fixed in the axes of the mount.",
      {
          required("name", &LoadSpec::name, name(), "Unique in the file."),
          optional("mount", &LoadSpec::mount, reference_to("body"), "What the load acts on."),
          optional("force", &LoadSpec::force, schedule3("N"), "Acts at `position`."),
          optional("torque", &LoadSpec::torque, schedule3("N m"), "Adds to the force's moment."),
          optional(
              "position", &LoadSpec::position,
              either(is_scalar, one_of<LoadPoint>({{"com", LoadPoint::kSystemCom}}), vector3("m")),
              "Where the force acts: a point from the mount's origin, or `com`, the system "
              "centre of mass at every instant."),
          optional("during", &LoadSpec::during, maybe(intervals()),
                   "Half-open intervals [start, end) in which the load acts; default always."),
      }};
  return table;
}

void check(const LoadSpec& load, const Context& context, Diagnostics& diagnostics) {
  const std::string who = fmt::format("load `{}`", load.name);
  check_mount(load.mount, load.span_of("mount"), who, context.names, diagnostics);
  check_acts(load.during, load.span_of("during"), who, context, diagnostics);
}

void lower(const LoadSpec& spec, const Vehicle&, ModelBuilder& builder) {
  Load load;
  load.name = spec.name;
  load.force_M = spec.force;
  load.torque_M = spec.torque;
  if (spec.during) {
    for (Schedule& component : load.force_M) component = component.during(*spec.during);
    for (Schedule& component : load.torque_M) component = component.during(*spec.during);
  }
  if (const Vector3d* point = std::get_if<Vector3d>(&spec.position)) load.r_FL_L = *point;
  builder.add_load(builder.find_mount(spec.mount), std::move(load));
}

}  // namespace twincraft
