// See observer.h. Compiled once per instruction set, like kernel.cpp. Every link is moved from its
// parent, then all elements are summed up: first where the centre of mass is and how it moves, then
// what moves about it. Each lane is a state of its own. Tested by tests/runtime/observer_test.cpp.
#include <algorithm>
#include <array>
#include <vector>

#include "runtime/bsm/charts.h"
#include "runtime/bsm/observer.h"
#include "runtime/bsm/parts.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {
namespace {

using S = Abreast;
using Vector = Vec<S>;
using Motion = LinkMotion<S>;

/// Axes in which constants are given: the hub's, or those of a hinged link, turned so that the
/// third is that of its hinge. What is on a slide keeps the axes of what carries that.
struct Axes {
  const Motion* of = nullptr;
  bool turn = false;  // against the hub

  Vector to_hub(const Vector& v) const { return of->dcm_WL * v; }
};

struct Link {
  const Motion* parent = nullptr;
  Axes axes;  // that turn with the parent
  bool slides = false;
  bool is_off = false;  // the parent's origin; of hinges alone
  Mat<S> dcm;           // at zero; the third column is that of the joint
  Vector r_HP;          // [m] joint from the parent's origin
  S stiffness{}, rest{};
};

struct Element : ElementNow<S> {
  const Motion* link = nullptr;
  Axes axes;
  int tank = -1;
  bool is_off = false;       // the link's origin
  bool has_inertia = false;  // about its own centre
};

struct Rotor {
  Axes axes;
  Vector axis;
  S spin_inertia{};  // [kg m^2]
};

/// How an element moves, with the velocity of B taken as zero.
struct Moving {
  S mass{};          // [kg]
  Vector r_EB, v_E;  // [m], [m/s]
  Vector spin;       // [kg m^2/s] angular momentum about its own centre
};

Vector in_all(const Vec<double>& v) { return {S(v.x), S(v.y), S(v.z)}; }
Mat<S> in_all(const Mat<double>& m) { return {in_all(m.x), in_all(m.y), in_all(m.z)}; }
Sym<S> in_all(const Sym<double>& m) {
  return {S(m.xx), S(m.yy), S(m.zz), S(m.xy), S(m.xz), S(m.yz)};
}
S length(const Vector& v) { return root(dot(v, v)); }
bool has_mass(const MassElement& e) { return e.mass != 0.0 || !e.I_PntE_L.isZero(0.0); }

class LaneObserver final : public Observer {
 public:
  LaneObserver(const Plan& plan, const Assembly& assembly)
      : chart_(plan.chart),
        law_(plan.law),
        mu_(plan.mu),
        links_(plan.tree.links.size()),
        motions_(links_.size(), hub_itself<S>()) {
    const Axes hub{&motions_[0], false};
    const int omega = Layout::kAttitude + (chart_ == AttitudeChart::kMrp ? 3 : 4);
    const int joint = omega + 3;
    layout_ = {omega, joint, joint + plan.joints(), joint + 2 * plan.joints()};
    std::vector<Axes> axes(links_.size(), hub);                                   // of each link
    std::vector<Mat<double>> dcm_AL(links_.size(), hub_itself<double>().dcm_WL);  // into these
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (i > 0) add_link(i, plan.tree.links.data()[i], axes, dcm_AL);
      for (const MassElement& element : assembly.links.data()[i].elements)
        if (has_mass(element)) add_element(i, element, axes[i], dcm_AL[i]);
    }
    moving_.resize(elements_.size());
    state_.resize(static_cast<std::size_t>(layout_.wheel) + plan.tree.rotors.size());
    shares_.resize(plan.tree.tanks);
    for (const RotorConstants& rotor : plan.tree.rotors) {
      const auto i = static_cast<std::size_t>(rotor.link);
      rotors_.push_back({axes[i], in_all(dcm_AL[i] * vec(rotor.axis_L)), S(rotor.spin_inertia)});
    }
  }

  std::size_t lanes() const override { return kLanes<S>; }

  void observe(std::span<const Noted> noted) override {
    put_side_by_side(noted);
    move_links();
    find_center();
    sum_up();
    add_rotors();
    put_states(noted);
    put_sums(noted);
  }

