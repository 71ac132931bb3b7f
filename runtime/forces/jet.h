// Propellant that leaves as a jet (`depletion: {momentum: jet}`): what a tank's own loss of mass
// leaves out, as wrenches for both engines.
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
#pragma once

#include <span>
#include <vector>

#include "compiler/ir/inputs.h"
#include "runtime/forces/forces.h"

namespace twincraft {

class JetModel {
 public:
  explicit JetModel(const Model& model);

  /// No propellant leaves as a jet, at any time.
  bool is_absent() const { return nozzles_.empty(); }

  /// What may feel something: the links of nozzles and of what drains, parents before children.
  const std::vector<int>& links() const { return links_; }

  void hold(const Inputs& inputs);

  /// Something flows.
  bool acts() const { return acts_; }

  /// Add to the wrenches of links(). @param links, rates  read at links() @return of what it added
  Work add(std::span<const LinkPose> links, std::span<const LinkRate> rates,
           std::span<Wrench> wrenches) const;

 private:
  struct Source {
    int tank;
    int link;
    double part;  // of what leaves the tank
    Vector3d r_EL_L;
    Matrix3d k_L;  // [m^2] inertia per mass about E
  };
  struct Outlet {
    Nozzle nozzle;
    double flow;  // [kg/s] held
  };
  struct Point {
    Vector3d r_B, v;  // [m] from the hub origin, [m/s]
  };
  static Point point_of(int link, const Vector3d& r_L, std::span<const LinkPose> links,
                        std::span<const LinkRate> rates);
  template <class Each>
  void for_each_stream(const Each& each) const;

  std::vector<Source> sources_;
  std::vector<Outlet> nozzles_;
  std::vector<int> links_;
  bool acts_ = false;
};

}  // namespace twincraft
