// Chains whose hinges are all parallel, such as every solar array: the recursion in the plane.
//
// In chain axes C = (x, s, z), fixed in the mount with s along the hinges, a link that is balanced
// about the plane (centre of mass in it, s a principal axis) moves as follows. Its in-plane
// acceleration and its spin about s know nothing of the rest, and eliminating the joint leaves a
// 2x2 mass instead of a 6x6 one:
//     tau = J alpha + h.a + tau0,  f = h alpha + M a + f0       about the link's own hinge
//     tau = u  gives  alpha = (u - tau0 - h.a) / J              (total spin: no parent in it)
// so the parent feels the torque u and the force (M - h h^T / J) a + f0 + h (u - tau0) / J. What is
// left, the force along s and the torques in the plane, is that of the locked chain and is summed,
// not eliminated. One chain is an effector of its mount with a law as in law.h.
//
// Both go from leaf to root and carry what the links so far ask for from hinge to hinge, so no link
// needs to know where it is: fewer products than about the root, and fewer numbers to keep. An
// in-plane inertia is its mean, which no turning changes, and a rest that turns by twice the angle.
// In the gyroscopic torque of a link, ThetaDot G w + J nu w + nu perp(G omega) with w = omega x s
// = -perp(omega), the means of G leave -omega_s mean w, and the rests, for which G w = perp(G
// omega), (nu + ThetaDot) perp(rest omega).
//
// In-plane vectors are (x, z). Theta about s turns them by phi = -Theta from x to z; s cross v is
// perp(v) = (v_z, -v_x). Where hinges and centres of mass lie on one line, the x axes of the links,
// first moments have become particles at hinges, see plan.cpp: only the last link has one. Angles
// and rates of links are absolute in the mount: Theta, ThetaDot; nu = omega_s + ThetaDot. Tested by
// tests/runtime/bsm_test.cpp (against the general recursion and the dense oracle).
#pragma once

#include <span>
#include <vector>

#include "runtime/bsm/chain_law.h"
#include "runtime/bsm/law.h"
#include "runtime/bsm/outside.h"
#include "runtime/bsm/parts.h"
#include "runtime/bsm/plan.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

/// @tparam H  scalar of the hub and of the state  @tparam S  that of the limb, see lanes.h
template <class H, class S>
requires KernelScalars<H, S>
class Chain {
 public:
  /// @param lanes  the same chain of like limbs, one per lane of S
  explicit Chain(std::span<const ChainPlan* const> lanes, const Layout& layout) {
    const ChainPlan& first = *lanes.front();
    mount_ = first.mount;
    is_straight_ = first.is_straight;
    joints_.resize(first.links.size());
    bodies_.resize(first.links.size());
    motions_.resize(first.links.size());
    recoveries_.resize(first.links.size());
    efforts_.resize(first.links.size());
    elements_.resize(first.links.size());
    pulls_.resize(first.links.size());
    for (std::size_t l = 0; l < lanes.size(); ++l) set(l, *lanes[l], layout);
    dcm_WC_ = dcm_PC_;  // for good where the mount is the hub, whose axes are the working axes
    r_HP_ = r_HP_P_;
  }

  int mount() const { return mount_; }  // in the limb; -1: the hub
  /// Let the mount's axes be others.
  void turn_mount(const Mat<S>& dcm) {
    r_HP_P_ = dcm * r_HP_P_;
    dcm_PC_ = dcm * dcm_PC_;
  }

