// One half of a Basilisk script: the vehicle in one of Basilisk's two formulations of its dynamics.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "compiler/emit/printed.h"
#include "compiler/ir/model.h"

namespace twincraft {

// The halves, as a script's command line and its files call them.
inline constexpr const char* kBsmHalf = "bsm";
inline constexpr const char* kMjSceneHalf = "mjscene";

struct Half {
  std::vector<Remark> refusals;      // why it is not written; none: it is
  std::vector<Remark> notes;         // what it writes otherwise than the spec says it
  std::set<std::string> simulation;  // what it imports of Basilisk.simulation
  std::string tables;                // its data, at the top of the script
  std::string models;                // what stands before the class of the vehicle
  std::string code;                  // its methods
};

/// State effectors on a Spacecraft, solved by back-substitution.
Half bsm_half(const Model& model);
/// Bodies of an MJScene, solved by MuJoCo.
Half mjscene_half(const Model& model);

bool is_adaptive(Method method);

/// What is fixed on the hub, tanks apart.
MassProperties hub_of(const Model& model);

/// `A`, `B` and `C`: in backticks, for a sentence.
std::string enumeration(const std::vector<std::string>& names);

}  // namespace twincraft
