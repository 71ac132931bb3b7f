// The hub's six equations of motion and their solution. See law.h.
// Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/bsm/law.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// The hub's accelerations, in its axes; of B in the falling frame.
template <class H>
struct HubMotion {
  Vec<H> omega_dot, a;
};

/// The hub equation's matrix, factored: Schur complement of M.
template <class H>
struct HubFactors {
  /// In place: a copy would be read, wider than it was written, while it is on its way to memory.
  [[gnu::always_inline]] void factor(const Law<H>& hub) {
    M = Ldl<H>(hub.M);
    coupling = {M.solve(hub.H.row_x()), M.solve(hub.H.row_y()), M.solve(hub.H.row_z())};
    const Mat<H>& c = coupling;  // D - C A^-1 B, symmetric
    schur = Ldl<H>({hub.J.xx - dot(hub.H.row_x(), c.x), hub.J.yy - dot(hub.H.row_y(), c.y),
                    hub.J.zz - dot(hub.H.row_z(), c.z), hub.J.xy - dot(hub.H.row_x(), c.y),
                    hub.J.xz - dot(hub.H.row_x(), c.z), hub.J.yz - dot(hub.H.row_y(), c.z)});
  }
  [[gnu::always_inline]] HubMotion<H> solve(const Law<H>& hub) const {
    const Vec<H> omega_dot = schur.solve(transposed(coupling, hub.f0) - hub.n0);
    return {omega_dot, -M.solve(hub.f0) - coupling * omega_dot};
  }
  Ldl<H> M;
  Mat<H> coupling;  // M^-1 H^T
  Ldl<H> schur;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
