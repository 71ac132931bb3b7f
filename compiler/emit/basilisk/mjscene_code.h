// The Python of the MJScene half. Only what a vehicle has is in it.
#pragma once

#include <string>

#include "compiler/ir/model.h"

namespace twincraft {

/// Which tables the script has.
struct MjSceneTables {
  bool is_point = false;
  bool joints = false, sites = false, at_com = false, flows = false, jets = false;
  bool gyration = false;
  GravityLaw gravity = GravityLaw::kNone;
  bool is_adaptive = false;
};

std::string mjscene_code(const MjSceneTables& has);

}  // namespace twincraft
