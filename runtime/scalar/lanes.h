// The scalars the kernel is written in: a double, or one double per SIMD lane (xsimd), so that the
// same text steps one spacecraft, two like limbs of it at once, or many spacecraft side by side.
//
// The kernel is compiled once per instruction set, each time in a namespace of its own, and so is
// xsimd: an inline function that leaked from one into another would run instructions the processor
// may not have.
// Tested by tests/runtime/kernel_test.cpp.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#ifndef TWINCRAFT_KERNEL
#define TWINCRAFT_KERNEL portable
#define TWINCRAFT_LANES xsimd_portable
#endif
#define xsimd TWINCRAFT_LANES
#pragma GCC diagnostic push
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // in the compiler's own header
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
#include <xsimd/xsimd.hpp>
#pragma GCC diagnostic pop
#undef xsimd

namespace twincraft::TWINCRAFT_KERNEL {

namespace simd = ::TWINCRAFT_LANES;
#if defined(__AVX512F__)
using BatchArch = simd::avx512f;
#elif defined(__AVX2__)
using BatchArch = simd::avx2;
#else
using BatchArch = simd::sse2;
#endif

/// Two lanes, which every x86-64 has: like limbs of one spacecraft.
using Pair = simd::batch<double, simd::sse2>;
/// As many spacecraft as the instruction set has lanes for.
using Batch = simd::batch<double, BatchArch>;

template <class S>
inline constexpr std::size_t kLanes = S::size;
template <>
inline constexpr std::size_t kLanes<double> = 1;

template <class S>
struct SineCosine {
  S sine, cosine;
};

inline SineCosine<double> sine_cosine(double angle) { return {std::sin(angle), std::cos(angle)}; }

template <class A>
SineCosine<simd::batch<double, A>> sine_cosine(const simd::batch<double, A>& angle) {
  const auto [sine, cosine] = simd::sincos(angle);
  return {sine, cosine};
}

inline double root(double x) { return std::sqrt(x); }
template <class A>
simd::batch<double, A> root(const simd::batch<double, A>& x) {
  return simd::sqrt(x);
}

inline double chosen(bool first, double a, double b) { return first ? a : b; }
template <class A>
simd::batch<double, A> chosen(const simd::batch_bool<double, A>& first,
                              const simd::batch<double, A>& a, const simd::batch<double, A>& b) {
  return simd::select(first, a, b);
}

/// Lane by lane, for building; not for inside a step.
inline double lane(double value, std::size_t) { return value; }
template <class A>
double lane(const simd::batch<double, A>& value, std::size_t index) {
  double result;
  std::memcpy(&result, reinterpret_cast<const char*>(&value) + sizeof(double) * index,
              sizeof result);
  return result;
}
inline void set_lane(double& value, std::size_t, double to) { value = to; }
template <class A>
void set_lane(simd::batch<double, A>& value, std::size_t index, double to) {
  std::memcpy(reinterpret_cast<char*>(&value) + sizeof(double) * index, &to, sizeof to);
}

/// An S whose lane l is number(l). Two numbers become one register at once: a register read back
/// right after its lanes were stored one by one has to wait for them.
template <class S, class Number>
S from_lanes(const Number& number) {
  if constexpr (kLanes<S> == 1) {
    return number(0);
  } else if constexpr (kLanes<S> == 2) {
    return S(_mm_set_pd(number(1), number(0)));
  } else {
    S value;
    for (std::size_t l = 0; l < kLanes<S>; ++l) set_lane(value, l, number(l));
    return value;
  }
}

/// Entry `index` of a state of H: one number per spacecraft.
template <class H>
H entry(const double* state, int index) {
  if constexpr (kLanes<H> == 1) {
    return state[index];
  } else {
    return H::load_unaligned(state + static_cast<std::ptrdiff_t>(kLanes<H>) * index);
  }
}
template <class H>
void put_entry(double* state, int index, const H& value) {
  if constexpr (kLanes<H> == 1) {
    state[index] = value;
  } else {
    value.store_unaligned(state + static_cast<std::ptrdiff_t>(kLanes<H>) * index);
  }
}

/// How many limbs of a spacecraft share one S: its lanes, or one when they are taken by spacecraft.
template <class H, class S>
inline constexpr std::size_t kLimbs = kLanes<S> / kLanes<H>;

/// Where the same quantity of like limbs is in the state.
template <class H, class S>
using Places = std::array<int, kLimbs<H, S>>;

template <class H, class S>
S gather(const double* state, const Places<H, S>& places) {
  if constexpr (kLimbs<H, S> == 1) {
    return entry<H>(state, places[0]);
  } else {
    return S(_mm_set_pd(state[places[1]], state[places[0]]));
  }
}

template <class H, class S>
void scatter(const S& value, double* state, const Places<H, S>& places) {
  if constexpr (kLimbs<H, S> == 1) {
    put_entry<H>(state, places[0], value);
  } else {  // the second place is the first one's again where there is no second limb
    _mm_storeh_pd(state + places[1], value);
    _mm_storel_pd(state + places[0], value);
  }
}

/// The sum over limbs, of which there is one alone unless `is_full`.
template <class H, class S>
H gathered(const S& value, bool is_full) {
  if constexpr (kLimbs<H, S> == 1) {
    return value;
  } else {
    const __m128d lanes = value;
    const double first = _mm_cvtsd_f64(lanes);
    return is_full ? first + _mm_cvtsd_f64(_mm_unpackhi_pd(lanes, lanes)) : first;
  }
}

}  // namespace twincraft::TWINCRAFT_KERNEL
