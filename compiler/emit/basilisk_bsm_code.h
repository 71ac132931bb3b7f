// The Python of the BSM half: methods that make effectors of the script's tables. Only what a
// vehicle has is in it.
#pragma once

#include <string>

#include "compiler/ir/model.h"

namespace twincraft {

/// Which tables the script has.
struct BsmTables {
  bool is_point = false;
  bool wheels = false, wheel_motors = false;
  bool hinges = false, slides = false, rests = false, chain_motors = false;
  bool tanks = false, particles = false, pendulums = false, loads = false;
  GravityLaw gravity = GravityLaw::kNone;
};

std::string bsm_code(const BsmTables& has);

}  // namespace twincraft
