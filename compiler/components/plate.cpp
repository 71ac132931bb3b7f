// See plate.h.
#include "compiler/components/plate.h"

#include <fmt/format.h>

#include "compiler/components/names.h"

namespace twincraft {

const Table<PlateSpec>& plate_table() {
  static const Table<PlateSpec> table{
      "plate",
      "A flat plate in a flow.",
      {
          required("name", &PlateSpec::name, name(), "Unique in the file."),
          optional("mount", &PlateSpec::mount, reference_to("body"), "What it is fixed on."),
          optional("position", &PlateSpec::position, vector3("m"), "Its centre."),
          optional("normal", &PlateSpec::normal, direction(), "Its normal."),
          required("area", &PlateSpec::area, quantity("m2", Range::kPositive), "Of one side."),
          optional("coefficient", &PlateSpec::coefficient, number(Range::kPositive),
                   "Of the force along the normal."),
          required("density", &PlateSpec::density, quantity("kg/m3", Range::kPositive),
                   "Of the flow at t = 0."),
          optional("growth", &PlateSpec::growth, quantity("1/s"), "Of the density, relative."),
          optional("turn", &PlateSpec::turn, quantity("rad/s"),
                   "Of the atmosphere about the third inertial axis."),
      }};
  return table;
}

void check(const PlateSpec& plate, const Context& context, Diagnostics& diagnostics) {
  check_mount(plate.mount, plate.span_of("mount"), fmt::format("plate `{}`", plate.name),
              context.names, diagnostics);
}

void lower(const PlateSpec& spec, const Vehicle&, ModelBuilder& builder) {
  const Mount mount = builder.find_mount(spec.mount);
  builder.forces().plates.push_back(
      {spec.name, mount.link, mount.point_on_link(spec.position), mount.dcm_LM * spec.normal,
       0.5 * spec.density * spec.coefficient * spec.area, spec.growth, spec.turn});
}

}  // namespace twincraft
