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
// In-plane vectors are (x, z). Turning by Theta about s: (c x + s z, -s x + c z); s cross v is
// perp(v) = (v_z, -v_x). Angles and rates of links are absolute in the mount: Theta, ThetaDot;
// nu = omega_s + ThetaDot.
// Tested by tests/runtime/bsm_test.cpp (against the general recursion and the dense oracle).
#pragma once

#include <span>
#include <vector>

#include "runtime/bsm/law.h"
#include "runtime/bsm/parts.h"
#include "runtime/bsm/plan.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class S>
struct Vec2 {
  S x{}, z{};

  Vec2& operator+=(const Vec2& o) {
    x += o.x;
    z += o.z;
    return *this;
  }
  Vec2& operator-=(const Vec2& o) {
    x -= o.x;
    z -= o.z;
    return *this;
  }
  friend Vec2 operator+(Vec2 a, const Vec2& b) { return a += b; }
  friend Vec2 operator-(Vec2 a, const Vec2& b) { return a -= b; }
  friend Vec2 operator*(const S& s, const Vec2& a) { return {s * a.x, s * a.z}; }
};

template <class S>
S dot(const Vec2<S>& a, const Vec2<S>& b) {
  return a.x * b.x + a.z * b.z;
}
template <class S>
Vec2<S> perp(const Vec2<S>& v) {
  return {v.z, -v.x};
}
template <class S>
Vec2<S> in_plane(const Vec<S>& v) {
  return {v.x, v.z};
}

/// Symmetric 2x2 in (x, z).
template <class S>
struct Plane {
  S xx{}, zz{}, xz{};

  Vec2<S> operator*(const Vec2<S>& v) const { return {xx * v.x + xz * v.z, xz * v.x + zz * v.z}; }
  Plane turned(const S& c, const S& s) const {
    const S mean = S(0.5) * (xx + zz), half = S(0.5) * (xx - zz);
    const S c2 = c * c - s * s, s2 = (c + c) * s;
    const S turned_half = c2 * half + s2 * xz;
    return {mean + turned_half, mean - turned_half, c2 * xz - s2 * half};
  }
  Sym<S> in_axes(const Vec<S>& x, const Vec<S>& z) const {
    return Sym<S>::parallel(xx * x + xz * z, x) + Sym<S>::parallel(xz * x + zz * z, z);
  }
};

/// @tparam H  scalar of the hub and of the state  @tparam S  that of the limb, see lanes.h
template <class H, class S>
requires KernelScalars<H, S>
class Chain {
 public:
  /// @param lanes  the same chain of like limbs, one per lane of S
  explicit Chain(std::span<const ChainPlan* const> lanes, const Layout& layout) {
    const ChainPlan& first = *lanes.front();
    mount_ = first.mount;
    links_.resize(first.links.size());
    motions_.resize(first.links.size());
    recoveries_.resize(first.links.size());
    for (std::size_t l = 0; l < lanes.size(); ++l) set(l, *lanes[l], layout);
  }

  int mount() const { return mount_; }  // in the limb; -1: the hub