 private:
  void add_link(std::size_t i, const LinkConstants& from, std::vector<Axes>& axes,
                std::vector<Mat<double>>& dcm_AL) {
    const auto p = static_cast<std::size_t>(from.parent);
    const Mat<double>& dcm_AP = dcm_AL[p];
    Link& link = links_[i];
    link.parent = &motions_[p];
    link.axes = axes[p];
    link.slides = from.kind == JointKind::kSlide;
    link.dcm = in_all(dcm_AP * mat(from.dcm_PK0));
    link.r_HP = in_all(dcm_AP * vec(from.r_HP_P));
    link.is_off = !from.r_HP_P.isZero(0.0);
    link.stiffness = S(from.stiffness);
    link.rest = S(from.rest);
    axes[i] = link.slides ? link.axes : Axes{&motions_[i], true};
    dcm_AL[i] = link.slides ? dcm_AP * mat(from.turn_fixed) : mat(from.dcm_KL);
  }

  void add_element(std::size_t i, const MassElement& from, const Axes& axes,
                   const Mat<double>& dcm_AL) {
    ElementNow<double> turned;
    turned.set(0, from);
    turned.turn(dcm_AL);
    Element& element = elements_.emplace_back();
    element.mass = S(turned.mass);
    element.r_EL = in_all(turned.r_EL);
    element.I = in_all(turned.I);
    element.link = &motions_[i];
    element.axes = axes;
    element.tank = from.tank;
    element.is_off = !from.r_EL_L.isZero(0.0);
    element.has_inertia = !from.I_PntE_L.isZero(0.0);
  }

  /// Idle lanes take the first state, so that nothing depends on what has been there.
  void put_side_by_side(std::span<const Noted> noted) {
    std::array<const double*, kLanes<S>> states, shares;
    for (std::size_t l = 0; l < kLanes<S>; ++l) {
      const Noted& from = noted.data()[l < noted.size() ? l : 0];
      states.data()[l] = from.state;
      shares.data()[l] = from.shares;
    }
    for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = entry_of_each(states, i);
    for (std::size_t k = 0; k < shares_.size(); ++k) shares_[k] = entry_of_each(shares, k);
  }

  Vector vector(int at) const {
    const S* first = state_.data() + at;
    return {first[0], first[1], first[2]};
  }

  void move_links() {
    motions_[0].omega = vector(layout_.omega);
    S springs{};
    const std::size_t count = links_.size();
    for (std::size_t i = 1; i < count; ++i) {
      const Link& link = links_[i];
      const S& q = state_.data()[layout_.position(static_cast<int>(i))];
      const S& q_dot = state_.data()[layout_.rate(static_cast<int>(i))];
      if (link.slides)
        slide(link, q, q_dot, motions_[i]);
      else
        turn(link, q, q_dot, motions_[i]);
      const S stretch = q - link.rest;
      springs += link.stiffness * stretch * stretch;
    }
    springs_ = S(0.5) * springs;
  }

  static void slide(const Link& link, const S& q, const S& q_dot, Motion& to) {
    if (link.axes.turn)
      slide(link, link.axes.to_hub(link.r_HP), link.axes.to_hub(link.dcm.z), q, q_dot, to);
    else
      slide(link, link.r_HP, link.dcm.z, q, q_dot, to);
  }
  /// The same with the link's constants in hub axes.
  static void slide(const Link& link, const Vector& r_HP, const Vector& axis, const S& q,
                    const S& q_dot, Motion& to) {
    const Vector r_LP = r_HP + q * axis;
    to.r_LB = link.parent->r_LB + r_LP;
    to.v_LB = plus_cross(link.parent->v_LB + q_dot * axis, link.axes.of->omega, r_LP);
  }

