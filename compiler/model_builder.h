// What a component may add to the model. Each call adds to both halves at once, so that no
// component can forget one; the ledger entries and names pass through here and nowhere else.
//
// Wheels are where the halves differ. The analytic half carries a massless wheel's tensor on its
// mount. MuJoCo needs a body with a mass, so the tree gives the wheel its own tensor and a token
// mass, and takes the token back out of the mount (`compensate`), so that mount and wheel together
// are the massless-wheel vehicle exactly. For gravity the wheel's tensor adds to the first element
// of its mount in both halves: mount and massless wheel are one rigid body.
// Tested by tests/compiler/model_builder_test.cpp.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compiler/ir/model.h"

namespace twincraft {

/// A link and the tree body that stands for it.
struct Mount {
  int link = 0;
  int body = 0;
};

/// Bodies nested below the hub that MuJoCo's XML reader still loads: tinyxml2 stops at an element
/// depth of 100, and mujoco, worldbody, hub and the last body's joint take the others.
inline constexpr int kMaximumTreeDepth = 95;

class ModelBuilder {
 public:
  explicit ModelBuilder(EngineControls controls);

  /// The hub; called once, first.
  void add_hub();

  /// A link on a joint, in both halves. The joint's name is the link's.
  Mount add_link(const Mount& parent, const std::string& name, const Joint& joint);

  /// Where a named component can be mounted on. @pre a link of that name was added
  Mount find_mount(const std::string& name) const;

  /// Put mass on a link, in both halves. @pre the link's first element has a positive mass
  void add_mass(const Mount& mount, const MassElement& element);

  /// A balanced wheel: gyrostat of its mount here, a body with a hinge there. `element` is the
  /// wheel's mass (zero: massless), place and tensor in mount axes; `rotor.link` is set here.
  /// @pre the mount has mass of its own. @return the index of the rotor
  int add_wheel(const Mount& mount, const Rotor& rotor, const MassElement& element);

  /// @param index     the link of a joint coordinate, the rotor of a wheel
  /// @param position  initial [rad] or [m]; a wheel has none
  /// @param rate      initial [rad/s] or [m/s]
  void add_coordinate(Coordinate::Kind kind, const std::string& name, int index, double position,
                      double rate);
  void add_load(Load load);

  /// Everything collected, with the tree's inertials formed from the ledger.
  Model build() &&;

 private:
  struct MasslessWheel {
    Mount mount;
    MassElement element;
  };

  void form_inertials();
  void carry_massless_wheels();
  void refuse_deep_chains();

  Model model_;
  std::map<std::string, Mount> mounts_;
  std::vector<MasslessWheel> massless_;
};

}  // namespace twincraft