  void hold(std::size_t lane_index, const ChainPlan& plan, const HeldInputsIn<Number<H>>& held) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const PlanarLinkPlan& link = plan.links[i];
      const auto joint = static_cast<std::size_t>(link.link - 1);
      const Number<H> effort = held.effort.data()[joint];
      set_lane(efforts_[i], lane_index, effort);
      set_lane(joints_[i].held, lane_index, effort + Number<H>(link.stiffness * link.rest));
    }
  }

  /// @param mount  how the mount moves: where it is matters for gravity and the centre of mass
  // Flattened, or the portable set calls the sines, with their constants, once a link.
  [[gnu::flatten]] void move(const Number<H>* state, const MountMotion<S>& mount) {
    if (mount_ >= 0) {
      dcm_WC_ = mount.dcm_WL * dcm_PC_;
      r_HP_ = mount.dcm_WL * r_HP_P_;
    }
    r_HB_ = mount.r_LB + r_HP_;
    a_bias_ = cross(mount.omega, cross(mount.omega, r_HP_));
    const Vec<S> omega_C = transposed(dcm_WC_, mount.omega);
    omega_ = in_plane(omega_C);
    omega_s_ = omega_C.y;
    // Local, or the compiler asks for them again after every store of a register.
    const std::span<const Joint> joints = joints_;
    const std::span<Motion> motions = motions_;
    S phi(0.0), theta_dot(0.0), spin(0.0);
    const auto angle = [&](std::size_t i) __attribute__((always_inline)) {
      const Joint& joint = joints.data()[i];
      Motion& m = motions.data()[i];
      const S q = gather<H, S>(state, joint.position);
      const S q_dot = gather<H, S>(state, joint.rate);
      m.drive = joint.held - joint.stiffness * q - joint.damping * q_dot;
      phi -= q;
      theta_dot += q_dot;
      spin += theta_dot * joint.J_with_beyond;
      m.theta_dot = theta_dot;
      return phi;
    };
    std::size_t i = 0;
    if constexpr (kTakesTwoAngles<S>) {
      for (; i + 1 < motions.size(); i += 2) {
        const S first = angle(i), second = angle(i + 1);
        put_sines_cosines(first, second, motions.data()[i].turn, motions.data()[i + 1].turn);
      }
    }
    for (; i < motions.size(); ++i) motions.data()[i].turn = sine_cosine(angle(i));
    spin_ = spin;
  }

  Moment<S> moment() const {
    Vec2<S> sum;  // about the hinge of the link at hand
    for (std::size_t i = bodies_.size(); i-- > 0;) {
      const Body& body = bodies_[i];
      sum += turned(body.first_moment + body.mass_beyond * body.next, motions_[i].turn);
    }
    return {mass_, mass_ * r_HB_ + in_axes(sum)};
  }

  /// Tell the mount the chain's law: see Law::take().
  template <bool kIsFirst>
  void tell(const Field<S>* field, Law<S>& mount) {
    Law<S> law = law_about_root(field);
    law.n0 = plus_product(law.n0, law.H, a_bias_);
    law.f0 = plus_product(law.f0, law.M, a_bias_);
    mount.template take<kIsFirst>(law, r_HP_);
  }

  /// Joint accelerations from the mount's.
  void recover(const Vec<S>& omega_dot, const Vec<S>& a, Number<H>* rate) const {
    const Vec<S> a_H = a + cross(omega_dot, r_HP_) + a_bias_;
    Vec2<S> at{dot(dcm_WC_.x, a_H), dot(dcm_WC_.z, a_H)};
    S before = dot(dcm_WC_.y, omega_dot);
    const std::span<const Joint> joints = joints_;
    const std::span<const Motion> motions = motions_;
    const std::span<const Recovery<S>> recoveries = recoveries_;
    // What alpha of a link makes of the next hinge is added a link later, so that the next alpha
    // waits for it in one product, not in three.
    S alpha(0.0);
    Vec2<S> lever;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const Recovery<S>& r = recoveries.data()[i];
      const S known = motions.data()[i].drive - r.gain_f.x * at.x - r.gain_f.z * at.z;
      at = at + r.bias;
      at = {at.x + alpha * lever.x, at.z + alpha * lever.z};
      alpha = known - alpha * (r.gain_f.x * lever.x + r.gain_f.z * lever.z);
      lever = perp(r.next);
      scatter<H, S>(alpha - before, rate, joints.data()[i].rate);
      before = alpha;
    }
  }

  // For the books, as of Limb: from what the last evaluation left.
  S inner_power(const Number<H>* state) const {
    S power(0.0);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const Joint& joint = joints_[i];
      const S q_dot = gather<H, S>(state, joint.rate);
      power += (efforts_[i] - joint.damping * q_dot) * q_dot;
    }
    return power;
  }
  // Seen from the mount's axes.
  MassMotion<S> motion() const {
    Vec2<S> moment, momentum;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Body& body = bodies_[i];
      const Vec2<S> part =
          turned(body.first_moment + body.mass_beyond * body.next, motions_[i].turn);
      moment += part;
      momentum += motions_[i].theta_dot * perp(part);
    }
    return {{mass_, mass_ * r_HB_ + in_axes(moment)}, in_axes(momentum)};
  }
  Outside<S> gravity() const {
    Pull<S> sum;  // chain axes, about the root hinge
    S power(0.0);
    Vec2<S> r, w;  // of a hinge from the root hinge
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Pull<S>& pull = pulls_[i];
      const S& theta_dot = motions_[i].theta_dot;
      sum.torque += pull.torque;
      sum.add(pull.force, {r.x, S(0.0), r.z});
      power += dot(w, in_plane(pull.force)) + theta_dot * pull.torque.y;
      const Vec2<S> next = turned(bodies_[i].next, motions_[i].turn);
      r += next;
      w += theta_dot * perp(next);
    }
    const Vec<S> force = dcm_WC_ * sum.force;
    return {{force, plus_cross(dcm_WC_ * sum.torque, r_HB_, force)}, power, S(0.0)};
  }

 private:
  // A pass touches only what it reads: the lanes of a long chain fill the nearest cache.
  /// What move() reads.
  struct Joint {
    S stiffness{}, damping{};
    S held{};           // [N m] at angle and rate zero, by the motor and by the spring
    S J_with_beyond{};  // [kg m^2] of the link with all the mass beyond it at the next hinge
    Places<H, S> position{}, rate{};
  };
  /// What the law reads, vectors at angle zero.
  struct Body {
    S mass{}, mass_beyond{};  // of the link, of those after it
    S J{};
    Vec2<S> next;
    Deviator<S> G, G_with_beyond;  // with: as J_with_beyond
    Vec2<S> first_moment;
  };
  struct Motion {
    SineCosine<S> turn;  // of phi = -Theta
    S theta_dot;
    S drive;  // [N m] torque on the joint; once that is eliminated, alpha = drive - gain_f . a
  };
  void set(std::size_t l, const ChainPlan& plan, const Layout& layout) {
    set_lane(dcm_PC_, l, plan.dcm_PC);
    set_lane(r_HP_P_, l, plan.r_HP_P);
    double beyond = 0.0, J = 0.0, mean = 0.0;
    for (std::size_t i = bodies_.size(); i-- > 0;) {
      const PlanarLinkPlan& from = plan.links[i];
      Joint& joint = joints_[i];
      Body& body = bodies_[i];
      const auto [x, z] = from.next;
      const double half = 0.5 * (from.G[0] - from.G[1]);
      set_lane(body.mass, l, from.mass);
      set_lane(body.mass_beyond, l, beyond);
      set_lane(body.first_moment.x, l, from.first_moment[0]);
      set_lane(body.first_moment.z, l, from.first_moment[1]);
      set_lane(body.next.x, l, x);
      set_lane(body.next.z, l, z);
      set_lane(body.G.half, l, half);
      set_lane(body.G.xz, l, from.G[2]);
      set_lane(body.G_with_beyond.half, l, half + 0.5 * beyond * (z * z - x * x));
      set_lane(body.G_with_beyond.xz, l, from.G[2] - beyond * x * z);
      set_lane(body.J, l, from.J);
      const double J_with_beyond = from.J + beyond * (x * x + z * z);
      set_lane(joint.J_with_beyond, l, J_with_beyond);
      mean += 0.5 * (from.G[0] + from.G[1] + beyond * (x * x + z * z));
      J += J_with_beyond;
      beyond += from.mass;
      set_lane(joint.stiffness, l, from.stiffness);
      set_lane(joint.damping, l, from.damping);
      joint.position[l % kLimbs<H, S>] = layout.position(from.link);
      joint.rate[l % kLimbs<H, S>] = layout.rate(from.link);
      if (l == 0) elements_[i].resize(from.elements.size());
      for (std::size_t e = 0; e < from.elements.size(); ++e)
        elements_[i][e].set(l, from.elements[e]);
    }
    set_lane(mass_, l, beyond);
    set_lane(mean_, l, mean);
    set_lane(J_, l, J);
  }

  Vec<S> in_axes(const Vec2<S>& v) const { return v.x * dcm_WC_.x + v.z * dcm_WC_.z; }

  /// The force and torque on each link about its own hinge, in chain axes.
  void pull(const Field<S>& field) {
    const Field<S> field_C = field.in_axes(dcm_WC_);
    const Vec<S> r_HB_C = transposed(dcm_WC_, r_HB_);
    Vec2<S> r;  // [m] hinge from the root hinge
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      Pull<S> sum;
      for (const ElementNow<S>& element : elements_[i]) {
        const Vec2<S> at = turned(in_plane(element.r_EL), motions_[i].turn);
        const Vec<S> r_EH{at.x, element.r_EL.y, at.z};
        const Vec<S> place = r_HB_C + Vec<S>{r.x, S(0.0), r.z} + r_EH;
        sum.add(element.mass * field_C.difference(place), r_EH);
      }
      pulls_[i] = sum;
      r += turned(bodies_[i].next, motions_[i].turn);
    }
  }

  Law<S> law_about_root(const Field<S>* field) {
    return is_straight_ ? law_about_root<true>(field) : law_about_root<false>(field);
  }
  template <bool kIsStraight>
  Law<S> law_about_root(const Field<S>* field) {
    if (field != nullptr) pull(*field);
    const std::span<const Body> bodies = bodies_;
    const std::span<Motion> motions = motions_;
    const std::span<Recovery<S>> recoveries = recoveries_;
    const Turning<S> turning(omega_);
    LockedChain<S> locked;
    FreeChain<S> free;
    const auto take = [&](std::size_t i, auto is_last) __attribute__((always_inline)) {
      const Body& body = bodies.data()[i];
      Motion& m = motions.data()[i];
      Recovery<S>& recovery = recoveries.data()[i];
      const S nu = omega_s_ + m.theta_dot, nu2 = nu * nu;
      const S rate = nu + m.theta_dot;
      const auto carried = [&](const Vec2<S>& v) {
        if constexpr (kIsStraight)
          return turning.carry({v.x * m.turn.cosine, v.x * m.turn.sine}, nu2);
        return turning.carry(turned(v, m.turn), nu2);
      };
      if constexpr (!is_last) {
        const Carried<S> next = carried(body.next);
        recovery.next = next.v;
        recovery.bias = next.bias;
        locked.reach(body.mass_beyond, next.v, rate * next.leaves);
        free.reach(next.v, next.bias, body.J);
      } else {
        free.J = body.J;
      }
      if constexpr (is_last || !kIsStraight) {
        const Carried<S> b = carried(body.first_moment);
        locked.moment += b.v;
        locked.f_s += rate * b.leaves;
        free.f += b.bias;
        free.h += perp(b.v);
      }
      free.tau += turning.torque(turned<!kIsStraight>(body.G, m.turn));
      if (field != nullptr) {
        locked.feel(pulls_[i]);
        free.feel(pulls_[i]);
      }
      m.drive = free.eliminate(body.mass, m.drive, recovery);
      // Last, or what the link before waits for would be kept in memory meanwhile.
      locked.add(turned<!kIsStraight>(body.G_with_beyond, m.turn), rate);
    };
    std::size_t i = bodies.size() - 1;
    take(i, std::true_type());
    while (i-- > 0) take(i, std::false_type());
    return law_of(locked, free);
  }

  /// Both together, in working axes.
  [[gnu::always_inline]] Law<S> law_of(const LockedChain<S>& locked,
                                       const FreeChain<S>& free) const {
    const Vec2<S> w = Vec2<S>{} - perp(omega_);  // omega x s
    const Vec2<S> n0 = perp(locked.rates * omega_ - locked.lever) +
                       (omega_s_ * (J_ - mean_) + spin_) * w - locked.pulled;
    const Plane<S>& products = locked.products;
    const Plane<S> G{mean_ + locked.G.half + (products.xx + products.xx),
                     mean_ - locked.G.half + (products.zz + products.zz),
                     locked.G.xz + products.xz};
    const Vec<S>&x = dcm_WC_.x, &along = dcm_WC_.y, &z = dcm_WC_.z;
    const Vec<S> lever = locked.moment.x * z - locked.moment.z * x;  // S cross s
    return {G.in_axes(x, z),
            free.M.in_axes(x, z) + Sym<S>::parallel(mass_ * along, along),
            {along.x * lever, along.y * lever, along.z * lever},
            n0.x * x + free.tau * along + n0.z * z,
            free.f.x * x + locked.f_s * along + free.f.z * z};
  }

  int mount_ = -1;
  bool is_straight_ = false;
  Vec<S> r_HP_P_, r_HP_, r_HB_, a_bias_;
  Mat<S> dcm_PC_, dcm_WC_;
  std::vector<Joint> joints_;
  std::vector<Body> bodies_;
  std::vector<Motion> motions_;
  std::vector<Recovery<S>> recoveries_;
  std::vector<S> efforts_;  // [N m] of the motors
  std::vector<std::vector<ElementNow<S>>> elements_;
  std::vector<Pull<S>> pulls_;
  // Sums over all links, each with the mass beyond it; mean_: of (G.xx + G.zz) / 2.
  S mass_{}, mean_{}, J_{};
  S omega_s_{};    // rate of the mount along s
  Vec2<S> omega_;  // and in the plane
  S spin_{};       // [kg m^2/s] sum of ThetaDot J, with the mass beyond
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
