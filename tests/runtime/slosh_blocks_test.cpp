// The published contributions of a slosh particle and of a spherical pendulum to the hub's
// equation, in deep space, against the recursion: the whole equation with the effector's blocks in
// it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/kernel_of.h"

namespace twincraft {
namespace {

using test::HubEquation;

constexpr double kHubMass = 600.0;
const Matrix3d kHubInertia = Vector3d(400.0, 380.0, 360.0).asDiagonal();
const Vector3d kOmega(0.3, -0.5, 0.2);

/// A point mass that moves in the hub, and its blocks as printed.
struct Effector {
  double m;
  Vector3d r, r_prime;
  Matrix3d A, B, C, D;
  Vector3d vT, vR;
};

HubEquation hub_with(const Effector& e) {
  const double m = kHubMass + e.m;
  const Vector3d c = e.m * e.r / m, c_prime = e.m * e.r_prime / m;
  const Matrix3d I = kHubInertia + e.m * tilde(e.r) * tilde(e.r).transpose();
  const Matrix3d I_prime = -e.m * (tilde(e.r_prime) * tilde(e.r) + tilde(e.r) * tilde(e.r_prime));
  HubEquation equation;
  equation.matrix << m * Matrix3d::Identity() + e.A, -m * tilde(c) + e.B, m * tilde(c) + e.C,
      I + e.D;
  equation.right << -2.0 * m * kOmega.cross(c_prime) - m * kOmega.cross(kOmega.cross(c)) + e.vT,
      -kOmega.cross(I * kOmega) - I_prime * kOmega + e.vR;
  return equation;
}

Assembly hub() {
  Assembly assembly;
  assembly.links.push_back({"hub", -1, {}, {{"hub", kHubMass, Vector3d::Zero(), kHubInertia}}});
  return assembly;
}

HubEquation ours(const Assembly& assembly, const std::vector<double>& q,
                 const std::vector<double>& q_dot) {
  test::KernelOf kernel(assembly);
  kernel.accelerations({kOmega, q, q_dot, {}}, test::inputs_of(assembly));
  return kernel.hub_equation();
}

void expect_equal(const HubEquation& a, const HubEquation& b) {
  EXPECT_LT((a.matrix - b.matrix).norm(), 1e-13 * b.matrix.norm());
  EXPECT_LT((a.right - b.right).norm(), 1e-13 * b.right.norm());
}

/// Allard, Diaz Ramos, Schaub: a linear spring-mass-damper along p from r_P.
TEST(Kernel, GivesThePublishedBlocksOfASloshParticle) {
  const double m = 25.0, k = 10.9, c = 0.8, rho = 0.13, rho_dot = -0.4;
  const Vector3d p = Vector3d(1.0, 2.0, -2.0) / 3.0, r_P(0.3, -0.2, 0.8);
  Assembly assembly = hub();
  Joint slide;
  slide.kind = JointKind::kSlide;
  slide.r_HP_P = r_P;
  slide.axis_L = p;
  slide.stiffness = k;
  slide.damping = c;
  assembly.links.push_back({"blob", 0, slide, {{"blob", m, Vector3d::Zero(), Matrix3d::Zero()}}});

  const Vector3d r = r_P + rho * p, r_prime = rho_dot * p;
  const Vector3d alpha = -p, beta = p.cross(r);
  const double gamma = -(k * rho + c * rho_dot) / m - 2.0 * p.dot(kOmega.cross(r_prime)) -
                       p.dot(kOmega.cross(kOmega.cross(r)));
  const Effector printed{m,
                         r,
                         r_prime,
                         m * p * alpha.transpose(),
                         m * p * beta.transpose(),
                         -m * beta * alpha.transpose(),
                         -m * beta * beta.transpose(),
                         -m * gamma * p,
                         -m * kOmega.cross(r.cross(r_prime)) + m * gamma * beta};
  expect_equal(ours(assembly, {rho}, {rho_dot}), hub_with(printed));
}

struct PointPendulum {
  double m = 502.5, L = 0.339, drag = 17.0;
  Vector3d pivot{0.1, -0.2, -0.8};
  Vector3d p1{0.0, 0.0, -1.0}, p2{1.0, 0.0, 0.0}, p3{0.0, -1.0, 0.0};
};

/// The two hinges, made by hand: the first link has no mass, and its damper knows the second angle.
Assembly hub_and_pendulum(const PointPendulum& p) {
  Assembly assembly = hub();
  Joint phi;
  phi.r_HP_P = p.pivot;
  phi.dcm_PL0 << p.p1, p.p2, p.p3;
  phi.axis_L = Vector3d::UnitZ();
  phi.damping = p.drag * p.L * p.L;
  phi.damped_by_cosine_of = 2;
  assembly.links.push_back({"bob.phi", 0, phi, {}});
  Joint theta;
  theta.axis_L = Vector3d::UnitY();
  theta.damping = phi.damping;
  assembly.links.push_back(
      {"bob.theta", 1, theta, {{"bob", p.m, Vector3d(p.L, 0.0, 0.0), Matrix3d::Zero()}}});
  return assembly;
}

/// The spherical pendulum of the same papers, with the moment of the drag taken as l x (-D l').
Effector published_pendulum(const PointPendulum& p, double phi, double theta, double phi_dot,
                            double theta_dot) {
  const double cp = std::cos(phi), sp = std::sin(phi), ct = std::cos(theta), st = std::sin(theta);
  const double m = p.m, L = p.L;
  const Vector3d p2_turned = -sp * p.p1 + cp * p.p2;
  const Vector3d l = L * (cp * ct * p.p1 + sp * ct * p.p2 - st * p.p3);
  const Vector3d e_phi = sp * ct * p.p1 - cp * ct * p.p2;
  const Vector3d e_theta = cp * st * p.p1 + sp * st * p.p2 + ct * p.p3;
  const Vector3d l_prime = -L * (e_phi * phi_dot + e_theta * theta_dot);
  const Vector3d r = p.pivot + l;
  const Vector3d torque = l.cross(-p.drag * l_prime);
  const Vector3d centrifugal = l.cross(kOmega.cross(kOmega.cross(r)));
  const Vector3d coriolis = l.cross(kOmega.cross(l_prime));
  const double J_phi = L * L * ct * ct, J_theta = L * L;

  const Vector3d alpha_phi = -p.p3.cross(l) / J_phi, alpha_theta = -p2_turned.cross(l) / J_theta;
  const Vector3d beta_phi = p.p3.cross(l).cross(r) / J_phi;
  const Vector3d beta_theta = p2_turned.cross(l).cross(r) / J_theta;
  const double gamma_phi =
      (p.p3.dot(torque) - m * p.p3.dot(centrifugal) - 2.0 * m * p.p3.dot(coriolis) +
       2.0 * m * L * L * phi_dot * theta_dot * ct * st) /
      (m * J_phi);
  const double gamma_theta =
      (p2_turned.dot(torque) - m * p2_turned.dot(centrifugal) - 2.0 * m * p2_turned.dot(coriolis) -
       m * L * L * phi_dot * phi_dot * ct * st) /
      (m * J_theta);
  const Vector3d kappa = -(cp * ct * p.p1 + sp * ct * p.p2) * phi_dot * phi_dot +
                         (-cp * ct * p.p1 - sp * ct * p.p2 + st * p.p3) * theta_dot * theta_dot +
                         2.0 * (sp * st * p.p1 - cp * st * p.p2) * phi_dot * theta_dot -
                         e_phi * gamma_phi - e_theta * gamma_theta;
  return {
      m,
      r,
      l_prime,
      -m * L * (e_phi * alpha_phi.transpose() + e_theta * alpha_theta.transpose()),
      -m * L * (e_phi * beta_phi.transpose() + e_theta * beta_theta.transpose()),
      -m * L *
          (r.cross(e_phi) * alpha_phi.transpose() + r.cross(e_theta) * alpha_theta.transpose()),
      -m * L * (r.cross(e_phi) * beta_phi.transpose() + r.cross(e_theta) * beta_theta.transpose()),
      -m * L * kappa,
      -m * (kOmega.cross(r.cross(l_prime)) + L * r.cross(kappa))};
}

TEST(Kernel, GivesThePublishedBlocksOfASphericalPendulum) {
  const PointPendulum pendulum;
  const Assembly assembly = hub_and_pendulum(pendulum);
  for (const double phi : {0.0, 0.4, -2.0}) {
    for (const double theta : {0.0, 0.3, -1.1}) {
      expect_equal(ours(assembly, {phi, theta}, {0.7, -0.4}),
                   hub_with(published_pendulum(pendulum, phi, theta, 0.7, -0.4)));
    }
  }
}

}  // namespace
}  // namespace twincraft
