// A point mass at the end of two crossed hinges, such as a slosh pendulum: the recursion's two
// steps for it, written out. Its hinges leave it free across the rod, so that only the pull along
// the rod e is an answer to how the hub moves: with r its place and g = r x e,
//   M = m e e^T,  H = m g e^T,  J = m g g^T
// The joints' own efforts u push it along t1 (phi) and t2 (theta), which with e are three
// perpendicular unit vectors: forces u1 / (L cos theta) and u2 / L.
// Tested by tests/runtime/bsm_test.cpp (against the general limb).
#pragma once

#include <span>

#include "runtime/bsm/particle.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {

template <class H, class S>
requires KernelScalars<H, S>
class Bob : public Particle<H, S> {
 public:
  using Lanes = std::span<const LimbPlan* const>;  // one per lane of S, alike
  using Plans = std::span<const Plan* const>;      // whose limbs they are

  /// @param is_full  else lanes of a second limb are idle
  Bob(Lanes lanes, Plans plans, bool is_full, const Layout& layout) {
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      const LinkPlan &inner = lanes[l]->links.data()[0], &outer = lanes[l]->links.data()[1];
      set(l, plans[l]->tree.links.data()[inner.link], plans[l]->tree.links.data()[outer.link]);
      phi_.put(l, inner.link, layout);
      theta_.put(l, outer.link, layout);
      if (is_full || l % kLimbs<H, S> == 0) {
        phi_.set(l, plans[l]->tree.links.data()[inner.link]);
        theta_.set(l, plans[l]->tree.links.data()[outer.link]);
        this->set_mass(l, *plans[l], outer);
      } else {
        this->set_idle(l);
      }
    }
    this->put_mass(now_.mass);
  }

  void hold(std::size_t l, const LimbPlan& limb, const HeldInputsIn<Number<H>>& held) {
    if (this->is_idle(l)) return;
    phi_.hold(l, limb.links.data()[0].link, held);
    theta_.hold(l, limb.links.data()[1].link, held);
  }

  /// As of Limb: nothing pushes it.
  void watch() {}

  void move(const Number<H>* state, const Vec<S>& omega) {
    const S phi = gather<H, S>(state, phi_.position);
    const S theta = gather<H, S>(state, theta_.position);
    const S phi_dot = gather<H, S>(state, phi_.rate);
    const S theta_dot = gather<H, S>(state, theta_.rate);
    SineCosine<S> by_phi, by_theta;
    if constexpr (kTakesTwoAngles<S>) {
      put_sines_cosines(phi, theta, by_phi, by_theta);
    } else {
      by_phi = sine_cosine(phi);
      by_theta = sine_cosine(theta);
    }
    const S &sine = by_theta.sine, &cosine = by_theta.cosine;
    const Vec<S> ahead = by_phi.cosine * ahead_ + by_phi.sine * aside_;
    e_ = cosine * ahead + sine * up_;
    t1_ = by_phi.cosine * aside_ - by_phi.sine * ahead_;
    t2_ = cosine * up_ - sine * ahead;
    now_.r = r_HB_ + length_ * e_;
    g_ = cross(r_HB_, e_);
    inverse_reach_ = inverse_length_ / cosine;

    const S swing = length_ * cosine * phi_dot, nod = length_ * theta_dot;
    now_.w = swing * t1_ + nod * t2_;
    a_bias_ = cross(omega, cross(omega, now_.r) + now_.w + now_.w) - (swing * phi_dot) * ahead -
              ((sine + sine) * (nod * phi_dot)) * t1_ - (nod * theta_dot) * e_;
    phi_damping_ = phi_.damping * cosine * cosine;
    f1_ = inverse_reach_ * (phi_.pull(phi) - phi_damping_ * phi_dot);
    f2_ = inverse_length_ * (theta_.pull(theta) - theta_.damping * theta_dot);
  }

  void contribute(const Field<S>* field, const Vec<S>*, Law<S>& law) {
    if (field != nullptr) a_bias_ -= field->difference(now_.r);
    const Vec<S> me = now_.mass * e_, mg = now_.mass * g_;
    const Vec<S> f0 = dot(e_, a_bias_) * me + f1_ * t1_ + f2_ * t2_;
    law.M += Sym<S>::parallel(me, e_);
    law.J += Sym<S>::parallel(mg, g_);
    law.H.x += e_.x * mg;
    law.H.y += e_.y * mg;
    law.H.z += e_.z * mg;
    law.f0 += f0;
    law.n0 += cross(now_.r, f0);
  }

  void recover(const Vec<S>& omega_dot_B, const Vec<S>& a_B, Number<H>* rate) const {
    const Vec<S> a = a_B + cross(omega_dot_B, now_.r) + a_bias_;
    const S across = inverse_reach_ * (inverse_mass_ * f1_ - dot(t1_, a));
    scatter<H, S>(across, rate, phi_.rate);
    scatter<H, S>(inverse_length_ * (inverse_mass_ * f2_ - dot(t2_, a)), rate, theta_.rate);
  }

  // For the books, as of Limb.
  S inner_power(const Number<H>* state) const {
    const S phi_dot = gather<H, S>(state, phi_.rate), theta_dot = gather<H, S>(state, theta_.rate);
    return (phi_.effort - phi_damping_ * phi_dot) * phi_dot +
           (theta_.effort - theta_.damping * theta_dot) * theta_dot;
  }
  void trace(const Number<H>*) {}
  void add_loads(const Vec<S>*, Outside<S>&) const {}

 private:
  using Particle<H, S>::inverse_mass_;
  using Particle<H, S>::now_;

  struct Hinge {
    S stiffness{}, damping{}, rest{}, effort{};
    Places<H, S> position{}, rate{};

    void put(std::size_t l, int link, const Layout& layout) {
      position[l % kLimbs<H, S>] = layout.position(link);
      rate[l % kLimbs<H, S>] = layout.rate(link);
    }
    void set(std::size_t l, const bsm::LinkConstants& constants) {
      set_lane(stiffness, l, constants.stiffness);
      set_lane(damping, l, constants.damping);
      set_lane(rest, l, constants.rest);
    }
    void hold(std::size_t l, int link, const HeldInputsIn<Number<H>>& held) {
      set_lane(effort, l, held.effort.data()[link - 1]);
    }
    S pull(const S& angle) const { return effort - stiffness * (angle - rest); }
  };

  void set(std::size_t l, const bsm::LinkConstants& inner, const bsm::LinkConstants& outer) {
    const Matrix3d dcm_BI = inner.turn_fixed + inner.turn_cos;
    const Matrix3d dcm_BO = dcm_BI * (outer.turn_fixed + outer.turn_cos);
    const double length = outer.first_moment.norm() / outer.mass;
    const Vector3d ahead = dcm_BO * outer.first_moment.normalized();
    set_lane(r_HB_, l, inner.r_HP_P);
    set_lane(ahead_, l, ahead);
    set_lane(aside_, l, Vector3d(inner.axis_P.cross(ahead)));
    set_lane(up_, l, Vector3d((dcm_BI * outer.axis_P).cross(ahead)));
    set_lane(length_, l, length);
    set_lane(inverse_length_, l, 1.0 / length);
  }

  Hinge phi_, theta_;
  Vec<S> r_HB_;                // [m] the pivot
  Vec<S> ahead_, aside_, up_;  // e at zero angles, and where phi and theta turn it to
  S length_{}, inverse_length_{};
  Vec<S> e_, t1_, t2_, g_;
  Vec<S> a_bias_;  // [m/s^2] without the joints' accelerations, and less than what it falls with
  S inverse_reach_{};  // [1/m] 1 / (L cos theta)
  S phi_damping_{};    // [N m s/rad] as it is now
  S f1_{}, f2_{};      // [N]
};

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
