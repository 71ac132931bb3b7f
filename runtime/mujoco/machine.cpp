// See machine.h.
#include "runtime/mujoco/machine.h"

#include "runtime/mujoco/round_wheels.h"

namespace twincraft {
namespace {

MujocoModel load(const Model& model, const std::string& mjcf) {
  MujocoModel loaded = load_mjcf(mjcf);
  restore_exact_masses(model.tree, *loaded);
  return loaded;
}

Placement placement_of(MujocoFrame frame) {
  return frame == MujocoFrame::kComoving ? Placement::kAligned : Placement::kRaw;
}

FieldFrame field_frame(MujocoFrame frame) {
  return frame == MujocoFrame::kComoving ? FieldFrame::kFalling : FieldFrame::kInertial;
}

}  // namespace

MujocoMachine::MujocoMachine(const Model& model, const std::string& mjcf)
    : initial(model.initial),
      start(inputs_at(model, 0.0)),
      placement(placement_of(model.engines.frame)),
      law(model.gravity.mujoco),
      loaded(load(model, mjcf)),
      round_wheels(make_wheels_round(model.tree, *loaded)),
      map(map_tree(model, *loaded)),
      exchange(model.assembly, map),
      passive(model.assembly, map, *loaded),
      draining(model, *loaded),
      link_forces(model.forces),
      propellant(model.tanks),
      forces(model, law, gravity_elements(model), field_frame(model.engines.frame)) {
  if (draining.empty()) hide_pictures(*loaded);
}

MujocoModel MujocoMachine::model_to_drain() const {
  if (draining.empty()) return nullptr;
  MujocoModel own = copy_of(*loaded);
  hide_pictures(*own);
  return own;
}

}  // namespace twincraft
