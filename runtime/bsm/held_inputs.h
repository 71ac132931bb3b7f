// What acts on the analytic engine until the next event, in the numbers the kernel is asked in: a
// double, or one that knows derivatives or a tape (runtime/scalar/scalar.h).
#pragma once

#include <algorithm>
#include <concepts>
#include <span>
#include <type_traits>
#include <vector>

#include "compiler/ir/inputs.h"
#include "compiler/ir/model.h"

namespace twincraft::bsm {

/// Inputs, in numbers N.
template <class N>
struct NumbersOfInputs {
  struct Tank {  // see Drain
    N full{}, spent{}, since{}, flow{};
  };
  InputLayout layout;
  N since{};  // [s]
  std::vector<N> u;
  std::vector<Tank> tanks;

  /// Those, as constants.
  explicit NumbersOfInputs(const Inputs& of)
      : layout(of.layout), since(of.since), u(of.u.begin(), of.u.end()) {
    for (const Drain& tank : of.tanks)
      tanks.push_back({N(tank.full), N(tank.spent), N(tank.since), N(tank.flow)});
  }
  NumbersOfInputs() = default;

  const N& operator[](int i) const { return u[static_cast<std::size_t>(i)]; }
  Eigen::Matrix<N, 3, 1> vector(int i) const {
    return {(*this)[i], (*this)[i + 1], (*this)[i + 2]};
  }
};

template <class N>
using InputsIn = std::conditional_t<std::same_as<N, double>, Inputs, NumbersOfInputs<N>>;

template <class N>
struct HeldInputsIn {
  using Vector = Eigen::Matrix<N, 3, 1>;

  std::vector<N> effort;        // [N m] or [N], one per link but the hub
  std::vector<N> motor_torque;  // [N m], one per rotor, on the rotor
  // Per link, in its axes and about its origin.
  std::vector<Vector> force_L, torque_L;  // [N], [N m]
  std::vector<Vector> force_at_center_L;  // [N] the same, but at the system centre of mass
  bool acts_at_center = false;
  bool acts_on_hub = false, acts_on_limbs = false;  // a load, on the hub or on another link
  InputsIn<N> inputs;  // all of them, for tanks and the forces that follow the motion of links

  static HeldInputsIn none(const Assembly& assembly) {
    const std::vector<Vector> nothing(assembly.links.size(), Vector(N(0.0), N(0.0), N(0.0)));
    return {std::vector<N>(assembly.links.size() - 1),
            std::vector<N>(assembly.rotors.size()),
            nothing,
            nothing,
            nothing,
            false,
            false,
            false,
            {}};
  }
  /// @param loads  of the model the inputs are of. No allocation.
  void set(const InputsIn<N>& now, std::span<const Load> loads);
};

using HeldInputs = HeldInputsIn<double>;

template <class N>
void HeldInputsIn<N>::set(const InputsIn<N>& now, std::span<const Load> loads) {
  inputs = now;
  const InputLayout& at = inputs.layout;
  std::copy_n(inputs.u.begin() + at.effort(0), effort.size(), effort.begin());
  std::copy_n(inputs.u.begin() + at.motor_torque(0), motor_torque.size(), motor_torque.begin());
  for (std::vector<Vector>* all : {&force_L, &torque_L, &force_at_center_L})
    std::ranges::fill(*all, Vector(N(0.0), N(0.0), N(0.0)));
  acts_at_center = acts_on_hub = acts_on_limbs = false;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const Load& load = loads[i];
    const auto link = static_cast<std::size_t>(load.link);
    const Vector force = inputs.vector(at.force(static_cast<int>(i)));
    const Vector torque = inputs.vector(at.torque(static_cast<int>(i)));
    bool& acts = link == 0 ? acts_on_hub : acts_on_limbs;
    if constexpr (std::same_as<N, double>) {
      acts = acts || !force.isZero(0.0) || !torque.isZero(0.0);
    } else {
      acts = true;  // it may be another number yet
    }
    torque_L[link] += torque;
    if (load.r_FL_L) {
      const Vector r(N(load.r_FL_L->x()), N(load.r_FL_L->y()), N(load.r_FL_L->z()));
      force_L[link] += force;
      torque_L[link] +=
          Vector(r.y() * force.z() - r.z() * force.y(), r.z() * force.x() - r.x() * force.z(),
                 r.x() * force.y() - r.y() * force.x());
    } else {
      force_at_center_L[link] += force;
      if constexpr (std::same_as<N, double>) {
        acts_at_center = acts_at_center || !force.isZero(0.0);
      } else {
        acts_at_center = true;  // it may be another number yet
      }
    }
  }
}

extern template struct HeldInputsIn<double>;

}  // namespace twincraft::bsm
