// The elements of a vehicle on their links, as they are now, in plain doubles.
// Tested by tests/runtime/forces_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "compiler/ir/mass.h"
#include "runtime/forces/element_now.h"

namespace twincraft {

class Elements {
 public:
  struct Placed : TWINCRAFT_KERNEL::ElementNow<double> {
    std::size_t link = 0;
    int tank = -1;           // see MassElement
    double full_mass = 0.0;  // [kg] at t = 0

    Vector3d r_EL_L() const { return eigen(r_EL); }
    Matrix3d I_PntE_L() const { return eigen(I); }
  };

  /// @param by_link  of every link  @param wanted  whether to take one
  template <class Wanted>
  Elements(const std::vector<std::vector<MassElement>>& by_link, const Wanted& wanted) {
    for (std::size_t link = 0; link < by_link.size(); ++link)
      for (const MassElement& element : by_link[link])
        if (wanted(element)) add(link, element);
  }

  auto begin() const { return now_.begin(); }
  auto end() const { return now_.end(); }

  /// Let elements of tanks have these parts of their mass and inertia; one share per tank.
  void set_shares(std::span<const double> shares);

 private:
  void add(std::size_t link, const MassElement& element);

  std::vector<Placed> now_;
  struct Draining {
    std::size_t element = 0;
    TWINCRAFT_KERNEL::ElementNow<double> full;
  };
  std::vector<Draining> draining_;
};

}  // namespace twincraft
