// What the kernel computes in. Its text is written once, over a scalar S that has lanes: one
// number, one per spacecraft, or one per like limb of it. All that the text asks of a scalar is the
// concept KernelScalar. It is modelled by
//   double           one spacecraft's hub, and the laws that books and MuJoCo ask
//   Pair, Batch      SIMD lanes (lanes.h)
//   Dual             a number with its partial derivatives (dual.h): exact Jacobians
//   Recorded         a place on a tape (recorder.h): the kernel as a list of operations
//
// A scalar is no condition: what depends on values is `chosen`, and a Recorded does not even
// convert to a bool. What can be zero for good `vanishes`, and that may decide about structure.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

#include "runtime/scalar/lanes.h"

namespace twincraft::TWINCRAFT_KERNEL {

/// What one lane is kept as, in states, rates and inputs.
template <class S>
struct NumberIn {
  using Type = S;
};
template <class A>
struct NumberIn<simd::batch<double, A>> {
  using Type = double;
};
template <class S>
using Number = typename NumberIn<S>::Type;

template <class S>
inline constexpr std::size_t kLanes = 1;
template <class A>
inline constexpr std::size_t kLanes<simd::batch<double, A>> = simd::batch<double, A>::size;

inline SineCosine<double> sine_cosine(double angle) { return {std::sin(angle), std::cos(angle)}; }
inline double root(double x) { return std::sqrt(x); }
inline double chosen(bool first, double a, double b) { return first ? a : b; }
inline double lane(double value, std::size_t) { return value; }
inline void set_lane(double& value, std::size_t, double to) { value = to; }
/// It is zero, and stays so however the state moves and whatever inputs may vary.
inline bool vanishes(double value) { return value == 0.0; }

/// @tparam S  a double, or something with lanes, derivatives or a tape in its place
template <class S>
concept KernelScalar = std::default_initializable<S> && std::copyable<S> &&  // S{} is zero
    requires(const S a, const S b, S to, double constant, std::size_t l, Number<S> number) {
  S(constant);  // in every lane
  S(number);
  { a + b } -> std::convertible_to<S>;
  { a - b } -> std::convertible_to<S>;
  { a* b } -> std::convertible_to<S>;
  { a / b } -> std::convertible_to<S>;
  { -a } -> std::convertible_to<S>;
  { to += a } -> std::same_as<S&>;
  { to -= a } -> std::same_as<S&>;
  { root(a) } -> std::same_as<S>;
  { sine_cosine(a) } -> std::same_as<SineCosine<S>>;
  { chosen(a > b, a, b) } -> std::same_as<S>;  // lane by lane
  // One lane, for building and for what holds until the next event; not for inside a step.
  { lane(a, l) } -> std::same_as<Number<S>>;
  set_lane(to, l, number);
  set_lane(to, l, constant);
  { vanishes(number) } -> std::same_as<bool>;
  requires kLanes<S>
  >= 1;
};

static_assert(KernelScalar<double> && KernelScalar<Pair> && KernelScalar<Batch>);

/// An S whose lane l is number(l). Two numbers become one register at once: a register read back
/// right after its lanes were stored one by one has to wait for them.
template <class S, class Lane>
S from_lanes(const Lane& number) {
  if constexpr (kLanes<S> == 1) {
    return number(0);
  } else if constexpr (kLanes<S> == 2) {
    return two_lanes<S>(number(0), number(1));
  } else {
    S value;
    for (std::size_t l = 0; l < kLanes<S>; ++l) set_lane(value, l, number(l));
    return value;
  }
}

/// Entry `index` of a state of H: one number per spacecraft.
template <class H>
H entry(const Number<H>* state, int index) {
  if constexpr (kLanes<H> == 1) {
    return state[index];
  } else {
    return H::load_unaligned(state + static_cast<std::ptrdiff_t>(kLanes<H>) * index);
  }
}
template <class H>
void put_entry(Number<H>* state, int index, const H& value) {
  if constexpr (kLanes<H> == 1) {
    state[index] = value;
  } else {
    value.store_unaligned(state + static_cast<std::ptrdiff_t>(kLanes<H>) * index);
  }
}

/// Of the hub and of its limbs: those of like limbs lie side by side, each with the hub's lanes.
template <class H, class S>
concept KernelScalars = KernelScalar<H> && KernelScalar<S> && std::same_as<Number<H>, Number<S>> &&
    (std::same_as<H, S> || (kLanes<H> == 1 && kLanes<S> == 2 && std::constructible_from<S, H>));

/// How many limbs of a spacecraft share one S: its lanes, or one when they are taken by spacecraft.
template <class H, class S>
inline constexpr std::size_t kLimbs = kLanes<S> / kLanes<H>;

/// Where the same quantity of like limbs is in the state.
template <class H, class S>
using Places = std::array<int, kLimbs<H, S>>;

template <class H, class S>
S gather(const Number<H>* state, const Places<H, S>& places) {
  if constexpr (kLimbs<H, S> == 1) {
    return entry<H>(state, places[0]);
  } else {
    return two_lanes<S>(state[places[0]], state[places[1]]);
  }
}

template <class H, class S>
void scatter(const S& value, Number<H>* state, const Places<H, S>& places) {
  if constexpr (kLimbs<H, S> == 1) {
    put_entry<H>(state, places[0], value);
  } else {  // the second place is the first one's again where there is no second limb
    put_two_lanes(value, state, places);
  }
}

/// The sum over limbs, of which there is one alone unless `is_full`.
template <class H, class S>
H gathered(const S& value, bool is_full) {
  if constexpr (kLimbs<H, S> == 1) {
    return value;
  } else {
    return sum_of_lanes(value, is_full);
  }
}

/// Add two such sums to to[0] and to[1].
template <bool kIsFull, class H, class S>
void add_two_gathered(H* to, const S& first, const S& second) {
  if constexpr (kLimbs<H, S> == 1) {
    to[0] += first;
    to[1] += second;
  } else {
    add_two_sums_of_lanes<kIsFull>(to, first, second);
  }
}

}  // namespace twincraft::TWINCRAFT_KERNEL
