// The Python of the MJScene half. Only what a vehicle has is in it.
#pragma once

#include <string>

#include "compiler/ir/model.h"

namespace twincraft {

/// Which tables the script has.
struct MjSceneTables {
  bool is_point = false;
  bool joints = false, motors = false, sites = false, at_com = false, flows = false, jets = false;
  bool weights = false, gradients = false;
  GravityLaw gravity = GravityLaw::kNone;

  bool pulls_bodies() const {
    return gravity == GravityLaw::kBodyCom || gravity == GravityLaw::kBodyGradient;
  }
  bool pulls_at_com() const { return gravity == GravityLaw::kSystemCom; }
  bool needs_com() const { return at_com || pulls_at_com(); }
  /// Something is computed in Python at every stage.
  bool follows() const { return needs_com() || jets || gradients; }
};

/// What stands before the class of the vehicle, and the methods in it.
std::string mjscene_models(const MjSceneTables& has);
std::string mjscene_code(const MjSceneTables& has);

}  // namespace twincraft