  static void turn(const Link& link, const S& q, const S& q_dot, Motion& to) {
    if (link.axes.turn)
      turn_from(link.axes.of->dcm_WL * link.dcm, link, q, q_dot, to);
    else
      turn_from(link.dcm, link, q, q_dot, to);
    to.r_LB = link.parent->r_LB;
    to.v_LB = link.parent->v_LB;
    if (!link.is_off) return;
    const Vector r_HP = link.axes.turn ? link.axes.to_hub(link.r_HP) : link.r_HP;
    to.r_LB += r_HP;
    to.v_LB = plus_cross(to.v_LB, link.axes.of->omega, r_HP);
  }
  /// @param at_zero  its axes at angle zero, in hub axes
  static void turn_from(const Mat<S>& at_zero, const Link& link, const S& q, const S& q_dot,
                        Motion& to) {
    const auto [sine, cosine] = sine_cosine(q);
    to.dcm_WL.x = cosine * at_zero.x + sine * at_zero.y;
    to.dcm_WL.y = cosine * at_zero.y - sine * at_zero.x;
    to.dcm_WL.z = at_zero.z;
    to.omega = link.axes.of->omega + q_dot * at_zero.z;
  }

  void find_center() {
    S mass{}, spin_energy{};
    Vector moment, momentum;
    const std::size_t count = elements_.size();
    for (std::size_t e = 0; e < count; ++e) {
      Moving& now = moving_[e];
      move(elements_[e], now, spin_energy);
      mass += now.mass;
      moment += now.mass * now.r_EB;
      momentum += now.mass * now.v_E;
    }
    const S inverse_mass = S(1.0) / mass;
    mass_ = mass;
    r_CB_ = inverse_mass * moment;
    v_CB_ = inverse_mass * momentum;
    kinetic_ = spin_energy;
  }

  void move(const Element& element, Moving& to, S& spin_energy) const {
    const S share = element.tank < 0 ? S(1.0) : shares_.data()[element.tank];
    to.mass = share * element.mass;
    if (!element.is_off) {
      to.r_EB = element.link->r_LB;
      to.v_E = element.link->v_LB;
    } else if (element.axes.turn) {
      put_off(element, element.axes.to_hub(element.r_EL), to);
    } else {
      put_off(element, element.r_EL, to);
    }
    if (!element.has_inertia) return;
    to.spin = spin(element, share);
    spin_energy += S(0.5) * dot(element.axes.of->omega, to.spin);
  }
  /// @param r_EL  in hub axes
  static void put_off(const Element& element, const Vector& r_EL, Moving& to) {
    to.r_EB = element.link->r_LB + r_EL;
    to.v_E = plus_cross(element.link->v_LB, element.axes.of->omega, r_EL);
  }
  static Vector spin(const Element& element, const S& share) {
    const Motion& carrier = *element.axes.of;
    if (!element.axes.turn) return share * (element.I * carrier.omega);
    return carrier.dcm_WL * (share * (element.I * transposed(carrier.dcm_WL, carrier.omega)));
  }

  void sum_up() {
    Vector H;
    S twice{}, H_scale{}, momentum_scale{};
    for (const Moving& now : moving_) {
      const Vector v_EC = now.v_E - v_CB_, momentum = now.mass * v_EC;
      const Vector H_E = plus_cross(now.spin, now.r_EB - r_CB_, momentum);
      H += H_E;
      H_scale += length(H_E);
      momentum_scale += now.mass * length(now.v_E);
      twice += dot(momentum, v_EC);
    }
    H_ = H;
    kinetic_ += S(0.5) * twice;
    H_scale_ = H_scale;
    momentum_scale_ = momentum_scale;
  }

  /// Elements carry a wheel's whole tensor at the mount's rate; its own spin comes on top.
  void add_rotors() {
    const S* speeds = state_.data() + layout_.wheel;
    for (const Rotor& rotor : rotors_) {
      const S& speed = *speeds++;
      const Vector axis = rotor.axes.turn ? rotor.axes.to_hub(rotor.axis) : rotor.axis;
      const S spin = rotor.spin_inertia * speed;
      H_ += spin * axis;
      H_scale_ += root(spin * spin);
      kinetic_ += spin * (dot(axis, rotor.axes.of->omega) + S(0.5) * speed);
    }
  }

