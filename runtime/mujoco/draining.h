// The bodies of a MuJoCo model that drain with a tank: their masses at a time, and what then leaves
// the books. Tested by tests/components/depletion_test.cpp and battery_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "compiler/ir/model.h"
#include "runtime/mujoco/motion_sums.h"

namespace twincraft {

class DrainingBodies {
 public:
  /// @pre `loaded` has the exact masses of t = 0
  DrainingBodies(const Model& model, const mjModel& loaded);

  /// Write masses and moments; one share per tank. Nothing else of the model depends on them in the
  /// stages that an evaluation calls, and no centre of mass moves in its body, so mj_setConst is
  /// not needed.
  void set_shares(std::span<const double> shares, mjModel& model) const;

  /// No body does.
  bool empty() const { return bodies_.empty(); }

  /// Rates of the books at fixed motion. @param share_rates  of every tank [1/s]
  LeavingSums leaving(const mjModel& model, const mjData& data, const Vector3d& v_BN_W,
                      const BodyCenter& center, std::span<const double> share_rates) const;

 private:
  struct Body {
    int id = 0;
    std::size_t tank = 0;
    double full_mass = 0.0;  // [kg]
    Vector3d full_moments;   // [kg m^2] about its principal axes, which stay
  };
  std::vector<Body> bodies_;
};

}  // namespace twincraft
