// What the MuJoCo engines of one model share. Tested by tests/runtime/engines_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "runtime/forces/forces.h"
#include "runtime/forces/propellant_ledger.h"
#include "runtime/mujoco/draining.h"
#include "runtime/mujoco/exchange.h"
#include "runtime/mujoco/handles.h"
#include "runtime/mujoco/passive_joints.h"
#include "runtime/mujoco/tree_map.h"

namespace twincraft {

/// Never changes after it is made: any number of engines may read it, each on its own thread.
struct MujocoMachine {
  /// @throws NumericalFailure when MuJoCo does not load `mjcf`
  MujocoMachine(const Model& model, const std::string& mjcf);

  /// For one engine alone; null where no body drains, and `loaded` serves all.
  MujocoModel model_to_drain() const;

  VehicleState initial;
  Inputs start;  // of t = 0
  Placement placement;
  GravityLaw law;
  MujocoModel loaded;
  std::vector<int> round_wheels;
  TreeMap map;
  Exchange exchange;
  PassiveJoints passive;
  DrainingBodies draining;
  Forces link_forces;
  // As at t = 0: each engine begins with a copy.
  PropellantLedger propellant;
  ForceModel forces;
};

}  // namespace twincraft
