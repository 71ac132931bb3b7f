// What the parts of the kernel say to each other: where coordinates are, how a mount moves, what is
// pulled and how much.  Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/bsm/plan.h"
#include "runtime/forces/element_now.h"
#include "runtime/forces/field.h"
#include "runtime/forces/link_motion.h"
#include "runtime/scalar/linear.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

using namespace ::twincraft::TWINCRAFT_KERNEL;

/// Where the coordinates of links are in a state.
struct Layout {
  int omega = 0, joint = 0, joint_rate = 0, wheel = 0;
  static constexpr int kAttitude = 6;
  int position(int link) const { return joint + link - 1; }
  int rate(int link) const { return joint_rate + link - 1; }
};

/// How a mount moves, in hub axes; its velocity only where a force asks for it.
template <class S>
using MountMotion = LinkMotion<S>;

/// Of the hub, for a rate yet to be told.
template <class S>
MountMotion<S> hub_itself() {
  const S zero(0.0), one(1.0);
  return {{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}, {}, {}, {}};
}

/// Mass, and mass times place from B.
template <class S>
struct Moment {
  S mass{};       // [kg]
  Vec<S> moment;  // [kg m]

  Moment& operator+=(const Moment& o) {
    mass += o.mass;
    moment += o.moment;
    return *this;
  }
};

/// The same in every lane that T has for one of H.
template <class T, class H>
Vec<T> spread(const Vec<H>& v) {
  return {T(v.x), T(v.y), T(v.z)};
}
template <class T, class H>
Sym<T> spread(const Sym<H>& m) {
  return {T(m.xx), T(m.yy), T(m.zz), T(m.xy), T(m.xz), T(m.yz)};
}
template <class T, class H>
Field<T> spread(const Field<H>& field) {
  return {T(field.mu), spread<T>(field.r), T(field.inverse_r2), T(field.strength),
          field.has_gradient};
}

/// One limb's number of those in the lanes of S.
template <class H, class S>
H picked(const S& value, std::size_t limb) {
  if constexpr (kLimbs<H, S> == 1) {
    return value;
  } else {
    return lane(value, limb);
  }
}
template <class H, class S>
Vec<H> picked(const Vec<S>& v, std::size_t limb) {
  return {picked<H>(v.x, limb), picked<H>(v.y, limb), picked<H>(v.z, limb)};
}
template <class H, class S>
Mat<H> picked(const Mat<S>& m, std::size_t limb) {
  return {picked<H>(m.x, limb), picked<H>(m.y, limb), picked<H>(m.z, limb)};
}
template <class H, class S>
LinkMotion<H> picked(const LinkMotion<S>& m, std::size_t limb) {
  return {picked<H>(m.dcm_WL, limb), picked<H>(m.omega, limb), picked<H>(m.r_LB, limb),
          picked<H>(m.v_LB, limb)};
}
/// Add a number to one limb's.
template <class H, class S>
void add_to(S& value, std::size_t limb, const H& more) {
  if constexpr (kLimbs<H, S> == 1) {
    value += more;
  } else {
    set_lane(value, limb, lane(value, limb) + more);
  }
}
template <class H, class S>
void add_to(Vec<S>& v, std::size_t limb, const Vec<H>& more) {
  add_to<H>(v.x, limb, more.x);
  add_to<H>(v.y, limb, more.y);
  add_to<H>(v.z, limb, more.z);
}

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
