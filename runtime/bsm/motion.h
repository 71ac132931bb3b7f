// Where all links are and how they move, in plain doubles: for proofs, not for inside a step.
// Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "runtime/bsm/tree.h"
#include "runtime/forces/forces.h"

namespace twincraft::bsm {

/// In hub axes. One entry per link.
struct Motion {
  std::vector<LinkPose> poses;
  std::vector<LinkRate> rates;
};

/// All links at the hub's place and at rest, to be moved one by one.
Motion at_rest(const Tree& tree);

/// Where link `i` is and how it moves, from its parent's entry. @pre i > 0
void move_link(const Tree& tree, std::size_t i, std::span<const double> q,
               std::span<const double> q_dot, Motion& motion);

/// Move them all.
void move_links(const Tree& tree, std::span<const double> q, std::span<const double> q_dot,
                const Vector3d& omega_BN_B, Motion& motion);
/// The same with a memory of its own.
Motion motion_of(const Tree& tree, std::span<const double> q, std::span<const double> q_dot,
                 const Vector3d& omega_BN_B);

}  // namespace twincraft::bsm