  void hold(std::size_t lane_index, const ChainPlan& plan, const HeldInputsIn<Number<H>>& held) {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const auto joint = static_cast<std::size_t>(plan.links[i].link - 1);
      set_lane(links_[i].effort, lane_index, held.effort.data()[joint]);
    }
  }

  /// @param mount  how the mount moves: where it is matters for gravity and the centre of mass
  void move(const Number<H>* state, const MountMotion<S>& mount) {
    if (mount_ < 0) {  // the hub's axes are the working axes
      dcm_WC_ = dcm_PC_;
      r_HP_ = r_HP_P_;
    } else {
      dcm_WC_ = mount.dcm_WL * dcm_PC_;
      r_HP_ = mount.dcm_WL * r_HP_P_;
    }
    r_HB_ = mount.r_LB + r_HP_;
    a_bias_ = cross(mount.omega, cross(mount.omega, r_HP_));
    const Vec<S> omega_C = transposed(dcm_WC_, mount.omega);
    omega_ = in_plane(omega_C);
    W_ = {-(omega_.z * omega_.z), -(omega_.x * omega_.x), omega_.x * omega_.z};
    S theta(0.0), theta_dot(0.0), a_s(0.0);
    Vec2<S> r;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const Link& link = links_[i];
      Motion& motion = motions_[i];
      const S q = gather<H, S>(state, link.position);
      const S q_dot = gather<H, S>(state, link.rate);
      motion.u = link.effort - link.stiffness * (q - link.rest) - link.damping * q_dot;
      theta += q;
      theta_dot += q_dot;
      const auto [s, c] = sine_cosine(theta);
      motion.cosine = c;
      motion.sine = s;
      motion.theta_dot = theta_dot;
      motion.nu = omega_C.y + theta_dot;
      motion.b = turned(link.first_moment, c, s);
      motion.d = turned(link.next, c, s);
      motion.G = link.G.turned(c, s);
      motion.d_bias = W_ * motion.d - (motion.nu * motion.nu) * motion.d;
      motion.r = r;
      motion.a_s = a_s;
      r += motion.d;
      a_s += (motion.nu + theta_dot) * dot(omega_, motion.d);
    }
  }

  Moment<S> moment() const {
    Vec2<S> sum;
    S mass(0.0);
    for (std::size_t i = 0; i < links_.size(); ++i) {
      sum += motions_[i].b + links_[i].mass * motions_[i].r;
      mass += links_[i].mass;
    }
    return {mass, mass * r_HB_ + (sum.x * dcm_WC_.x + sum.z * dcm_WC_.z)};
  }

  /// Add the chain's law, about the origin of its mount, to the mount's.
  void contribute(const Field<S>* field, Law<S>& mount) {
    Law<S> law =
        field == nullptr ? law_about_root([](std::size_t) { return Pull<S>{}; }) : law_in(*field);
    law.n0 += law.H * a_bias_;
    law.f0 += law.M * a_bias_;
    mount.add_moved(law, r_HP_);
  }

  /// Joint accelerations from the mount's.
  void recover(const Vec<S>& omega_dot, const Vec<S>& a, Number<H>* rate) const {
    const Vec<S> a_H = a + cross(omega_dot, r_HP_) + a_bias_;
    Vec2<S> at{dot(dcm_WC_.x, a_H), dot(dcm_WC_.z, a_H)};
    S before = dot(dcm_WC_.y, omega_dot);
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const S alpha = recoveries_[i].gain - dot(recoveries_[i].gain_f, at);
      scatter<H, S>(alpha - before, rate, links_[i].rate);
      at += alpha * perp(motions_[i].d) + motions_[i].d_bias;
      before = alpha;
    }
  }

 private:
  struct Link {
    S mass{};
    Vec2<S> first_moment, next;
    Plane<S> G;
    S J{};
    S stiffness{}, damping{}, rest{}, effort{};
    Places<H, S> position{}, rate{};
    std::vector<ElementNow<S>> elements;
  };
  struct Motion {
    S cosine, sine;  // of Theta
    S nu, theta_dot;
    S u;             // torque on the joint
    Vec2<S> b, d;    // first moment and next hinge, turned
    Vec2<S> r;       // [m] hinge from the root hinge
    Vec2<S> d_bias;  // in-plane bias acceleration across d
    S a_s;           // bias acceleration of the hinge along s
    Plane<S> G;
  };
  /// alpha = gain - gain_f . a
  struct Recovery {
    S gain;
    Vec2<S> gain_f;
  };

  static Vec2<S> turned(const Vec2<S>& v, const S& c, const S& s) {
    return {c * v.x + s * v.z, c * v.z - s * v.x};
  }

  void set(std::size_t l, const ChainPlan& plan, const Layout& layout) {
    set_lane(dcm_PC_, l, plan.dcm_PC);
    set_lane(r_HP_P_, l, plan.r_HP_P);
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const PlanarLinkPlan& from = plan.links[i];
      Link& link = links_[i];
      set_lane(link.mass, l, from.mass);
      set_lane(link.first_moment.x, l, from.first_moment[0]);
      set_lane(link.first_moment.z, l, from.first_moment[1]);
      set_lane(link.next.x, l, from.next[0]);
      set_lane(link.next.z, l, from.next[1]);
      set_lane(link.G.xx, l, from.G[0]);
      set_lane(link.G.zz, l, from.G[1]);
      set_lane(link.G.xz, l, from.G[2]);
      set_lane(link.J, l, from.J);
      set_lane(link.stiffness, l, from.stiffness);
      set_lane(link.damping, l, from.damping);
      set_lane(link.rest, l, from.rest);
      link.position[l % kLimbs<H, S>] = layout.position(from.link);
      link.rate[l % kLimbs<H, S>] = layout.rate(from.link);
      if (l == 0) link.elements.resize(from.elements.size());
      for (std::size_t e = 0; e < from.elements.size(); ++e)
        link.elements[e].set(l, from.elements[e]);
    }
  }

  Law<S> law_in(const Field<S>& field) {
    const Field<S> field_C = field.in_axes(dcm_WC_);
    const Vec<S> r_HB_C = transposed(dcm_WC_, r_HB_);
    return law_about_root([&](std::size_t i) {
      const Motion& m = motions_[i];
      Pull<S> sum;
      for (const ElementNow<S>& element : links_[i].elements) {
        const Vec2<S> at = turned(in_plane(element.r_EL), m.cosine, m.sine);
        const Vec<S> r_EH{at.x, element.r_EL.y, at.z};
        const Vec<S> place = r_HB_C + Vec<S>{m.r.x, S(0.0), m.r.z} + r_EH;
        sum.add(element.mass * field_C.difference(place), r_EH);
      }
      return sum;
    });
  }

  /// @param pull_on  the force and torque on a link about its own hinge, in chain axes
  template <class PullOn>
  Law<S> law_about_root(const PullOn& pull_on) {
    const Vec2<S> w = Vec2<S>{} - perp(omega_);  // omega x s
    const S ww = omega_.z * omega_.z - omega_.x * omega_.x;
    const S product = omega_.x * omega_.z;
    // Of the locked chain about the root hinge: mass, first moment, in-plane inertia, and biases.
    S mass(0.0), f0_s(0.0);
    Vec2<S> moment, n0;
    Plane<S> G;
    // Of the plane, about the hinge of the link at hand; what the link after it hands over.
    Plane<S> M;
    S J_child(0.0), tau_child(0.0);
    Vec2<S> h_child, f_child;

    for (std::size_t i = links_.size(); i-- > 0;) {
      const Link& link = links_[i];
      const Motion& m = motions_[i];
      const Pull<S> pull = pull_on(i);

      const S f_s = link.mass * m.a_s + (m.nu + m.theta_dot) * dot(omega_, m.b) - pull.force.y;
      const Vec2<S> n = m.theta_dot * (m.G * w) + (link.J * m.nu) * w + m.nu * perp(m.G * omega_) -
                        m.a_s * perp(m.b) - in_plane(pull.torque);
      const Vec2<S> f0 = f_child + W_ * m.b - (m.nu * m.nu) * m.b - in_plane(pull.force);
      const S tau0 = tau_child + m.G.xz * ww + (m.G.xx - m.G.zz) * product - pull.torque.y;
      const S rb = dot(m.r, m.b);
      mass += link.mass;
      moment += m.b + link.mass * m.r;
      const Vec2<S> mr = link.mass * m.r;
      G.xx += m.G.xx + (rb - m.r.x * m.b.x) + (rb - m.r.x * m.b.x) + mr.z * m.r.z;
      G.zz += m.G.zz + (rb - m.r.z * m.b.z) + (rb - m.r.z * m.b.z) + mr.x * m.r.x;
      G.xz += m.G.xz - m.r.x * m.b.z - m.r.z * m.b.x - mr.x * m.r.z;
      f0_s += f_s;
      n0 += n - f_s * perp(m.r);

      // Eliminate the joint.
      const Vec2<S> h = h_child + perp(m.b);
      const S inverse = S(1.0) / (J_child + link.J);
      Recovery& recovery = recoveries_[i];
      recovery = {inverse * (m.u - tau0), inverse * h};
      M.xx += link.mass - h.x * recovery.gain_f.x;
      M.zz += link.mass - h.z * recovery.gain_f.z;
      M.xz -= h.x * recovery.gain_f.z;
      f_child = f0 + recovery.gain * h;
      tau_child = m.u;
      if (i == 0) break;
      // To the hinge of the link before, d away.
      const Motion& before = motions_[i - 1];
      const Vec2<S> across = perp(before.d);
      f_child += M * before.d_bias;
      h_child = M * across;
      J_child = dot(across, h_child);
      tau_child += dot(across, f_child);
    }

    const Vec<S>&x = dcm_WC_.x, &along = dcm_WC_.y, &z = dcm_WC_.z;
    const Vec<S> lever = moment.x * z - moment.z * x;  // S cross s
    return {G.in_axes(x, z),
            M.in_axes(x, z) + Sym<S>::parallel(mass * along, along),
            {along.x * lever, along.y * lever, along.z * lever},
            n0.x * x + tau_child * along + n0.z * z,
            f_child.x * x + f0_s * along + f_child.z * z};
  }

  int mount_ = -1;
  Vec<S> r_HP_P_, r_HP_, r_HB_, a_bias_;
  Mat<S> dcm_PC_, dcm_WC_;
  std::vector<Link> links_;
  std::vector<Motion> motions_;
  std::vector<Recovery> recoveries_;
  Vec2<S> omega_;  // in-plane rate of the mount
  Plane<S> W_;     // omega omega^T - omega^2 1
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
