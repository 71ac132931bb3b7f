// A balanced wheel in the kernel. Tested by tests/runtime/bsm_test.cpp.
#pragma once

#include "runtime/bsm/parts.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// On a link.
template <class H, class S>
requires KernelScalars<H, S>
struct RotorOn {
  Vec<S> axis_L;
  S spin_inertia{}, motor_torque{};
  S spin_up{};  // [rad/s^2] what the motor gives a wheel on a mount at rest
  // After move().
  Vec<S> axis;   // hub axes
  S momentum{};  // [kg m^2/s] about it
  Places<H, S> speed{};

  /// What the motor gives the wheel [W].
  S power(const Number<H>* state) const { return motor_torque * gather<H, S>(state, speed); }
  void hold(std::size_t l, const Number<S>& torque) {
    set_lane(motor_torque, l, torque);
    set_lane(spin_up, l, torque / lane(spin_inertia, l));
  }
  /// With its mount, which is not the hub.
  void move(const Number<H>* state, const MountMotion<S>& mount) {
    axis = mount.dcm_WL * axis_L;
    momentum = spin_inertia * (gather<H, S>(state, speed) + dot(axis, mount.omega));
  }
  void set(std::size_t l, const RotorConstants& from, int place) {
    set_lane(axis_L, l, from.axis_L);
    set_lane(spin_inertia, l, from.spin_inertia);
    speed[l % kLimbs<H, S>] = place;
  }
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
