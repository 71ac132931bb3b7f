// Small vehicles made by hand, both halves of the model from one ledger, for tests that need a
// model without a compiler. Tested by being agreed upon: see tests/runtime/mujoco_test.cpp.
#pragma once

#include <Eigen/Core>
#include <string>

#include "compiler/ir/model.h"

namespace twincraft::test {

/// Collects one vehicle. Links are numbered in the order they are added; the hub is 0.
class SampleVehicle {
 public:
  SampleVehicle(const std::string& name, const MassElement& hub);

  /// A link on a joint. @return its number
  int add_link(const std::string& name, int parent, const Joint& joint, const MassElement& element,
               double position = 0.0, double rate = 0.0);

  /// A balanced wheel. Massless: its tensor is on the mount, and the tree's token is taken out.
  void add_wheel(const std::string& name, int link, const Vector3d& axis_L, const Vector3d& r_WL_L,
                 double mass, double speed, double torque);

  Model& model() { return model_; }

 private:
  TreeBody& body_of(int link);

  Model model_;
};

/// One body, centre of mass off the origin, a tensor with all six numbers.
Model offset_hub();

/// A hub, three massless wheels, two panels, as in the paper's eleven coordinates.
Model wheels_and_panels();

/// A hub with two chains of `segments` hinged bars.
Model two_chains(int segments);

/// Everything at once: a slide, a heavy wheel on a panel, a branch, loads and motors.
Model menagerie();

/// A seeded random state of `model` in the quaternion chart: attitude anywhere, rates below
/// 0.2 rad/s, joints within 0.4, wheels within 100 rad/s, the hub at rest at zero.
Eigen::VectorXd sample_state(const Model& model, unsigned seed);

}  // namespace twincraft::test
