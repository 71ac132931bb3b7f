// What is left of an element of the mass ledger, in any scalar: what gravity pulls on in the kernel
// and for MuJoCo, and what the books sum up.
#pragma once

#include "runtime/scalar/linear.h"

namespace twincraft::TWINCRAFT_KERNEL {

/// See MassElement; in the axes of its link, of a planar chain in the chain's.
template <KernelScalar S>
struct ElementNow {
  S mass{};     // [kg]
  Vec<S> r_EL;  // [m]
  Sym<S> I;     // [kg m^2] about its own centre

  /// All of it.
  void set(std::size_t l, const MassElement& full) {
    set_lane(mass, l, full.mass);
    set_lane(r_EL, l, full.r_EL_L);
    set_lane(I, l, full.I_PntE_L);
  }
  /// Into other axes.
  void turn(const Mat<S>& dcm) {
    r_EL = dcm * r_EL;
    I = I.turned(dcm);
  }
  /// The share of a tank that it drains with; where it is does not change.
  void keep(const S& share, const ElementNow& full) {
    mass = share * full.mass;
    I = share * full.I;
  }
};

}  // namespace twincraft::TWINCRAFT_KERNEL
