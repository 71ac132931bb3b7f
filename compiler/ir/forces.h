// The forces that follow the motion of links, as data; what they do is said in
// runtime/forces/list.h. Gravity and loads are not among them: see Gravity and Load in model.h.
#pragma once

#include <array>
#include <vector>

#include "compiler/ir/model.h"

namespace twincraft {

/// Propellant on its way from an element of a tank to a nozzle.
struct Stream {
  int nozzle = 0;       // Model::nozzles entry
  double part = 0.0;    // of the nozzle's flow
  int nozzle_link = 0;  // in the assembly
  int element_link = 0;
  Vector3d r_PL_L;  // [m] nozzle from the origin of its link
  Vector3d r_EL_L;  // [m] element from the origin of its own
  Matrix3d k_L;     // [m^2] the element's inertia per mass about its centre

  std::array<int, 2> links() const { return {nozzle_link, element_link}; }
};

struct Forces {
  std::vector<Stream> streams;
};

Forces forces_of(const Model& model);

/// Every link that one of them acts on, once, ascending.
std::vector<int> links_of(const Forces& forces);

}  // namespace twincraft
