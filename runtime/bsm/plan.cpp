// See plan.h. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/plan.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace twincraft::bsm {
namespace {

// Products of rotation matrices leave a few ulp where an exact zero was meant.
constexpr double kZero = 1.0e-14;

std::array<double, 2> in_plane(const Vector3d& v) { return {v.x(), v.z()}; }

/// Chain axes with s as second axis, in mount axes; x along the given direction where it can.
Matrix3d chain_axes(const Vector3d& s, const Vector3d& along) {
  Vector3d x = along - along.dot(s) * s;
  if (x.norm() < 0.1 * along.norm() || along.isZero(0.0)) x = s.unitOrthogonal();
  x.normalize();
  Matrix3d dcm_PC;
  dcm_PC << x, s, x.cross(s);
  return dcm_PC;
}

std::vector<int> rotors_on(const Tree& tree, std::size_t link) {
  std::vector<int> rotors;
  for (std::size_t k = 0; k < tree.rotors.size(); ++k) {
    if (tree.rotors[k].link == static_cast<int>(link)) rotors.push_back(static_cast<int>(k));
  }
  return rotors;
}

bool has_elements(GravityLaw law) {
  return law == GravityLaw::kBodyCom || law == GravityLaw::kBodyGradient;
}

/// In a falling frame an element at the hub's origin feels nothing but the gradient of its own.
std::vector<MassElement> elements_of(const Link& link, GravityLaw law) {
  std::vector<MassElement> elements;
  if (!has_elements(law)) return elements;
  for (const MassElement& e : link.elements) {
    const bool falls_with_hub =
        link.parent < 0 && law == GravityLaw::kBodyCom && e.r_EL_L.isZero(0.0);
    if (e.mass <= 0.0 || falls_with_hub) continue;
    elements.push_back(e);
  }
  return elements;
}

/// What decides about the planar path.
struct Candidates {
  const Tree& tree;
  const Assembly& assembly;
  GravityLaw law;
  std::vector<bool> is_loaded;
  std::vector<bool> decides;  // its angle decides about another joint
};

/// How many links from `first` on form an unbranched tail of the tree; zero: none do.
std::size_t tail_length(const Tree& tree, std::size_t first) {
  std::size_t last = first;
  while (last + 1 < tree.links.size() && tree.links[last + 1].parent == static_cast<int>(last)) {
    if (tree.links[last].children > 1) return 0;
    ++last;
  }
  return tree.links[last].children == 0 ? last - first + 1 : 0;
}

bool may_be_planar(const Candidates& of, std::size_t i) {
  const LinkConstants& link = of.tree.links[i];
  return link.kind == JointKind::kHinge && !link.drains && link.damped_by_cosine_of < 0 &&
         !of.is_loaded[i] && !of.decides[i] && rotors_on(of.tree, i).empty();
}

/// Link i of a chain in chain axes. @param dcm_CL  link to chain axes at angle zero
std::optional<PlanarLinkPlan> planar_link(const Candidates& of, std::size_t i,
                                          const Matrix3d& dcm_CL) {
  const LinkConstants& link = of.tree.links[i];
  const Matrix3d J = dcm_CL * link.J_L * dcm_CL.transpose();
  const Vector3d moment = dcm_CL * link.first_moment;
  const double size = J.trace();
  if (std::abs(J(0, 1)) > kZero * size || std::abs(J(1, 2)) > kZero * size) return std::nullopt;
  if (std::abs(moment.y()) > kZero * moment.norm()) return std::nullopt;
  PlanarLinkPlan plan;
  plan.link = static_cast<int>(i);
  plan.mass = link.mass;
  plan.first_moment = in_plane(moment);
  plan.G = {J(0, 0), J(2, 2), J(0, 2)};
  plan.J = J(1, 1);
  plan.stiffness = link.stiffness;
  plan.damping = link.damping;
  plan.rest = link.rest;
  plan.elements = elements_of(of.assembly.links[i], of.law);
  for (MassElement& element : plan.elements) element.r_EL_L = dcm_CL * element.r_EL_L;
  return plan;
}

/// A straight link moves as one without a first moment and a particle at the next hinge that has
/// all of it, and that particle may as well be the next link's. Only the last link keeps a first
/// moment.
void move_masses_to_hinges(std::vector<PlanarLinkPlan>& links) {
  for (std::size_t i = 0; i + 1 < links.size(); ++i) {
    PlanarLinkPlan& link = links[i];
    const double next = link.next[0], first_moment = link.first_moment[0];
    if (first_moment == 0.0) continue;
    const double mass = first_moment / next;
    link.mass -= mass;
    links[i + 1].mass += mass;
    link.first_moment[0] = 0.0;
    link.G[1] -= first_moment * next;
    link.J -= first_moment * next;
  }
}

/// See ChainPlan::is_straight.
bool straighten(ChainPlan& chain) {
  const auto is_along = [](const PlanarLinkPlan& link) {
    return std::abs(link.next[1]) <= kZero * std::abs(link.next[0]) &&
           std::abs(link.first_moment[1]) <= kZero * std::abs(link.first_moment[0]) &&
           std::abs(link.G[2]) <= kZero * (link.G[0] + link.G[1]);
  };
  // Else the particle would be far heavier than the link, and digits would go.
  const auto reaches_center = [](const PlanarLinkPlan& link) {
    return std::abs(link.first_moment[0]) <= 4.0 * link.mass * std::abs(link.next[0]);
  };
  const std::span all_but_last = std::span(chain.links).first(chain.links.size() - 1);
  if (!std::ranges::all_of(chain.links, is_along) ||
      !std::ranges::all_of(all_but_last, reaches_center))
    return false;
  for (PlanarLinkPlan& link : chain.links) link.next[1] = link.first_moment[1] = link.G[2] = 0.0;
  move_masses_to_hinges(chain.links);
  return true;
}

/// The whole subtree from link `first` on as a planar chain, if it is one: each link the only child
/// of the one before, hinges parallel, everything balanced about their plane, no rotors or loads,
/// masses and dampings constant.
std::optional<ChainPlan> planar_chain(const Candidates& of, std::size_t first) {
  const std::size_t count = tail_length(of.tree, first);
  if (count == 0 || of.law == GravityLaw::kBodyGradient) return std::nullopt;
  const LinkConstants& root = of.tree.links[first];
  ChainPlan chain;
  chain.r_HP_P = root.r_HP_P;
  chain.dcm_PC = chain_axes(root.axis_P, (root.turn_fixed + root.turn_cos) * root.first_moment);

  Matrix3d dcm_CL = chain.dcm_PC.transpose();  // of the link before
  for (std::size_t i = first; i < first + count; ++i) {
    const LinkConstants& link = of.tree.links[i];
    if (!may_be_planar(of, i)) return std::nullopt;
    if ((dcm_CL * link.axis_P - Vector3d::UnitY()).norm() > kZero) return std::nullopt;
    if (i > first) {
      const Vector3d next = dcm_CL * link.r_HP_P;
      if (std::abs(next.y()) > kZero * next.norm()) return std::nullopt;
      chain.links.back().next = in_plane(next);
    }
    dcm_CL = dcm_CL * (link.turn_fixed + link.turn_cos);
    std::optional<PlanarLinkPlan> planar = planar_link(of, i, dcm_CL);
    if (!planar) return std::nullopt;
    chain.links.push_back(std::move(*planar));
  }
  chain.is_straight = straighten(chain);
  return chain;
}

/// Sorts links into limbs, parents before children.
class LimbBuilder {
 public:
  explicit LimbBuilder(const Candidates& of)
      : of_(of), limb_of_(of.tree.links.size(), -1), place_in_limb_(of.tree.links.size(), -1) {}

