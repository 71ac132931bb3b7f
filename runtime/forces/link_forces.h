// The forces that follow the motion of links, for a double: what MuJoCo and the proofs ask. Their
// laws are those of the kernel, see list.h.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "compiler/ir/forces.h"
#include "compiler/ir/inputs.h"
#include "runtime/forces/forces.h"

namespace twincraft {

/// Where and when, for the working axes W.
struct Place {
  double time = 0.0;        // [s]
  Vector3d r_BN_N, v_BN_N;  // [m], [m/s]
  Matrix3d dcm_NW;
};

class LinkForces {
 public:
  /// @param forces  outlives it
  LinkForces(const Forces& forces, const Inputs& inputs);
  ~LinkForces();

  /// On which one of them acts, ascending; empty: there are none.
  const std::vector<int>& links() const { return links_; }

  void hold(const Inputs& inputs);
  /// One of them may do something until the next hold().
  bool acts() const;

  /// Add to the wrenches of links(). @param poses, rates  read at links() @return of what it added
  Work add(const Place& place, std::span<const LinkPose> poses, std::span<const LinkRate> rates,
           std::span<Wrench> wrenches) const;

 private:
  struct List;
  const Forces& forces_;
  std::vector<int> links_;
  std::unique_ptr<List> list_;
};

}  // namespace twincraft
