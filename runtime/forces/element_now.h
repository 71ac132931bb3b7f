// What is left of an element of the mass ledger.
#pragma once

#include <span>

#include "compiler/ir/mass.h"

namespace twincraft {

/// An element as it is now: all of it, or its tank's share.
struct ElementNow {
  MassElement full;  // at t = 0
  double share = 1.0;

  double mass() const { return share * full.mass; }            // [kg]
  Matrix3d I_PntE_L() const { return share * full.I_PntE_L; }  // [kg m^2]
  /// @param shares  of every tank
  void drain(std::span<const double> shares) {
    if (full.tank >= 0) share = shares[static_cast<std::size_t>(full.tank)];
  }
};

}  // namespace twincraft
