// A double per SIMD lane (xsimd), so that the text of the kernel steps two like limbs of a
// spacecraft at once, or many spacecraft side by side: all that is written for an instruction set,
// and what scalar.h asks of it.
//
// The kernel is compiled once per instruction set, each time in a namespace of its own, and so is
// xsimd: an inline function that leaked from one into another would run instructions the processor
// may not have.
// Tested by tests/runtime/kernel_test.cpp.
#pragma once

#include <array>
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
/// As many things of one kind as books and observations look at together, whose numbers do not lie
/// side by side: instants of one spacecraft, point masses on it.
#if defined(__AVX2__)
using Abreast = simd::batch<double, simd::avx2>;
#else
using Abreast = Pair;
#endif

template <class S>
struct SineCosine {
  S sine, cosine;
};

template <class A>
SineCosine<simd::batch<double, A>> sine_cosine(const simd::batch<double, A>& angle) {
  using Lanes = simd::batch<double, A>;
  // What sincos() makes of small angles, to the last bit, without its choice of a quadrant.
  if (simd::all(simd::abs(angle) <= simd::constants::pio4<Lanes>())) {
    const Lanes square = angle * angle;
    return {simd::kernel::detail::sin_eval(square, angle), simd::kernel::detail::cos_eval(square)};
  }
  const auto [sine, cosine] = simd::sincos(angle);
  return {sine, cosine};
}

/// Whether two S fit side by side where one leaves lanes idle.
template <class S>
inline constexpr bool kTakesTwoAngles = false;
#if defined(__AVX2__)
template <>
inline constexpr bool kTakesTwoAngles<Pair> = true;
/// Two angles in one call, no wider: not on every processor are the widest registers the fastest.
inline void put_sines_cosines(const Pair& first, const Pair& second, SineCosine<Pair>& of_first,
                              SineCosine<Pair>& of_second) {
  using Both = simd::batch<double, simd::avx2>;
  const auto [sine, cosine] = sine_cosine(Both(_mm256_set_m128d(second, first)));
  of_first.sine = _mm256_castpd256_pd128(sine);
  of_first.cosine = _mm256_castpd256_pd128(cosine);
  of_second.sine = _mm256_extractf128_pd(sine, 1);
  of_second.cosine = _mm256_extractf128_pd(cosine, 1);
}
#endif

template <class A>
simd::batch<double, A> root(const simd::batch<double, A>& x) {
  return simd::sqrt(x);
}

template <class A>
simd::batch<double, A> chosen(const simd::batch_bool<double, A>& first,
                              const simd::batch<double, A>& a, const simd::batch<double, A>& b) {
  return simd::select(first, a, b);
}

template <class A>
double lane(const simd::batch<double, A>& value, std::size_t index) {
  double result;
  std::memcpy(&result, reinterpret_cast<const char*>(&value) + sizeof(double) * index,
              sizeof result);
  return result;
}
template <class A>
void set_lane(simd::batch<double, A>& value, std::size_t index, double to) {
  std::memcpy(reinterpret_cast<char*>(&value) + sizeof(double) * index, &to, sizeof to);
}

template <class S>
S two_lanes(double first, double second) {
  return S(_mm_set_pd(second, first));
}
/// Entry `at` of each vector.
inline Pair entry_of_each(const std::array<const double*, 2>& vectors, std::size_t at) {
  return _mm_setr_pd(vectors[0][at], vectors[1][at]);
}
#if defined(__AVX2__)
inline simd::batch<double, simd::avx2> entry_of_each(const std::array<const double*, 4>& vectors,
                                                     std::size_t at) {
  return _mm256_setr_pd(vectors[0][at], vectors[1][at], vectors[2][at], vectors[3][at]);
}
#endif
/// Four numbers.
using FourSums = std::array<Abreast, 4 / Abreast::size>;
/// Add the sums over the lanes of each.
inline void add_sums_of_lanes(FourSums& to, const std::array<Abreast, 4>& of) {
#if defined(__AVX2__)
  to[0] += simd::haddp(of.data());
#else
  for (std::size_t i = 0; i < 2; ++i) {
    const Pair first = of[2 * i], second = of[2 * i + 1];
    to[i] += Pair(_mm_unpacklo_pd(first, second)) + Pair(_mm_unpackhi_pd(first, second));
  }
#endif
}
inline void put(const FourSums& sums, double* to) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i].store_unaligned(to + Abreast::size * i);
}
/// Lane l of each, side by side, at to[l].
inline void put_lanes(const std::array<Abreast, 4>& of,
                      const std::array<double*, Abreast::size>& to) {
#if defined(__AVX2__)
  const __m256d low = _mm256_unpacklo_pd(of[0], of[1]), high = _mm256_unpackhi_pd(of[0], of[1]);
  const __m256d next_low = _mm256_unpacklo_pd(of[2], of[3]);
  const __m256d next_high = _mm256_unpackhi_pd(of[2], of[3]);
  _mm256_storeu_pd(to[0], _mm256_permute2f128_pd(low, next_low, 0x20));
  _mm256_storeu_pd(to[1], _mm256_permute2f128_pd(high, next_high, 0x20));
  _mm256_storeu_pd(to[2], _mm256_permute2f128_pd(low, next_low, 0x31));
  _mm256_storeu_pd(to[3], _mm256_permute2f128_pd(high, next_high, 0x31));
#else
  for (std::size_t i = 0; i < 4; i += 2) {
    _mm_storeu_pd(to[0] + i, _mm_unpacklo_pd(of[i], of[i + 1]));
    _mm_storeu_pd(to[1] + i, _mm_unpackhi_pd(of[i], of[i + 1]));
  }
#endif
}
/// The first lane's place is written last.
inline void put_two_lanes(const Pair& value, double* state, const std::array<int, 2>& places) {
  _mm_storeh_pd(state + places[1], value);
  _mm_storel_pd(state + places[0], value);
}
/// The sum of both lanes, or the first alone.
inline double sum_of_lanes(const Pair& value, bool of_both) {
  const __m128d lanes = value;
  const double first = _mm_cvtsd_f64(lanes);
  return of_both ? first + _mm_cvtsd_f64(_mm_unpackhi_pd(lanes, lanes)) : first;
}
/// Add the sums of two to to[0] and to[1].
template <bool kOfBoth>
void add_two_sums_of_lanes(double* to, const Pair& first, const Pair& second) {
  Pair sum = _mm_unpacklo_pd(first, second);
  if constexpr (kOfBoth) sum += Pair(_mm_unpackhi_pd(first, second));
  (Pair::load_unaligned(to) + sum).store_unaligned(to);
}

}  // namespace twincraft::TWINCRAFT_KERNEL
