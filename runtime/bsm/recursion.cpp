// See recursion.h. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/recursion.h"

#include <algorithm>
#include <cmath>

namespace twincraft::bsm {
namespace {

/// The entries of a chain's joints among those of all joints.
template <class T>
std::span<T> part_of(const PlanarChain& chain, std::span<T> of_all_joints) {
  return of_all_joints.subspan(chain.first() - 1, chain.size());
}

Matrix3d solved(const Ldl3& M, const Matrix3d& H) {
  Matrix3d coupling;
  for (int row = 0; row < 3; ++row) coupling.col(row) = M.solve(H.row(row));
  return coupling;
}

}  // namespace

Recursion::Recursion(const Assembly& assembly, Chains chains)
    : tree_(prepare(assembly)),
      poses_(tree_.links.size()),
      motions_(tree_.links.size()),
      laws_(tree_.links.size()),
      recoveries_(tree_.links.size()),
      omega_dots_(tree_.links.size()),
      accelerations_(tree_.links.size()),
      chain_wrenches_(tree_.links.size()) {
  // The hub's own frame is the working frame: its pose never changes, its mass only by draining.
  const LinkConstants& hub = tree_.links.front();
  poses_.front() = {Matrix3d::Identity(), Vector3d::Zero()};
  motions_.front().J = hub.J_L;
  motions_.front().moment = hub.first_moment;
  if (chains == Chains::kPlanar) find_chains();
  for (std::size_t i = 1; i < tree_.links.size(); ++i) {
    const bool in_chain = std::any_of(tails_.begin(), tails_.end(), [i](const Tail& tail) {
      return i >= tail.chain.first() && i < tail.chain.first() + tail.chain.size();
    });
    if (!in_chain) singles_.push_back(i);
  }
  if (tree_.links.size() == 1 && !hub.drains) {
    begin_law(0);
    rigid_hub_.emplace(laws_.front());
  }
}

void Recursion::find_chains() {
  for (std::size_t i = 1; i < tree_.links.size(); ++i) {
    std::optional<PlanarChain> chain = PlanarChain::from(tree_, i);
    if (!chain) continue;
    i += chain->size() - 1;
    const Matrix3d dcm_PC = chain->dcm_PC();
    const Vector3d r_HP_P = chain->r_HP_P();
    tails_.push_back({std::move(*chain), dcm_PC, r_HP_P, Vector3d::Zero()});
  }
}

void Recursion::move_link(std::size_t i, double q, double q_dot) {
  const LinkConstants& link = tree_.links[i];
  const auto p = static_cast<std::size_t>(link.parent);
  const LinkPose& parent = poses_[p];
  const Vector3d& omega_P = motions_[p].omega;
  Motion& motion = motions_[i];
  LinkPose& pose = poses_[i];

  motion.axis.noalias() = parent.dcm_WL * link.axis_P;
  motion.r_HP.noalias() = parent.dcm_WL * link.r_HP_P;
  if (link.kind == JointKind::kHinge) {
    const Matrix3d dcm_PL =
        link.turn_fixed + std::cos(q) * link.turn_cos + std::sin(q) * link.turn_sin;
    pose.dcm_WL.noalias() = parent.dcm_WL * dcm_PL;
    motion.omega = omega_P + q_dot * motion.axis;
    motion.omega_bias = q_dot * omega_P.cross(motion.axis);
    motion.a_bias = omega_P.cross(omega_P.cross(motion.r_HP));
  } else {
    pose.dcm_WL.noalias() = parent.dcm_WL * link.turn_fixed;
    motion.r_HP += q * motion.axis;
    motion.omega = omega_P;
    motion.omega_bias.setZero();
    motion.a_bias = omega_P.cross(omega_P.cross(motion.r_HP) + (2.0 * q_dot) * motion.axis);
  }
  pose.r_LB_W = parent.r_LB_W + motion.r_HP;
  motion.J = link.J_L.turned(pose.dcm_WL);
  motion.moment.noalias() = pose.dcm_WL * link.first_moment;
  motion.rotor_momentum.setZero();
}

void Recursion::add_rotor_momentum(std::span<const double> rotor_speed) {
  for (std::size_t k = 0; k < tree_.rotors.size(); ++k) {
    const RotorConstants& rotor = tree_.rotors[k];
    const auto i = static_cast<std::size_t>(rotor.link);
    const Vector3d axis = poses_[i].dcm_WL * rotor.axis_L;
    Motion& motion = motions_[i];
    motion.rotor_momentum +=
        (rotor.spin_inertia * (rotor_speed[k] + axis.dot(motion.omega))) * axis;
  }
}

void Recursion::hang(Tail& tail, std::span<const double> q, std::span<const double> q_dot) {
  PlanarChain& chain = tail.chain;
  const LinkPose& mount = poses_[chain.mount()];
  const Vector3d& omega = motions_[chain.mount()].omega;
  if (chain.mount() != 0) {  // the hub's axes are the working axes
    tail.dcm_WC.noalias() = mount.dcm_WL * chain.dcm_PC();
    tail.r_HP.noalias() = mount.dcm_WL * chain.r_HP_P();
  }
  tail.a_bias = omega.cross(omega.cross(tail.r_HP));
  chain.move(part_of(chain, q), part_of(chain, q_dot), tail.dcm_WC.transpose() * omega);
}

void Recursion::set_shares(std::span<const double> shares) {
  bsm::set_shares(tree_, shares);
  motions_.front().J = tree_.links.front().J_L;
  motions_.front().moment = tree_.links.front().first_moment;
}

void Recursion::move(std::span<const double> q, std::span<const double> q_dot,
                     const Vector3d& omega_BN_B, std::span<const double> rotor_speed) {
  motions_.front().omega = omega_BN_B;
  motions_.front().rotor_momentum.setZero();
  for (const std::size_t i : singles_) move_link(i, q[i - 1], q_dot[i - 1]);
  for (Tail& tail : tails_) hang(tail, q, q_dot);
  add_rotor_momentum(rotor_speed);
  placed_ = tails_.empty();
}

std::span<const LinkPose> Recursion::poses() {
  if (placed_) return poses_;
  for (const Tail& tail : tails_) {
    const PlanarChain& chain = tail.chain;
    const auto poses = std::span(poses_).subspan(chain.first(), chain.size());
    const Vector3d r_HB = poses_[chain.mount()].r_LB_W + tail.r_HP;
    chain.place(poses);
    for (LinkPose& pose : poses) {
      pose = {tail.dcm_WC * pose.dcm_WL, r_HB + tail.dcm_WC * pose.r_LB_W};
    }
  }
  placed_ = true;
  return poses_;
}

void Recursion::begin_law(std::size_t i) {
  const Motion& motion = motions_[i];
  const Vector3d& omega = motion.omega;
  Law& law = laws_[i];
  law.J = motion.J;
  law.H = tilde(motion.moment);
  law.M = Sym3::isotropic(tree_.links[i].mass);
  law.n0 = omega.cross(motion.J * omega + motion.rotor_momentum);
  law.f0 = omega.cross(omega.cross(motion.moment));
}

void Recursion::eliminate(std::size_t i, double effort) {
  const LinkConstants& link = tree_.links[i];
  const Motion& motion = motions_[i];
  const Vector3d& s = motion.axis;
  Law& law = laws_[i];

  // Known part of the link's own acceleration.
  const Vector3d n0 = law.n0 + law.J * motion.omega_bias + law.H * motion.a_bias;
  const Vector3d f0 = law.f0 + law.H.transpose() * motion.omega_bias + law.M * motion.a_bias;

  // U: how n and f answer to qDDot; along the joint the effort alone acts.
  const bool hinge = link.kind == JointKind::kHinge;
  const Vector3d U_n = hinge ? law.J * s : Vector3d(law.H * s);
  const Vector3d U_f = hinge ? Vector3d(law.H.transpose() * s) : law.M * s;
  const double inverse = 1.0 / s.dot(hinge ? U_n : U_f);
  const double gain = inverse * (effort - s.dot(hinge ? n0 : f0));
  Recovery& r = recoveries_[i];
  r = {gain, inverse * U_n, inverse * U_f};

  law.J.subtract_parallel(U_n, r.gain_n);
  law.H.noalias() -= U_n * r.gain_f.transpose();
  law.M.subtract_parallel(U_f, r.gain_f);
  law.n0 = n0 + gain * U_n;
  law.f0 = f0 + gain * U_f;
  hand_over(law, motion.r_HP, laws_[static_cast<std::size_t>(link.parent)]);
}

// To the parent's origin, d away: a' = a_P + omegaDot_P x d and n_P = n + d x f give
//   H_P = H + d~ M,  J_P = J + Z + Z^T with Z = d~ (H + d~ M / 2)^T.
void Recursion::hand_over(const Law& law, const Vector3d& d, Law& parent) {
  Matrix3d K;  // d~ M
  K.col(0) = d.cross(Vector3d(law.M.xx, law.M.xy, law.M.xz));
  K.col(1) = d.cross(Vector3d(law.M.xy, law.M.yy, law.M.yz));
  K.col(2) = d.cross(Vector3d(law.M.xz, law.M.yz, law.M.zz));
  const Matrix3d G = law.H + 0.5 * K;
  parent.J += law.J;
  parent.J.add_twice_symmetric(d.cross(Vector3d(G.row(0))), d.cross(Vector3d(G.row(1))),
                               d.cross(Vector3d(G.row(2))));
  parent.H += law.H + K;
  parent.M += law.M;
  parent.n0 += law.n0 + d.cross(law.f0);
  parent.f0 += law.f0;
}

Recursion::HubFactors::HubFactors(const Law& hub)
    : M(hub.M), coupling(solved(M, hub.H)), schur(Sym3::from(hub.J.full() - hub.H * coupling)) {}

void Recursion::solve_hub(const HubFactors& factors) {
  const Law& hub = laws_.front();
  omega_dot_ = factors.schur.solve(factors.coupling.transpose() * hub.f0 - hub.n0);
  acceleration_ = -factors.M.solve(hub.f0) - factors.coupling * omega_dot_;
  omega_dots_.front() = omega_dot_;
  accelerations_.front() = acceleration_;
}

double Recursion::recover(std::size_t i) {
  const LinkConstants& link = tree_.links[i];
  const auto p = static_cast<std::size_t>(link.parent);
  const Motion& motion = motions_[i];
  const Recovery& r = recoveries_[i];
  const Vector3d a_joint = accelerations_[p] + omega_dots_[p].cross(motion.r_HP);
  const double q_ddot = r.gain - r.gain_n.dot(omega_dots_[p]) - r.gain_f.dot(a_joint);
  omega_dots_[i] = omega_dots_[p] + motion.omega_bias;
  accelerations_[i] = a_joint + motion.a_bias;
  (link.kind == JointKind::kHinge ? omega_dots_ : accelerations_)[i] += q_ddot * motion.axis;
  return q_ddot;
}

void Recursion::recover(const Tail& tail, std::span<double> q_ddot) const {
  const PlanarChain& chain = tail.chain;
  const Vector3d& alpha = omega_dots_[chain.mount()];
  const Vector3d a_H = accelerations_[chain.mount()] + alpha.cross(tail.r_HP) + tail.a_bias;
  chain.recover(tail.dcm_WC.col(1).dot(alpha), tail.dcm_WC.transpose() * a_H,
                part_of(chain, q_ddot));
}

void Recursion::apply(std::span<const Wrench> wrenches) {
  for (std::size_t i = 0; i < wrenches.size(); ++i) {
    const Wrench& wrench = wrenches[i];
    laws_[i].f0 -= wrench.force_W;
    laws_[i].n0 -= wrench.torque_PntB_W - poses_[i].r_LB_W.cross(wrench.force_W);
  }
}

void Recursion::contribute(Tail& tail, std::span<const double> q, std::span<const double> q_dot,
                           std::span<const double> effort, std::span<const Wrench> wrenches) {
  PlanarChain& chain = tail.chain;
  std::span<Wrench> of_chain;
  if (!wrenches.empty()) {
    of_chain = std::span(chain_wrenches_).subspan(chain.first(), chain.size());
    const Vector3d r_HB = poses_[chain.mount()].r_LB_W + tail.r_HP;
    for (std::size_t i = 0; i < of_chain.size(); ++i) {
      const Wrench& wrench = wrenches[chain.first() + i];
      const Vector3d torque_PntH = wrench.torque_PntB_W - r_HB.cross(wrench.force_W);
      of_chain[i] = {tail.dcm_WC.transpose() * wrench.force_W,
                     tail.dcm_WC.transpose() * torque_PntH};
    }
  }
  Law law = chain.law(part_of(chain, q), part_of(chain, q_dot), part_of(chain, effort), of_chain,
                      tail.dcm_WC);
  law.n0 += law.H * tail.a_bias;
  law.f0 += law.M * tail.a_bias;
  hand_over(law, tail.r_HP, laws_[chain.mount()]);
}

void Recursion::accelerate(std::span<const double> q, std::span<const double> q_dot,
                           const Inputs& inputs, std::span<const Wrench> wrenches,
                           std::span<double> q_ddot, std::span<double> rotor_rate) {
  begin_law(0);
  for (const std::size_t i : singles_) begin_law(i);
  apply(wrenches);
  for (std::size_t k = 0; k < tree_.rotors.size(); ++k) {
    const auto i = static_cast<std::size_t>(tree_.rotors[k].link);
    laws_[i].n0 += poses_[i].dcm_WL * (inputs.motor_torque[k] * tree_.rotors[k].axis_L);
  }
  for (Tail& tail : tails_) contribute(tail, q, q_dot, inputs.effort, wrenches);
  for (std::size_t k = singles_.size(); k-- > 0;) {
    const std::size_t i = singles_[k];
    const LinkConstants& link = tree_.links[i];
    eliminate(i, inputs.effort[i - 1] - link.stiffness * (q[i - 1] - link.rest) -
                     damping_of(link, q) * q_dot[i - 1]);
  }
  if (rigid_hub_) {
    solve_hub(*rigid_hub_);
  } else {
    solve_hub(HubFactors(laws_.front()));
  }
  for (const std::size_t i : singles_) q_ddot[i - 1] = recover(i);
  for (const Tail& tail : tails_) recover(tail, q_ddot);
  for (std::size_t k = 0; k < tree_.rotors.size(); ++k) {
    const RotorConstants& rotor = tree_.rotors[k];
    const auto i = static_cast<std::size_t>(rotor.link);
    const Vector3d axis = poses_[i].dcm_WL * rotor.axis_L;
    rotor_rate[k] = inputs.motor_torque[k] / rotor.spin_inertia - axis.dot(omega_dots_[i]);
  }
}

void Recursion::rates(std::span<const double> q_dot, std::span<LinkRate> rates) {
  const std::span<const LinkPose> pose = poses();
  rates.front() = {motions_.front().omega, Vector3d::Zero()};
  for (std::size_t i = 1; i < tree_.links.size(); ++i) {
    const LinkConstants& link = tree_.links[i];
    const auto p = static_cast<std::size_t>(link.parent);
    const Vector3d axis = pose[p].dcm_WL * link.axis_P;
    rates[i] = rates[p];
    rates[i].v_LN_W += rates[p].omega_LN_W.cross(pose[i].r_LB_W - pose[p].r_LB_W);
    (link.kind == JointKind::kHinge ? rates[i].omega_LN_W : rates[i].v_LN_W) += q_dot[i - 1] * axis;
  }
}

Recursion::HubEquation Recursion::hub_equation() const {
  const Law& hub = laws_.front();
  HubEquation equation;
  equation.matrix << hub.M.full(), hub.H.transpose(), hub.H, hub.J.full();
  equation.right << -hub.f0, -hub.n0;
  return equation;
}

}  // namespace twincraft::bsm