  std::vector<LimbPlan> build(ChainPath paths) {
    for (std::size_t i = 1; i < of_.tree.links.size(); ++i) {
      std::optional<ChainPlan> chain;
      if (paths == ChainPath::kPlanar) chain = planar_chain(of_, i);
      if (!chain) {
        add_link(i);
        continue;
      }
      i += chain->links.size() - 1;
      add_chain(std::move(*chain));
    }
    for (LimbPlan& limb : limbs_) {  // may be a link that comes later
      for (LinkPlan& link : limb.links) {
        const int by = of_.tree.links[index(link.link)].damped_by_cosine_of;
        if (by >= 0) link.damped_by_cosine_of = place_of(by);
      }
      if (paths == ChainPath::kPlanar) limb.kind = kind_of(limb);
    }
    return std::move(limbs_);
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  /// Of a link's parent; a limb begins on the hub.
  LimbPlan& limb_on(int parent, std::size_t link) {
    if (parent == 0) {
      limb_of_[link] = static_cast<int>(limbs_.size());
      return limbs_.emplace_back();
    }
    limb_of_[link] = limb_of_[index(parent)];
    return limbs_[index(limb_of_[link])];
  }
  int place_of(int link) const { return link == 0 ? -1 : place_in_limb_[index(link)]; }

  LimbKind kind_of(const LimbPlan& limb) const {
    if (limb.links.empty()) return LimbKind::kChain;
    if (!limb.chains.empty() || of_.law == GravityLaw::kBodyGradient) return LimbKind::kTree;
    for (const LinkPlan& link : limb.links)
      if (!link.rotors.empty()) return LimbKind::kTree;
    if (limb.links.size() == 1 && is_point(limb.links[0])) return LimbKind::kPoint;
    if (limb.links.size() == 2 && is_bob(limb.links[0], limb.links[1])) return LimbKind::kBob;
    return LimbKind::kTree;
  }

  bool is_point(const LinkPlan& only) const {
    const LinkConstants& link = of_.tree.links[index(only.link)];
    return only.slides && only.damped_by_cosine_of < 0 && link.first_moment.isZero(0.0) &&
           link.J_L.isZero(0.0);
  }

  bool is_bob(const LinkPlan& inner, const LinkPlan& outer) const {
    const LinkConstants& phi = of_.tree.links[index(inner.link)];
    const LinkConstants& theta = of_.tree.links[index(outer.link)];
    if (outer.parent != 0 || inner.slides || outer.slides || inner.damped_by_cosine_of != 1 ||
        outer.damped_by_cosine_of >= 0 || of_.is_loaded[index(inner.link)] ||
        of_.is_loaded[index(outer.link)] || !theta.r_HP_P.isZero(0.0) ||
        !of_.assembly.links[index(inner.link)].elements.empty() ||
        !is_at_one_point(of_.assembly.links[index(outer.link)].elements))
      return false;
    const Vector3d rod = (theta.turn_fixed + theta.turn_cos) * theta.first_moment.normalized();
    const Matrix3d dcm_BI = phi.turn_fixed + phi.turn_cos;
    const Vector3d inner_axis = dcm_BI.transpose() * phi.axis_P;
    return std::abs(inner_axis.dot(theta.axis_P)) < kZero &&
           std::abs(inner_axis.dot(rod)) < kZero && std::abs(theta.axis_P.dot(rod)) < kZero;
  }
  static bool is_at_one_point(const std::vector<MassElement>& elements) {
    return !elements.empty() && std::ranges::all_of(elements, [&](const MassElement& e) {
      return e.mass > 0.0 && e.r_EL_L == elements.front().r_EL_L && !e.r_EL_L.isZero(0.0) &&
             e.I_PntE_L.isZero(0.0);
    });
  }

  void add_link(std::size_t i) {
    const LinkConstants& link = of_.tree.links[i];
    LimbPlan& limb = limb_on(link.parent, i);
    place_in_limb_[i] = static_cast<int>(limb.links.size());
    limb.links.push_back({static_cast<int>(i), place_of(link.parent),
                          link.kind == JointKind::kSlide, -1,
                          elements_of(of_.assembly.links[i], of_.law), rotors_on(of_.tree, i)});
  }

  void add_chain(ChainPlan chain) {
    const auto first = index(chain.links.front().link);
    const int parent = of_.tree.links[first].parent;
    chain.mount = place_of(parent);
    limb_on(parent, first).chains.push_back(std::move(chain));
  }

  const Candidates& of_;
  std::vector<LimbPlan> limbs_;
  std::vector<int> limb_of_, place_in_limb_;
};

}  // namespace

bool are_alike(const LimbPlan& a, const LimbPlan& b) {
  const auto like_links = [](const LinkPlan& x, const LinkPlan& y) {
    return x.parent == y.parent && x.slides == y.slides &&
           x.damped_by_cosine_of == y.damped_by_cosine_of &&
           x.elements.size() == y.elements.size() && x.rotors.size() == y.rotors.size();
  };
  const auto like_chains = [](const ChainPlan& x, const ChainPlan& y) {
    return x.mount == y.mount && x.is_straight == y.is_straight &&
           std::equal(
               x.links.begin(), x.links.end(), y.links.begin(), y.links.end(),
               [](const auto& p, const auto& q) { return p.elements.size() == q.elements.size(); });
  };
  return a.kind == b.kind &&
         std::equal(a.links.begin(), a.links.end(), b.links.begin(), b.links.end(), like_links) &&
         std::equal(a.chains.begin(), a.chains.end(), b.chains.begin(), b.chains.end(),
                    like_chains);
}

namespace {

bool are_alike(const LinkConstants& a, const LinkConstants& b) {
  return a.parent == b.parent && a.kind == b.kind && a.damped_by_cosine_of == b.damped_by_cosine_of;
}

bool are_alike(const Draining& a, const Draining& b) {
  const auto tank_of = [](const Draining::Part& part) { return part.tank; };
  return a.link == b.link && a.is_point == b.is_point &&
         std::ranges::equal(a.parts, b.parts, {}, tank_of, tank_of);
}

bool are_alike(const Stream& a, const Stream& b) {
  return a.nozzle == b.nozzle && a.links() == b.links();
}

}  // namespace

bool are_alike(const Plan& a, const Plan& b) {
  const auto alike = [](const auto& x, const auto& y) { return are_alike(x, y); };
  const auto is_balanced = [](const Plan& plan) {
    return plan.tree.links.front().first_moment.isZero(0.0);
  };
  const auto link_of = [](const auto& rotor) { return rotor.link; };
  return a.chart == b.chart && a.law == b.law && a.tree.tanks == b.tree.tanks &&
         is_balanced(a) == is_balanced(b) && a.hub.elements.size() == b.hub.elements.size() &&
         std::ranges::equal(a.tree.links, b.tree.links, alike) &&
         std::ranges::equal(a.tree.rotors, b.tree.rotors, {}, link_of, link_of) &&
         std::ranges::equal(a.tree.draining, b.tree.draining, alike) &&
         std::ranges::equal(a.forces.streams, b.forces.streams, alike) &&
         std::ranges::equal(a.limbs, b.limbs, alike);
}

double Plan::mass() const {
  double sum = 0.0;
  for (const LinkConstants& link : tree.links) sum += link.mass;
  return sum;
}

std::size_t Plan::planar_links() const {
  std::size_t count = 0;
  for (const LimbPlan& limb : limbs) {
    for (const ChainPlan& chain : limb.chains) count += chain.links.size();
  }
  return count;
}

Plan make_plan(const Assembly& assembly, AttitudeChart chart, const Gravity& gravity,
               const std::vector<Load>& loads, ChainPath paths, Forces forces) {
  Plan plan;
  plan.tree = prepare(assembly);
  plan.chart = chart;
  plan.mu = gravity.mu;
  plan.law = gravity.bsm;
  plan.forces = std::move(forces);
  std::vector<bool> is_loaded(assembly.links.size(), false), decides = is_loaded;
  for (const Load& load : loads) is_loaded[static_cast<std::size_t>(load.link)] = true;
  for (const int link : links_of(plan.forces)) is_loaded[static_cast<std::size_t>(link)] = true;
  for (const LinkConstants& link : plan.tree.links) {
    if (link.damped_by_cosine_of >= 0) {
      decides[static_cast<std::size_t>(link.damped_by_cosine_of)] = true;
    }
  }
  plan.hub.elements = elements_of(assembly.links.front(), plan.law);
  plan.hub.rotors = rotors_on(plan.tree, 0);
  const Candidates candidates{plan.tree, assembly, plan.law, std::move(is_loaded),
                              std::move(decides)};
  plan.limbs = LimbBuilder(candidates).build(paths);
  return plan;
}

template struct HeldInputsIn<double>;

}  // namespace twincraft::bsm
