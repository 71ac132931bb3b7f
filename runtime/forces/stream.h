// Propellant that leaves as a jet (`depletion: {momentum: jet}`): what a tank's own loss of mass
// leaves out.
//
// The engines let an element of a tank shrink where it is: what it loses vanishes with the velocity
// it has there, and no force acts. In truth it flows to the nozzle, at rate mdot > 0, and leaves
// with the velocity of the nozzle (what it has beyond that is the thrust). With E the element's
// centre, P the nozzle, v their inertial velocities as points of the bodies that carry them:
//   momentum lost        mdot v_P  in place of  mdot v_E
//   momentum in the line mdot (r_P - r_E), which turns and stretches at the rate mdot (v_P - v_E)
// so the force -2 mdot (v_P - v_E) acts: the Coriolis force of the stream, spread evenly along its
// straight line, half of it felt at either end,
//   -mdot (v_P - v_E) at P on the nozzle's body, the same at E on the element's body,
// and, as an extended element draws together onto its centre and so gives back its turning,
//   +mdot k omega on the element's body, k its inertia per mass about E.
// On one rigid body that turns about a fixed centre of mass this is I omega' = -(I' + mdot l^2)
// omega, jet damping. Steady flow: the mass in the line and its acceleration are neglected, so is
// the kick of -/+ mdot (r_P - r_E) when the flow starts or stops.
//
// Only differences of velocities enter, so a common one costs no digit.
// Tested by tests/components/jet_test.cpp.
#pragma once

#include <array>

#include "compiler/ir/forces.h"
#include "compiler/ir/inputs.h"
#include "runtime/forces/link_motion.h"

namespace twincraft::TWINCRAFT_KERNEL {

template <KernelScalar S>
class StreamLaw {
 public:
  static constexpr std::size_t kLinks = 2;  // the nozzle's, the element's

  void set(std::size_t l, const Stream& from) {
    set_lane(r_PL_, l, from.r_PL_L);
    set_lane(r_EL_, l, from.r_EL_L);
    set_lane(k_, l, from.k_L);
  }
  /// @return whether it acts
  bool hold(std::size_t l, const Stream& from, const auto& inputs) {
    const Number<S> flow = inputs[inputs.layout.nozzle_flow(from.nozzle)], nothing(0.0);
    const Number<S> mdot = chosen(flow > nothing, Number<S>(from.part) * flow, nothing);
    set_lane(mdot_, l, mdot);
    return !vanishes(mdot);
  }
  /// Add what it does to its links, about the origin of each.
  void add(const Surroundings<S>&, const std::array<LinkMotion<S>, kLinks>& links,
           std::array<Pull<S>, kLinks>& pulls) const {
    const auto& [nozzle, element] = links;
    const Vec<S> r_PL = nozzle.dcm_WL * r_PL_, r_EL = element.dcm_WL * r_EL_;
    const Vec<S> force = -mdot_ * (nozzle.velocity_at(r_PL) - element.velocity_at(r_EL));
    pulls[0].add(force, r_PL);
    pulls[1].add(force, r_EL);
    pulls[1].torque += mdot_ * (element.dcm_WL * (k_ * transposed(element.dcm_WL, element.omega)));
  }

 private:
  Vec<S> r_PL_, r_EL_;
  Sym<S> k_;
  S mdot_{};  // [kg/s]
};

}  // namespace twincraft::TWINCRAFT_KERNEL
