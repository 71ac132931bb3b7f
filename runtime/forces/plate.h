// A flat plate in a flow: F = -1/2 rho C A |v.n| (v.n) n, v the velocity of its centre relative to
// an atmosphere that turns about N's third axis, rho growing evenly in time.
#pragma once

#include <array>

#include "compiler/ir/forces.h"
#include "compiler/ir/inputs.h"
#include "runtime/forces/link_motion.h"

namespace twincraft::TWINCRAFT_KERNEL {

template <class S>
class PlateLaw {
 public:
  static constexpr std::size_t kLinks = 1;

  void set(std::size_t l, const Plate& from) {
    set_lane(r_PL_, l, from.r_PL_L);
    set_lane(normal_, l, from.normal_L);
    set_lane(strength_, l, from.strength);
    set_lane(growth_, l, from.growth);
    set_lane(turn_, l, from.turn);
  }
  bool hold(std::size_t, const Plate&, const Inputs&) { return true; }
  void add(const Surroundings<S>& around, const std::array<LinkMotion<S>, kLinks>& links,
           std::array<Pull<S>, kLinks>& pulls) const {
    const LinkMotion<S>& link = links[0];
    const Vec<S> r_PL = link.dcm_WL * r_PL_, n = link.dcm_WL * normal_;
    const Vec<S> r_PN_N = around.r_BN_N + around.dcm_NW * (link.r_LB + r_PL);
    const Vec<S> wind_N{-(turn_ * r_PN_N.y), turn_ * r_PN_N.x, S(0.0)};
    const Vec<S> v_W = transposed(around.dcm_NW, around.v_BN_N - wind_N) + link.velocity_at(r_PL);
    const S along = dot(v_W, n), zero(0.0);
    const S size = chosen(along < zero, -along, along);
    const S push = strength_ * (S(1.0) + growth_ * around.time) * size * along;
    pulls[0].add((zero - push) * n, r_PL);
  }

 private:
  Vec<S> r_PL_, normal_;
  S strength_{}, growth_{}, turn_{};
};

}  // namespace twincraft::TWINCRAFT_KERNEL
