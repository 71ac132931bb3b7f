// See planar_chain.h. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/planar_chain.h"

#include <cmath>

namespace twincraft::bsm {
namespace {

// Products of rotation matrices leave a few ulp where an exact zero was meant.
constexpr double kZero = 1.0e-14;

Vector2d in_plane(const Vector3d& v) { return {v.x(), v.z()}; }

/// Chain axes with s as second axis, in mount axes; x along the given direction where it can.
Matrix3d chain_axes(const Vector3d& s, const Vector3d& along) {
  Vector3d x = along - along.dot(s) * s;
  if (x.norm() < 0.1 * along.norm() || along.isZero(0.0)) x = s.unitOrthogonal();
  x.normalize();
  Matrix3d dcm_PC;
  dcm_PC << x, s, x.cross(s);
  return dcm_PC;
}

bool carries_rotor(const Tree& tree, std::size_t link) {
  for (const RotorConstants& rotor : tree.rotors) {
    if (rotor.link == static_cast<int>(link)) return true;
  }
  return false;
}

/// How many links from `first` on form an unbranched tail of the tree; zero: none do.
std::size_t tail_length(const Tree& tree, std::size_t first) {
  std::size_t last = first;
  while (last + 1 < tree.links.size() && tree.links[last + 1].parent == static_cast<int>(last)) {
    if (tree.links[last].children > 1) return 0;
    ++last;
  }
  return tree.links[last].children == 0 ? last - first + 1 : 0;
}

}  // namespace

std::optional<PlanarChain> PlanarChain::from(const Tree& tree, std::size_t first) {
  const std::size_t count = tail_length(tree, first);
  if (count == 0 || tree.links[first].kind != JointKind::kHinge) return std::nullopt;
  PlanarChain chain;
  chain.first_ = first;
  chain.mount_ = static_cast<std::size_t>(tree.links[first].parent);
  chain.r_HP_P_ = tree.links[first].r_HP_P;
  const Matrix3d dcm_PL0 = tree.links[first].turn_fixed + tree.links[first].turn_cos;
  chain.dcm_PC_ = chain_axes(tree.links[first].axis_P, dcm_PL0 * tree.links[first].first_moment);

  Matrix3d dcm_CL = chain.dcm_PC_.transpose();  // of the link before
  for (std::size_t i = first; i < first + count; ++i) {
    const auto& link = tree.links[i];
    const Vector3d axis_C = dcm_CL * link.axis_P;
    if (link.kind != JointKind::kHinge || carries_rotor(tree, i)) return std::nullopt;
    if (link.drains || link.damped_by_cosine_of >= 0) return std::nullopt;
    if ((axis_C - Vector3d::UnitY()).norm() > kZero) return std::nullopt;
    if (i > first) {
      const Vector3d next = dcm_CL * link.r_HP_P;
      if (std::abs(next.y()) > kZero * next.norm()) return std::nullopt;
      chain.links_.back().next = in_plane(next);
    }
    dcm_CL = dcm_CL * (link.turn_fixed + link.turn_cos);
    const Sym3 J = link.J_L.turned(dcm_CL);
    const Vector3d moment = dcm_CL * link.first_moment;
    const double size = J.xx + J.yy + J.zz;
    if (std::abs(J.xy) > kZero * size || std::abs(J.yz) > kZero * size) return std::nullopt;
    if (std::abs(moment.y()) > kZero * moment.norm()) return std::nullopt;
    chain.links_.push_back({link.mass,
                            in_plane(moment),
                            Vector2d::Zero(),
                            {J.xx, J.zz, J.xz},
                            J.yy,
                            link.stiffness,
                            link.damping,
                            link.rest,
                            dcm_CL});
  }
  chain.motions_.resize(count);
  chain.recoveries_.resize(count);
  return chain;
}

PlanarChain::Plane PlanarChain::turned(const Plane& G, double c, double s) {
  const double mean = 0.5 * (G.xx + G.zz), half = 0.5 * (G.xx - G.zz);
  const double c2 = c * c - s * s, s2 = 2.0 * c * s;
  const double turned_half = c2 * half + s2 * G.xz;
  return {mean + turned_half, mean - turned_half, c2 * G.xz - s2 * half};
}

void PlanarChain::move(std::span<const double> q, std::span<const double> q_dot,
                       const Vector3d& omega_P_C) {
  omega_ = in_plane(omega_P_C);
  W_ = {-omega_[1] * omega_[1], -omega_[0] * omega_[0], omega_[0] * omega_[1]};
  double theta = 0.0, theta_dot = 0.0, a_s = 0.0;
  Vector2d r = Vector2d::Zero();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const LinkConstants& link = links_[i];
    LinkMotion& motion = motions_[i];
    theta += q[i];
    theta_dot += q_dot[i];
    const double c = std::cos(theta), s = std::sin(theta);
    const auto turn = [c, s](const Vector2d& v) {
      return Vector2d(c * v[0] + s * v[1], c * v[1] - s * v[0]);
    };
    motion.cosine = c;
    motion.sine = s;
    motion.theta_dot = theta_dot;
    motion.nu = omega_P_C.y() + theta_dot;
    motion.b = turn(link.first_moment);
    motion.d = turn(link.next);
    motion.G = turned(link.G, c, s);
    motion.d_bias = W_ * motion.d - (motion.nu * motion.nu) * motion.d;
    motion.r = r;
    motion.a_s = a_s;
    r += motion.d;
    a_s += (motion.nu + theta_dot) * omega_.dot(motion.d);
  }
}

