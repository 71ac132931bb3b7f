// See hub.h. Tested by tests/compiler/hub_test.cpp.
#include "compiler/components/hub.h"

#include "compiler/components/physical.h"

namespace twincraft {

const Table<HubSpec>& hub_table() {
  static const Table<HubSpec> table{
      "hub",
      "The rigid body that carries everything else and moves freely. Its frame B has a fixed "
      "origin, which need not be its centre of mass.",
      {
          required("mass", &HubSpec::mass, quantity("kg", Range::kPositive),
                   "Of the bare hub: wheels, panels and tanks declare their own."),
          required("inertia", &HubSpec::inertia, inertia(),
                   "Of the bare hub about its own centre of mass, in B axes."),
          optional("center_of_mass", &HubSpec::center_of_mass, vector3("m"),
                   "Of the bare hub, from B."),
      }};
  return table;
}

void check(const HubSpec& hub, Diagnostics& diagnostics) {
  check_mass(hub.mass, hub.span_of("mass"), "the hub", diagnostics);
  check_inertia(hub.inertia, hub.span_of("inertia"), "the hub", diagnostics);
}

void lower(const HubSpec& hub, ModelBuilder& builder) {
  builder.add_hub();
  builder.add_mass(builder.find_mount("hub"), {"hub", hub.mass, hub.center_of_mass, hub.inertia});
}

}  // namespace twincraft
