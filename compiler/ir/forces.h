// The forces that follow the motion of links, as data; what they do is said in
// runtime/forces/list.h. A kind of force is a struct, with the links that it acts on and, unless
// the model says it all elsewhere, its fields for NAME.bsm.json; a member of Forces, and a line of
// for_each_kind(). Gravity and loads are not among them: see Gravity and Load in model.h.
#pragma once

#include <array>
#include <vector>

#include "compiler/ir/mass.h"

namespace twincraft {

/// Propellant on its way from an element of a tank to a nozzle. Nozzles, tanks and elements say it
/// all; the builder forms it of them.
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

  /// @param each  takes the word for a kind and all forces of it
  template <class Each>
  void for_each_kind(const Each& each) const {
    each("streams", streams);
  }
};

/// Every link that one of them acts on, once, ascending.
std::vector<int> links_of(const Forces& forces);

}  // namespace twincraft
