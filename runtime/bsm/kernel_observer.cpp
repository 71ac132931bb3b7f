// See observer.h. Compiled once per instruction set, like kernel.cpp. Every link is moved from its
// parent, then all elements are summed up, two at a time: first where the centre of mass is and how
// it moves, then what moves about it. Tested by tests/runtime/observer_test.cpp.
#include <array>
#include <cmath>
#include <vector>

#include "runtime/bsm/charts.h"
#include "runtime/bsm/observer.h"
#include "runtime/bsm/parts.h"

namespace twincraft::bsm::TWINCRAFT_KERNEL {
namespace {

using Vector = Vec<double>;
using Motion = LinkMotion<double>;

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
  bool is_off = false;    // the parent's origin; of hinges alone
  std::size_t hinge = 0;  // which one of all
  Mat<double> dcm;        // at zero; the third column is that of the joint
  Vector r_HP;            // [m] joint from the parent's origin
  double stiffness = 0.0, rest = 0.0;
};

struct Element : ElementNow<double> {
  const Motion* link = nullptr;
  Axes axes;
  int tank = -1;
  bool is_off = false;       // the link's origin
  bool has_inertia = false;  // about its own centre
};

struct Rotor {
  Axes axes;
  Vector axis;
  double spin_inertia = 0.0;  // [kg m^2]
};

/// How an element moves, or two of them, with the velocity of B taken as zero.
template <class S>
struct Moving {
  S mass{};          // [kg]
  Vec<S> r_EB, v_E;  // [m], [m/s]
  Vec<S> spin;       // [kg m^2/s] angular momentum about its own centre
};

Vec<Pair> side_by_side(const Vector& a, const Vector& b) {
  return {two_lanes<Pair>(a.x, b.x), two_lanes<Pair>(a.y, b.y), two_lanes<Pair>(a.z, b.z)};
}
Moving<Pair> side_by_side(const Moving<double>& a, const Moving<double>& b) {
  return {two_lanes<Pair>(a.mass, b.mass), side_by_side(a.r_EB, b.r_EB), side_by_side(a.v_E, b.v_E),
          side_by_side(a.spin, b.spin)};
}
double sum(const Pair& value) { return sum_of_lanes(value, true); }
Vector sum(const Vec<Pair>& v) { return {sum(v.x), sum(v.y), sum(v.z)}; }
Vector vector(const double* at) { return {at[0], at[1], at[2]}; }
template <class S>
S length(const Vec<S>& v) {
  return root(dot(v, v));
}
void put(const Vector& v, double* to) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}

bool has_mass(const MassElement& e) { return e.mass != 0.0 || !e.I_PntE_L.isZero(0.0); }

