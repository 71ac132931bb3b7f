// What the particles of a vehicle say to its books, all alike however they are joined to the hub:
// by as many at once as there are lanes, from what an evaluation left in memory.
// Tested by tests/runtime/books_test.cpp.
#pragma once

#include "runtime/bsm/limbs.h"
#include "runtime/bsm/outside.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
class ParticleBooks {
 public:
  /// Where limbs share the lanes of S, those of W are shared by more of them.
  using W = std::conditional_t<kLimbs<H, S> == 1, S, Abreast>;

  explicit ParticleBooks(const Limbs<H, S>& limbs) : all_(limbs.particles()) {}

  MassMotion<H> motion() const {
    Sums<8> sums{};
    for (const Particles& some : all_)
      add_motion(some, rows(some, Of::kPlace), rows(some, Of::kVelocity), sums);
    return motion_of(sums);
  }
  /// The same, and what leaves.
  MassMotion<H> motion(const Vec<H>& omega, Change<H>& leaving) const {
    const Vec<W> omega_W = spread(omega);
    Sums<8> sums{};
    Sums<12> lost{};
    for (const Particles& some : all_) {
      const Vec<W> r = rows(some, Of::kPlace), w = rows(some, Of::kVelocity);
      add_motion(some, r, w, sums);
      const W rate = row(some, Of::kMassRate);
      const Vec<W> v = plus_cross(w, omega_W, r), mv = rate * v, H_B = cross(r, mv);
      add(&lost[0], rate, rate * r);
      add(&lost[4], W(0.5) * dot(mv, v), mv);
      add(&lost[8], W(0.0), H_B);
    }
    leaving = {{lost[0], three(&lost[1])}, {three(&lost[5]), three(&lost[9])}, lost[4]};
    return motion_of(sums);
  }
  Outside<H> gravity(const Field<H>& of_hub) const {
    const Field<W> field = spread(of_hub);
    Sums<8> sums{};
    for (const Particles& some : all_) {
      const Vec<W> r = rows(some, Of::kPlace);
      const Vec<W> force = row(some, Of::kMass) * field.difference(r);
      add(&sums[0], dot(force, rows(some, Of::kVelocity)), force);
      add(&sums[4], W(0.0), cross(r, force));
    }
    return {{three(&sums[1]), three(&sums[5])}, sums[0], H(0.0)};
  }
  /// See lifted() [W].
  Power<H> lift(const Field<H>& of_hub) const {
    const Field<W> field = spread(of_hub);
    Sums<4> sums{};
    for (const Particles& some : all_)
      add(&sums[0], lifted(row(some, Of::kMassRate), rows(some, Of::kPlace), field), {});
    return {sums[0]};
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
  static Vec<W> spread(const Vec<H>& v) { return {W(v.x), W(v.y), W(v.z)}; }
  static Field<W> spread(const Field<H>& field) {
    return {W(field.mu), spread(field.r), W(field.inverse_r2), W(field.strength),
            field.has_gradient};
  }

  // Every few particles are summed up at once: sums in registers would be too many for them.
  template <std::size_t N>
  using Sums = std::array<H, N>;
  static void add(H* to, const W& value, const Vec<W>& v) {
    if constexpr (kLimbs<H, S> == 1) {
      to[0] += value;
      to[1] += v.x;
      to[2] += v.y;
      to[3] += v.z;
    } else {
      add_sums_of_lanes(to, {value, v.x, v.y, v.z});
    }
  }
  static Vec<H> three(const H* sums) { return {sums[0], sums[1], sums[2]}; }

  static void add_motion(const Particles& some, const Vec<W>& r, const Vec<W>& w, Sums<8>& sums) {
    const W mass = row(some, Of::kMass);
    add(&sums[0], mass, mass * r);
    add(&sums[4], W(0.0), mass * w);
  }
  static MassMotion<H> motion_of(const Sums<8>& sums) {
    return {{sums[0], three(&sums[1])}, three(&sums[5]), H(0.0)};
  }

  std::span<const Particles> all_;
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
