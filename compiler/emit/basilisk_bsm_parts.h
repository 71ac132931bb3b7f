// The vehicle in parts that Basilisk's state effectors know. They attach to the hub alone, so what
// can be written is a hub with wheels, tanks and slosh, and unbranched chains of hinges or of
// slides on it; the last hinge of a chain may be a wheel.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/emit/printed.h"
#include "compiler/ir/model.h"

namespace twincraft {

// A wheel at the end of a chain is a body of its own there, with this mass [kg] of its mount's.
inline constexpr double kTokenMass = 1.0e-6;

/// Links that follow one another, from the hub out.
struct Chain {
  std::string name;
  std::vector<int> links;
  std::optional<int> wheel = {};  // Assembly::rotors entry that is its last hinge
};

struct BsmParts {
  std::vector<Chain> chains;
  std::vector<int> particles, pendulums;  // links that slosh; of a pendulum the first
  std::vector<Remark> refusals;           // none: all of the vehicle is in the parts
  std::vector<Remark> notes;              // what Basilisk has otherwise
};

BsmParts bsm_parts(const Model& model);

const Link& link_at(const Model& model, int index);
const Rotor& rotor_at(const Model& model, int index);
/// Whose link it is: `wing` of `wing.2`.
std::string component_of(const Link& link);
bool has_motor(const Model& model, const Chain& chain);

}  // namespace twincraft
