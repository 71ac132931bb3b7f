// What the particles of a vehicle say to its books, all alike however they are joined to the hub:
// by as many at once as there are lanes, from what an evaluation left in memory.
// Tested by tests/runtime/books_test.cpp.
#pragma once

#include "runtime/bsm/book_page.h"
#include "runtime/bsm/limbs.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
class ParticleBooks {
 public:
  /// Where limbs share the lanes of S, those of W are shared by more of them.
  using W = std::conditional_t<kLimbs<H, S> == 1, S, Abreast>;

  explicit ParticleBooks(const Limbs<H, S>& limbs) : all_(limbs.particles()) {}

  void put_motion(BookPage<H>& page) const {
    Sums mass{}, motion{};
    for (const Particles& some : all_)
      add_motion(some, rows(some, Of::kPlace), rows(some, Of::kVelocity), mass, motion);
    put(mass, page.mass);
    put(motion, page.motion);
  }
  /// And what leaves.
  void put_motion_and_leaving(BookPage<H>& page) const {
    const Vec<W> omega = spread<W>(page.omega);
    Sums mass{}, motion{}, leaving{}, driving{}, turning{};
    for (const Particles& some : all_) {
      const Vec<W> r = rows(some, Of::kPlace), w = rows(some, Of::kVelocity);
      add_motion(some, r, w, mass, motion);
      const W rate = row(some, Of::kMassRate);
      const Vec<W> v = plus_cross(w, omega, r), mv = rate * v, H_B = cross(r, mv);
      add(rate, rate * r, leaving);
      add(W(0.5) * dot(mv, v), mv, driving);
      add(W(0.0), H_B, turning);
    }
    put(mass, page.mass);
    put(motion, page.motion);
    put(leaving, page.leaving);
    put(driving, page.driving);
    put(turning, page.turning);
  }
  void put_pulls(const Field<H>& of_hub, BookPage<H>& page) const {
    const Field<W> field = spread<W>(of_hub);
    Sums pulls{}, twists{};
    for (const Particles& some : all_) {
      const Vec<W> r = rows(some, Of::kPlace);
      const Vec<W> force = row(some, Of::kMass) * field.difference(r);
      add(dot(force, rows(some, Of::kVelocity)), force, pulls);
      add(W(0.0), cross(r, force), twists);
    }
    put(pulls, page.pulls);
    put(twists, page.twists);
  }
  /// See lifted().
  H lift(const Field<H>& of_hub) const {
    const Field<W> field = spread<W>(of_hub);
    Sums sums{};
    for (const Particles& some : all_)
      add(lifted(row(some, Of::kMassRate), rows(some, Of::kPlace), field), {}, sums);
    Four<H> four;
    put(sums, four);
    return four.value;
  }

 private:
  using Of = Particle<H, S>;
  using Particles = typename Limbs<H, S>::Particles;

  static W row(const Particles& some, std::size_t i) {
    if constexpr (kLimbs<H, S> == 1) {
      return entry<W>(some[0], static_cast<int>(i));
    } else {
      return entry_of_each(some, kLanes<S> * i);
    }
  }
  static Vec<W> rows(const Particles& some, std::size_t i) {
    return {row(some, i), row(some, i + 1), row(some, i + 2)};
  }

  /// Of as many particles as there are lanes each: sums lane by lane, over all, would be too many
  /// for the registers.
  using Sums = std::conditional_t<kLimbs<H, S> == 1, Four<H>, FourSums>;
  static void add(const W& value, const Vec<W>& v, Sums& to) {
    if constexpr (kLimbs<H, S> == 1) {
      to.value += value;
      to.vector += v;
    } else {
      add_sums_of_lanes(to, {value, v.x, v.y, v.z});
    }
  }
  static void put(const Sums& sums, Four<H>& to) {
    if constexpr (kLimbs<H, S> == 1) {
      to = sums;
    } else {
      static_assert(sizeof(to) == sizeof(sums));
      TWINCRAFT_KERNEL::put(sums, &to.value);
    }
  }
  static void add_motion(const Particles& some, const Vec<W>& r, const Vec<W>& w, Sums& mass,
                         Sums& motion) {
    const W m = row(some, Of::kMass);
    add(m, m * r, mass);
    add(W(0.0), m * w, motion);
  }

  std::span<const Particles> all_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