class PairObserver final : public Observer {
 public:
  PairObserver(const Plan& plan, const Assembly& assembly)
      : chart_(plan.chart),
        law_(plan.law),
        mu_(plan.mu),
        links_(plan.tree.links.size()),
        motions_(links_.size(), hub_itself<double>()) {
    const Axes hub{&motions_[0], false};
    const int omega = Layout::kAttitude + (chart_ == AttitudeChart::kMrp ? 3 : 4);
    const int joint = omega + 3;
    layout_ = {omega, joint, joint + plan.joints(), joint + 2 * plan.joints()};
    std::vector<Axes> axes(links_.size(), hub);                          // of each link
    std::vector<Mat<double>> dcm_AL(links_.size(), motions_[0].dcm_WL);  // into these
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (i > 0) add_link(i, plan.tree.links.data()[i], axes, dcm_AL);
      for (const MassElement& element : assembly.links.data()[i].elements)
        if (has_mass(element)) add_element(i, element, axes[i], dcm_AL[i]);
    }
    if (elements_.size() % 2 != 0) elements_.emplace_back().link = hub.of;  // weighs nothing
    moving_.resize(elements_.size() / 2);
    sines_.resize(2 * hinges_.size());
    cosines_.resize(2 * hinges_.size());
    for (const RotorConstants& rotor : plan.tree.rotors) {
      const auto i = static_cast<std::size_t>(rotor.link);
      rotors_.push_back({axes[i], dcm_AL[i] * vec(rotor.axis_L), rotor.spin_inertia});
    }
  }

  void observe(const double* state, std::span<const double> shares, Observation& seen) override {
    const Mat<double> dcm_NB = chart_ == AttitudeChart::kMrp
                                   ? Mrp<double>(state, Layout::kAttitude).dcm_NB()
                                   : Quaternion<double>(state, Layout::kAttitude).dcm_NB();
    move_links(state, seen);
    find_center(shares.data());
    sum_up();
    add_rotors(state);
    put_sums(state, dcm_NB, seen);
    seen.potential = seen.springs + gravity(vector(state), dcm_NB);
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
    link.dcm = dcm_AP * mat(from.dcm_PK0);
    link.r_HP = dcm_AP * vec(from.r_HP_P);
    link.is_off = !from.r_HP_P.isZero(0.0);
    link.stiffness = from.stiffness;
    link.rest = from.rest;
    if (!link.slides) {
      if (hinge_count_ % 2 == 0) hinges_.push_back({});
      link.hinge = hinge_count_;
      for (std::size_t l = hinge_count_++ % 2; l < 2; ++l) hinges_.back()[l] = i - 1;
    }
    axes[i] = link.slides ? link.axes : Axes{&motions_[i], true};
    dcm_AL[i] = link.slides ? dcm_AP * mat(from.turn_fixed) : mat(from.dcm_KL);
  }

  void add_element(std::size_t i, const MassElement& from, const Axes& axes,
                   const Mat<double>& dcm_AL) {
    Element element;
    element.set(0, from);
    element.turn(dcm_AL);
    element.link = &motions_[i];
    element.axes = axes;
    element.tank = from.tank;
    element.is_off = !from.r_EL_L.isZero(0.0);
    element.has_inertia = !from.I_PntE_L.isZero(0.0);
    elements_.push_back(element);
  }

  void find_sines(const double* q) {
    const std::size_t pairs = hinges_.size();
    for (std::size_t k = 0; k < pairs; ++k) {
      const std::array<std::size_t, 2>& at = hinges_[k];
      const auto [sine, cosine] = sine_cosine(two_lanes<Pair>(q[at[0]], q[at[1]]));
      sine.store_unaligned(&sines_[2 * k]);
      cosine.store_unaligned(&cosines_[2 * k]);
    }
  }

  void move_links(const double* state, Observation& seen) {
    const double* q = state + layout_.joint;
    const double* q_dot = state + layout_.joint_rate;
    find_sines(q);
    motions_[0].omega = vector(state + layout_.omega);
    double springs = 0.0;
    const std::size_t count = links_.size();
    for (std::size_t i = 1; i < count; ++i) {
      const Link& link = links_[i];
      if (link.slides)
        slide(link, q[i - 1], q_dot[i - 1], motions_[i]);
      else
        turn(link, q_dot[i - 1], motions_[i]);
      const double stretch = q[i - 1] - link.rest;
      springs += link.stiffness * stretch * stretch;
    }
    seen.springs = 0.5 * springs;
  }

  static void slide(const Link& link, double q, double q_dot, Motion& to) {
    if (link.axes.turn)
      slide(link, link.axes.to_hub(link.r_HP), link.axes.to_hub(link.dcm.z), q, q_dot, to);
    else
      slide(link, link.r_HP, link.dcm.z, q, q_dot, to);
  }
  /// The same with the link's constants in hub axes.
  static void slide(const Link& link, const Vector& r_HP, const Vector& axis, double q,
                    double q_dot, Motion& to) {
    const Vector r_LP = r_HP + q * axis;
    to.r_LB = link.parent->r_LB + r_LP;
    to.v_LB = plus_cross(link.parent->v_LB + q_dot * axis, link.axes.of->omega, r_LP);
  }

  void turn(const Link& link, double q_dot, Motion& to) const {
    if (link.axes.turn)
      turn(link, link.axes.of->dcm_WL * link.dcm, q_dot, to);
    else
      turn(link, link.dcm, q_dot, to);
    to.r_LB = link.parent->r_LB;
    to.v_LB = link.parent->v_LB;
    if (!link.is_off) return;
    const Vector r_HP = link.axes.turn ? link.axes.to_hub(link.r_HP) : link.r_HP;
    to.r_LB += r_HP;
    to.v_LB = plus_cross(to.v_LB, link.axes.of->omega, r_HP);
  }
  /// @param at_zero  its axes at angle zero, in hub axes
  void turn(const Link& link, const Mat<double>& at_zero, double q_dot, Motion& to) const {
    const double sine = sines_[link.hinge], cosine = cosines_[link.hinge];
    const Vector& omega = link.axes.of->omega;
    to.dcm_WL.x = cosine * at_zero.x + sine * at_zero.y;
    to.dcm_WL.y = cosine * at_zero.y - sine * at_zero.x;
    to.dcm_WL.z = at_zero.z;
    to.omega = omega + q_dot * at_zero.z;
  }

  void find_center(const double* shares) {
    Pair mass(0.0);
    Vec<Pair> moment, momentum;
    spin_energy_ = 0.0;
    const Element* element = elements_.data();
    for (Moving<Pair>& now : moving_) {
      Moving<double> a, b;
      move(*element++, shares, a);
      move(*element++, shares, b);
      now = side_by_side(a, b);
      mass += now.mass;
      moment += now.mass * now.r_EB;
      momentum += now.mass * now.v_E;
    }
    mass_ = sum(mass);
    r_CB_ = (1.0 / mass_) * sum(moment);
    v_CB_ = (1.0 / mass_) * sum(momentum);
  }

  void move(const Element& element, const double* shares, Moving<double>& to) {
    const double share = element.tank < 0 ? 1.0 : shares[element.tank];
    to.mass = share * element.mass;
    if (!element.is_off) {
      to.r_EB = element.link->r_LB;
      to.v_E = element.link->v_LB;
    } else if (element.axes.turn) {
      put_off(element, element.axes.to_hub(element.r_EL), to);
    } else {
      put_off(element, element.r_EL, to);
    }
    if (element.has_inertia) spin(element, share, to);
  }
  /// @param r_EL  in hub axes
  static void put_off(const Element& element, const Vector& r_EL, Moving<double>& to) {
    to.r_EB = element.link->r_LB + r_EL;
    to.v_E = plus_cross(element.link->v_LB, element.axes.of->omega, r_EL);
  }
  void spin(const Element& element, double share, Moving<double>& to) {
    const Motion& carrier = *element.axes.of;
    if (element.axes.turn) {
      const Vector omega = transposed(carrier.dcm_WL, carrier.omega);
      to.spin = carrier.dcm_WL * (share * (element.I * omega));
    } else {
      to.spin = share * (element.I * carrier.omega);
    }
    spin_energy_ += 0.5 * dot(carrier.omega, to.spin);
  }

  void sum_up() {
    const Vec<Pair> r_CB = side_by_side(r_CB_, r_CB_), v_CB = side_by_side(v_CB_, v_CB_);
    Vec<Pair> H;
    Pair kinetic(0.0), H_scale(0.0), momentum_scale(0.0);
    for (const Moving<Pair>& now : moving_) {
      const Vec<Pair> v_EC = now.v_E - v_CB, momentum = now.mass * v_EC;
      const Vec<Pair> H_E = plus_cross(now.spin, now.r_EB - r_CB, momentum);
      H += H_E;
      H_scale += length(H_E);
      momentum_scale += now.mass * length(now.v_E);
      kinetic += dot(momentum, v_EC);
    }
    H_ = sum(H);
    kinetic_ = 0.5 * sum(kinetic) + spin_energy_;
    H_scale_ = sum(H_scale);
    momentum_scale_ = sum(momentum_scale);
  }

  /// Elements carry a wheel's whole tensor at the mount's rate; its own spin comes on top.
  void add_rotors(const double* state) {
    const double* speeds = state + layout_.wheel;
    for (std::size_t k = 0; k < rotors_.size(); ++k) {
      const Rotor& rotor = rotors_[k];
      const Vector axis = rotor.axes.turn ? rotor.axes.to_hub(rotor.axis) : rotor.axis;
      const double spin = rotor.spin_inertia * speeds[k];
      H_ += spin * axis;
      H_scale_ += std::abs(spin);
      kinetic_ += spin * (dot(axis, rotor.axes.of->omega) + 0.5 * speeds[k]);
    }
  }

  void put_sums(const double* state, const Mat<double>& dcm_NB, Observation& seen) const {
    const Vector v_BN = vector(state + 3);
    const Vector v_CN = plus_product(v_BN, dcm_NB, v_CB_);
    seen.mass = mass_;
    put(plus_product(vector(state), dcm_NB, r_CB_), seen.r_CN_N.data());
    put(v_CN, seen.v_CN_N.data());
    put(mass_ * v_CN, seen.momentum.data());
    put(dcm_NB * H_, seen.H_PntC_N.data());
    seen.kinetic = 0.5 * mass_ * dot(v_CN, v_CN) + kinetic_;
    seen.own_kinetic = kinetic_;
    seen.momentum_scale = momentum_scale_ + mass_ * length(v_BN);
    seen.H_scale = H_scale_;
  }

  /// Its potential [J].
  double gravity(const Vector& r_BN_N, const Mat<double>& dcm_NB) const {
    if (law_ == GravityLaw::kNone) return 0.0;
    const Vector r_BN_B = transposed(dcm_NB, r_BN_N);
    if (law_ == GravityLaw::kSystemCom) return -mu_ * mass_ / length(r_BN_B + r_CB_);
    const Vec<Pair> r_BN = side_by_side(r_BN_B, r_BN_B);
    Pair per_distance(0.0);
    for (const Moving<Pair>& now : moving_) per_distance += now.mass / length(r_BN + now.r_EB);
    return -mu_ * sum(per_distance);
  }

  AttitudeChart chart_;
  GravityLaw law_;
  double mu_;  // [m^3/s^2]
  Layout layout_;
  std::vector<Link> links_;                         // [0]: the hub, unused
  std::vector<std::array<std::size_t, 2>> hinges_;  // in pairs: where in q; the last twice if odd
  std::size_t hinge_count_ = 0;
  std::vector<Element> elements_;  // in pairs
  std::vector<Rotor> rotors_;

  // Of the last observation, in hub axes, with the velocity of B taken as zero.
  std::vector<Motion> motions_;          // dcm_WL and omega of hinged links and the hub alone
  std::vector<double> sines_, cosines_;  // of the angles of hinges
  std::vector<Moving<Pair>> moving_;     // elements
  double mass_ = 0.0, spin_energy_ = 0.0, kinetic_ = 0.0, H_scale_ = 0.0, momentum_scale_ = 0.0;
  Vector r_CB_, v_CB_, H_;
};

}  // namespace

Observer* new_observer(const Plan& plan, const Assembly& assembly) {
  return new PairObserver(plan, assembly);
}

}  // namespace twincraft::bsm::TWINCRAFT_KERNEL