Law PlanarChain::law(std::span<const double> q, std::span<const double> q_dot,
                     std::span<const double> effort, std::span<const Wrench> wrenches_C,
                     const Matrix3d& dcm_WC) {
  const Vector2d w = -perp(omega_);  // omega x s
  const double ww = omega_[1] * omega_[1] - omega_[0] * omega_[0];
  // Of the locked chain about the root hinge: mass, first moment, in-plane inertia, and biases.
  double mass = 0.0, f0_s = 0.0;
  Vector2d S = Vector2d::Zero(), n0 = Vector2d::Zero();
  Plane G;
  // Of the plane, about the hinge of the link at hand; what the link after it hands over.
  Plane M;
  double J_child = 0.0, tau_child = 0.0;
  Vector2d h_child = Vector2d::Zero(), f_child = Vector2d::Zero();

  for (std::size_t i = links_.size(); i-- > 0;) {
    const LinkConstants& link = links_[i];
    const LinkMotion& m = motions_[i];

    double f_s = link.mass * m.a_s + (m.nu + m.theta_dot) * omega_.dot(m.b);
    Vector2d n = m.theta_dot * (m.G * w) + (link.J * m.nu) * w + m.nu * perp(m.G * omega_) -
                 m.a_s * perp(m.b);
    Vector2d f0 = f_child + W_ * m.b - (m.nu * m.nu) * m.b;
    double tau0 = tau_child + m.G.xz * ww + (m.G.xx - m.G.zz) * omega_[0] * omega_[1];
    if (!wrenches_C.empty()) {
      const Wrench& wrench = wrenches_C[i];
      const Vector2d f_plane = in_plane(wrench.force_W);
      f_s -= wrench.force_W.y();
      f0 -= f_plane;
      tau0 -= wrench.torque_PntB_W.y() - perp(m.r).dot(f_plane);
      n -= in_plane(wrench.torque_PntB_W) + wrench.force_W.y() * perp(m.r);
    }
    const double rb = m.r.dot(m.b), rr = link.mass * m.r.squaredNorm();
    mass += link.mass;
    S += m.b + link.mass * m.r;
    G.xx += m.G.xx + 2.0 * (rb - m.r[0] * m.b[0]) + rr - link.mass * m.r[0] * m.r[0];
    G.zz += m.G.zz + 2.0 * (rb - m.r[1] * m.b[1]) + rr - link.mass * m.r[1] * m.r[1];
    G.xz += m.G.xz - m.r[0] * m.b[1] - m.r[1] * m.b[0] - link.mass * m.r[0] * m.r[1];
    f0_s += f_s;
    n0 += n - f_s * perp(m.r);

    // Eliminate the joint.
    const double u = effort[i] - link.stiffness * (q[i] - link.rest) - link.damping * q_dot[i];
    const Vector2d h = h_child + perp(m.b);
    const double inverse = 1.0 / (J_child + link.J);
    Recovery& recovery = recoveries_[i];
    recovery = {inverse * (u - tau0), inverse * h};
    M.xx += link.mass - h[0] * recovery.gain_f[0];
    M.zz += link.mass - h[1] * recovery.gain_f[1];
    M.xz -= h[0] * recovery.gain_f[1];
    f_child = f0 + recovery.gain * h;
    tau_child = u;
    if (i == 0) break;
    // To the hinge of the link before, d away.
    const LinkMotion& before = motions_[i - 1];
    const Vector2d across = perp(before.d);
    f_child += M * before.d_bias;
    h_child = M * across;
    J_child = across.dot(h_child);
    tau_child += across.dot(f_child);
  }

  const Vector3d x = dcm_WC.col(0), along = dcm_WC.col(1), z = dcm_WC.col(2);
  Law law;
  law.J = G.in_axes(x, z);
  law.M = M.in_axes(x, z);
  law.M += Sym3::from_parallel(mass * along, along);
  law.H.noalias() = (S[0] * z - S[1] * x) * along.transpose();  // S cross s a_s
  law.n0 = n0[0] * x + tau_child * along + n0[1] * z;
  law.f0 = f_child[0] * x + f0_s * along + f_child[1] * z;
  return law;
}

void PlanarChain::recover(double alpha_s, const Vector3d& a_H_C, std::span<double> q_ddot) const {
  Vector2d a = in_plane(a_H_C);
  double before = alpha_s;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const double alpha = recoveries_[i].gain - recoveries_[i].gain_f.dot(a);
    q_ddot[i] = alpha - before;
    a += alpha * perp(motions_[i].d) + motions_[i].d_bias;
    before = alpha;
  }
}

void PlanarChain::place(std::span<LinkPose> poses_C) const {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const LinkMotion& motion = motions_[i];
    Matrix3d turn;
    turn << motion.cosine, 0.0, motion.sine, 0.0, 1.0, 0.0, -motion.sine, 0.0, motion.cosine;
    poses_C[i] = {turn * links_[i].dcm_CL, {motion.r[0], 0.0, motion.r[1]}};
  }
}

}  // namespace twincraft::bsm