  /// What a state shows by itself.
  void put_states(std::span<const Noted> noted) const {
    const auto* numbers = reinterpret_cast<const double*>(state_.data());
    const Quaternion<S> q_BN = chart_ == AttitudeChart::kMrp
                                   ? quaternion_of(Mrp<S>(numbers, Layout::kAttitude))
                                   : Quaternion<S>(numbers, Layout::kAttitude).normalised();
    const S sign = chosen(S(0.0) > q_BN.w, S(-1.0), S(1.0));
    const S w = sign * q_BN.w;
    const Vector v = sign * q_BN.v;
    for (std::size_t l = 0; l < noted.size(); ++l) {
      const double* state = noted[l].state;
      Observation& to = *noted[l].seen;
      to.r_BN_N = Vector3d::Map(state);
      to.v_BN_N = Vector3d::Map(state + 3);
      to.q_BN.w() = lane(w, l);
      to.q_BN.x() = lane(v.x, l);
      to.q_BN.y() = lane(v.y, l);
      to.q_BN.z() = lane(v.z, l);
      to.omega_BN_B = Vector3d::Map(state + layout_.omega);
      const std::size_t joints = links_.size() - 1;
      put(state + layout_.joint, joints, to.joint_position);
      put(state + layout_.joint_rate, joints, to.joint_rate);
      put(state + layout_.wheel, rotors_.size(), to.wheel_rate);
    }
  }
  static void put(const double* from, std::size_t count, std::vector<double>& to) {
    if (to.size() != count) to.resize(count);
    std::copy_n(from, count, to.data());
  }

  void put_sums(std::span<const Noted> noted) const {
    const auto* numbers = reinterpret_cast<const double*>(state_.data());
    const Mat<S> dcm_NB = chart_ == AttitudeChart::kMrp
                              ? Mrp<S>(numbers, Layout::kAttitude).dcm_NB()
                              : Quaternion<S>(numbers, Layout::kAttitude).dcm_NB();
    const Vector r_BN = vector(0), v_BN = vector(3);
    const Vector r_CN = plus_product(r_BN, dcm_NB, r_CB_);
    const Vector v_CN = plus_product(v_BN, dcm_NB, v_CB_);
    const Vector momentum = mass_ * v_CN, H_PntC_N = dcm_NB * H_;
    const S kinetic = S(0.5) * mass_ * dot(v_CN, v_CN) + kinetic_;
    const S potential = springs_ + gravity(transposed(dcm_NB, r_BN));
    const S momentum_scale = momentum_scale_ + mass_ * length(v_BN);
    for (std::size_t l = 0; l < noted.size(); ++l) {
      Observation& to = *noted[l].seen;
      to.mass = lane(mass_, l);
      put(r_CN, l, to.r_CN_N);
      put(v_CN, l, to.v_CN_N);
      put(momentum, l, to.momentum);
      put(H_PntC_N, l, to.H_PntC_N);
      to.kinetic = lane(kinetic, l);
      to.own_kinetic = lane(kinetic_, l);
      to.springs = lane(springs_, l);
      to.potential = lane(potential, l);
      to.momentum_scale = lane(momentum_scale, l);
      to.H_scale = lane(H_scale_, l);
    }
  }
  static void put(const Vector& v, std::size_t l, Vector3d& to) {
    to.x() = lane(v.x, l);
    to.y() = lane(v.y, l);
    to.z() = lane(v.z, l);
  }

  /// Its potential [J].
  S gravity(const Vector& r_BN_B) const {
    if (law_ == GravityLaw::kNone) return {};
    const S minus_mu(-mu_);
    if (law_ == GravityLaw::kSystemCom) return minus_mu * mass_ / length(r_BN_B + r_CB_);
    S per_distance{};
    for (const Moving& now : moving_) per_distance += now.mass / length(r_BN_B + now.r_EB);
    return minus_mu * per_distance;
  }

  AttitudeChart chart_;
  GravityLaw law_;
  double mu_;  // [m^3/s^2]
  Layout layout_;
  std::vector<Link> links_;  // [0]: the hub, unused
  std::vector<Element> elements_;
  std::vector<Rotor> rotors_;

  // Of the last observation, in hub axes, with the velocity of B taken as zero.
  std::vector<S> state_, shares_;
  std::vector<Motion> motions_;  // dcm_WL and omega of hinged links and the hub alone
  std::vector<Moving> moving_;   // as elements_
  S mass_{}, springs_{}, kinetic_{}, H_scale_{}, momentum_scale_{};  // kinetic: about C
  Vector r_CB_, v_CB_, H_;
};

}  // namespace

Observer* new_observer(const Plan& plan, const Assembly& assembly) {
  return new LaneObserver(plan, assembly);
}

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
