// Claims about the analytic engine: the recursion equals the dense assembly and the published
// contribution blocks, charts agree, books balance, and a step never allocates.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "runtime/bsm/attitude.h"
#include "runtime/bsm/engine.h"
#include "runtime/bsm/recursion.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/dense_oracle.h"

namespace twincraft {
namespace {

using bsm::Recursion;
using test::OracleState;

struct HeldInputs {
  std::vector<double> effort, torque;
  explicit HeldInputs(const Assembly& assembly) {
    for (std::size_t i = 1; i < assembly.links.size(); ++i) {
      effort.push_back(assembly.links[i].joint.effort.at(0.0));
    }
    for (const Rotor& rotor : assembly.rotors) torque.push_back(rotor.torque.at(0.0));
  }
};

Eigen::VectorXd recursive_accelerations(Recursion& recursion, const Assembly& assembly,
                                        const OracleState& state,
                                        const std::vector<Wrench>& wrenches) {
  const HeldInputs inputs(assembly);
  std::vector<double> q_ddot(state.q.size());
  std::vector<double> rotor_rate(state.rotor_speed.size());
  recursion.move(state.q, state.q_dot, state.omega_BN_B, state.rotor_speed);
  recursion.accelerate(state.q, state.q_dot, {inputs.effort, inputs.torque}, wrenches, q_ddot,
                       rotor_rate);
  Eigen::VectorXd all(6 + q_ddot.size() + rotor_rate.size());
  all << recursion.a_BN_B(), recursion.omega_dot_BN_B(),
      Eigen::Map<Eigen::VectorXd>(q_ddot.data(), static_cast<Eigen::Index>(q_ddot.size())),
      Eigen::Map<Eigen::VectorXd>(rotor_rate.data(), static_cast<Eigen::Index>(rotor_rate.size()));
  return all;
}

TEST(Recursion, EqualsTheDenseAssemblyOnRandomTrees) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const Assembly assembly = test::random_assembly(random, trial % 12, trial % 4);
    const OracleState state = test::random_state(random, assembly);
    Recursion recursion(assembly);
    recursion.move(state.q, state.q_dot, state.omega_BN_B, state.rotor_speed);
    std::vector<Vector3d> force_L, torque_L;
    std::vector<Wrench> wrenches;
    for (const LinkPose& pose : recursion.poses()) {
      force_L.push_back(test::random_vector(random, 1.0));
      torque_L.push_back(test::random_vector(random, 1.0));
      const Vector3d force_B = pose.dcm_WL * force_L.back();
      wrenches.push_back({force_B, pose.dcm_WL * torque_L.back() + pose.r_LB_W.cross(force_B)});
    }
    const Eigen::VectorXd dense = test::dense_accelerations(assembly, state, force_L, torque_L);
    const Eigen::VectorXd recursive = recursive_accelerations(recursion, assembly, state, wrenches);
    EXPECT_LT((dense - recursive).norm(), 1e-11 * dense.norm()) << "trial " << trial;
  }
}

/// An array of unlike segments on a skew hinge, beside a slide that carries another one.
Assembly random_arrays(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  Assembly assembly = test::random_assembly(random, 0, 1);
  const auto add_array = [&](int mount, int segments) {
    for (int i = 0; i < segments; ++i) {
      Link link;
      link.parent = i == 0 ? mount : static_cast<int>(assembly.links.size()) - 1;
      link.joint.axis_L = Vector3d::UnitY();
      link.joint.r_HP_P = i == 0 ? test::random_vector(random, 1.0)
                                 : Vector3d(uniform(random), 0.0, 0.2 * uniform(random));
      if (i == 0) {
        const Vector3d turn = test::random_vector(random, 1.0);
        link.joint.dcm_PL0 =
            Quaterniond(1.0, turn.x(), turn.y(), turn.z()).normalized().toRotationMatrix();
      }
      link.joint.stiffness = 10.0 * uniform(random);
      link.joint.damping = uniform(random);
      link.joint.effort = Schedule::constant(uniform(random));
      Matrix3d I = Vector3d(uniform(random), uniform(random), uniform(random)).asDiagonal();
      I(0, 2) = I(2, 0) = 0.1;
      link.elements = {{"s", uniform(random), Vector3d(uniform(random), 0.0, 0.1), I}};
      assembly.links.push_back(link);
    }
  };
  add_array(0, 5);
  Link slide;
  slide.parent = 0;
  slide.joint.kind = JointKind::kSlide;
  slide.joint.axis_L = Vector3d::UnitX();
  slide.elements = {{"slide", 2.0, Vector3d(0.1, 0.2, 0.3), Matrix3d::Identity()}};
  assembly.links.push_back(slide);
  add_array(static_cast<int>(assembly.links.size()) - 1, 3);
  return assembly;
}

TEST(PlanarChain, EqualsTheGeneralRecursionOnRandomArrays) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const Assembly assembly = random_arrays(random);
    const OracleState state = test::random_state(random, assembly);
    Recursion planar(assembly), general(assembly, bsm::Chains::kGeneral);
    ASSERT_EQ(planar.planar_links(), 8u);
    ASSERT_EQ(general.planar_links(), 0u);
    std::vector<Wrench> wrenches;
    for (std::size_t i = 0; i < assembly.links.size(); ++i) {
      wrenches.push_back({test::random_vector(random, 1.0), test::random_vector(random, 1.0)});
    }
    for (const std::vector<Wrench>& acting : {std::vector<Wrench>{}, wrenches}) {
      const Eigen::VectorXd a = recursive_accelerations(planar, assembly, state, acting);
      const Eigen::VectorXd b = recursive_accelerations(general, assembly, state, acting);
      EXPECT_LT((a - b).norm(), 1e-13 * b.norm()) << "trial " << trial;
    }
    for (std::size_t i = 0; i < assembly.links.size(); ++i) {
      EXPECT_LT((planar.poses()[i].r_LB_W - general.poses()[i].r_LB_W).norm(), 1e-14);
      EXPECT_LT((planar.poses()[i].dcm_WL - general.poses()[i].dcm_WL).norm(), 1e-14);
    }
  }
}

TEST(PlanarChain, ServesOnlyTailsThatAreBalancedAboutTheirPlane) {
  std::mt19937_64 random(12);
  const auto planar_links = [&random](auto change) {
    Assembly assembly = random_arrays(random);
    change(assembly.links[3]);  // the middle of the array of five; three more are on the slide
    return Recursion(assembly).planar_links();
  };
  EXPECT_EQ(planar_links([](Link&) {}), 5u + 3u);
  // The links beyond the third still are a tail of their own.
  EXPECT_EQ(planar_links([](Link& link) { link.elements[0].r_EL_L.y() = 1e-3; }), 2u + 3u);
  EXPECT_EQ(planar_links([](Link& link) {
              link.elements[0].I_PntE_L(0, 1) = link.elements[0].I_PntE_L(1, 0) = 1e-3;
            }),
            2u + 3u);
  EXPECT_EQ(
      planar_links([](Link& link) { link.joint.axis_L = Vector3d(0.0, 1.0, 1e-6).normalized(); }),
      2u + 3u);
  EXPECT_EQ(planar_links([](Link& link) { link.joint.kind = JointKind::kSlide; }), 2u + 3u);
  // Out of plane at the root of a tail is where its mount is.
  EXPECT_EQ(planar_links([](Link& link) { link.joint.r_HP_P.y() = 1e-3; }), 3u + 3u);
  // A branch on the first link: two tails on it.
  EXPECT_EQ(planar_links([](Link& link) { link.parent = 1; }), 1u + 3u + 3u);
}

TEST(BsmEngine, TakesNothingFromTheHeapInADerivative) {
  std::mt19937_64 random(13);
  Model model;
  model.assembly = random_arrays(random);
  const OracleState state = test::random_state(random, model.assembly);
  model.gravity = {3.98600436e14, GravityLaw::kBodyGradient, GravityLaw::kNone};
  model.initial.r_BN_N = {7.0e6, 0.0, 0.0};
  model.initial.joint_position = state.q;
  model.initial.joint_rate = state.q_dot;
  model.initial.rotor_speed = state.rotor_speed;
  const auto engine = make_bsm_engine(model);
  Eigen::VectorXd x = engine->initial_state(), rate(x.size());
  const std::span<double> state_span(x.data(), static_cast<std::size_t>(x.size()));
  const std::span<double> rate_span(rate.data(), static_cast<std::size_t>(rate.size()));
  const long before = test::allocation_count();
  for (int i = 0; i < 100; ++i) {
    engine->hold_inputs(i);
    engine->derivative(i, state_span, rate_span);
    engine->finish_step(state_span);
  }
  EXPECT_EQ(test::allocation_count(), before);
}

TEST(Recursion, KeepsTheHubMatrixSymmetricPositiveDefinite) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const Assembly assembly = test::random_assembly(random, 8, 2);
    const OracleState state = test::random_state(random, assembly);
    Recursion recursion(assembly);
    recursive_accelerations(recursion, assembly, state, {});
    const auto matrix = recursion.hub_equation().matrix;
    EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-13 * matrix.norm());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(matrix);
    EXPECT_GT(solver.eigenvalues()[0], 0.0);
  }
}

// A hub with one panel, in the letters of the published equations: outboard is -s1, the hinge s2.
struct Panel {
  double m = 50.0, d = 1.2, k = 150.0, c = 8.0;
  Vector3d I{30.0, 20.0, 12.0}, r_H{-0.8, 0.1, 0.2};
};

Assembly hub_and_panel(const Panel& p) {
  Assembly assembly;
  const Matrix3d I_hub = Vector3d(400.0, 380.0, 360.0).asDiagonal();
  assembly.links.push_back({"hub", -1, {}, {{"hub", 600.0, Vector3d::Zero(), I_hub}}});
  Link panel;
  panel.parent = 0;
  panel.joint.r_HP_P = p.r_H;
  panel.joint.axis_L = Vector3d::UnitY();
  panel.joint.stiffness = p.k;
  panel.joint.damping = p.c;
  panel.elements = {{"panel", p.m, Vector3d(-p.d, 0.0, 0.0), p.I.asDiagonal()}};
  assembly.links.push_back(panel);
  return assembly;
}

/// Section "hinged rigid body" of the back-substitution papers (Allard, Diaz Ramos, Schaub): the
/// whole hub equation with the effector's blocks, deep space, no hub offset.
Recursion::HubEquation published_hinge(const Panel& p, double theta, double theta_dot,
                                       const Vector3d& omega) {
  const Vector3d s1(std::cos(theta), 0.0, -std::sin(theta));
  const Vector3d s2 = Vector3d::UnitY();
  const Vector3d s3(std::sin(theta), 0.0, std::cos(theta));
  const Vector3d r_S = p.r_H - p.d * s1;
  const Vector3d r_S_prime = p.d * theta_dot * s3;
  const double J = p.I[1] + p.m * p.d * p.d;
  const Vector3d alpha = -(p.m * p.d / J) * s3;
  const Vector3d beta = -(1.0 / J) * (J * s2 + p.m * p.d * p.r_H.cross(s3));
  const double gamma =
      (1.0 / J) * (-p.k * theta - p.c * theta_dot +
                   (p.I[2] - p.I[0] + p.m * p.d * p.d) * s3.dot(omega) * s1.dot(omega) -
                   p.m * p.d * s3.dot(omega.cross(omega.cross(p.r_H))));
  const Vector3d q = p.I[1] * s2 + p.m * p.d * r_S.cross(s3);

  const double m = 600.0 + p.m;
  const Vector3d c = p.m * r_S / m;
  const Vector3d c_prime = p.m * r_S_prime / m;
  Matrix3d dcm_SB;
  dcm_SB << s1.transpose(), s2.transpose(), s3.transpose();
  const Matrix3d I = Matrix3d(Vector3d(400.0, 380.0, 360.0).asDiagonal()) +
                     dcm_SB.transpose() * p.I.asDiagonal() * dcm_SB +
                     p.m * tilde(r_S) * tilde(r_S).transpose();
  const Matrix3d I_prime =
      theta_dot * (p.I[2] - p.I[0]) * (s1 * s3.transpose() + s3 * s1.transpose()) -
      p.m * (tilde(r_S_prime) * tilde(r_S) + tilde(r_S) * tilde(r_S_prime));

  Recursion::HubEquation equation;
  equation.matrix << m * Matrix3d::Identity() + p.m * p.d * s3 * alpha.transpose(),
      -m * tilde(c) + p.m * p.d * s3 * beta.transpose(), m * tilde(c) + q * alpha.transpose(),
      I + q * beta.transpose();
  const Vector3d vT = -2.0 * m * omega.cross(c_prime) - m * omega.cross(omega.cross(c)) -
                      p.m * p.d * (theta_dot * theta_dot * s1 + gamma * s3);
  const Vector3d vR =
      -omega.cross(I * omega) - I_prime * omega -
      (theta_dot * omega.cross(q) + gamma * q + p.m * p.d * theta_dot * theta_dot * r_S.cross(s1));
  equation.right << vT, vR;
  return equation;
}

TEST(Recursion, GivesThePublishedBlocksOfAHinge) {
  const Panel panel;
  const Assembly assembly = hub_and_panel(panel);
  Recursion recursion(assembly);
  for (const double theta : {0.0, 0.3, -1.1}) {
    const OracleState state{{0.3, -0.5, 0.2}, {theta}, {0.7}, {}};
    recursive_accelerations(recursion, assembly, state, {});
    const auto ours = recursion.hub_equation();
    const auto printed = published_hinge(panel, theta, 0.7, state.omega_BN_B);
    EXPECT_LT((ours.matrix - printed.matrix).norm(), 1e-13 * printed.matrix.norm());
    EXPECT_LT((ours.right - printed.right).norm(), 1e-13 * printed.right.norm());
  }
}

TEST(Recursion, GivesThePublishedBlocksOfAWheel) {
  const Vector3d g = Vector3d(1.0, 2.0, -2.0) / 3.0;
  const double Js = 0.08, u = 0.01, Omega = 200.0;
  Assembly assembly = hub_and_panel({});
  assembly.links.pop_back();
  const Matrix3d wheel = Js * g * g.transpose() + 0.04 * (Matrix3d::Identity() - g * g.transpose());
  assembly.links[0].elements.push_back({"rw", 0.0, Vector3d::Zero(), wheel});
  assembly.rotors.push_back({"rw", 0, g, Js, Schedule::constant(u)});
  Recursion recursion(assembly);
  const OracleState state{{0.3, -0.5, 0.2}, {}, {}, {Omega}};
  const Eigen::VectorXd acceleration = recursive_accelerations(recursion, assembly, state, {});

  const Matrix3d I = Matrix3d(Vector3d(400.0, 380.0, 360.0).asDiagonal()) + wheel;
  const Matrix3d D = I - Js * g * g.transpose();
  const Vector3d& omega = state.omega_BN_B;
  const Vector3d vR = -omega.cross(I * omega) - g * u - Js * Omega * omega.cross(g);
  const auto ours = recursion.hub_equation();
  EXPECT_LT((ours.matrix.bottomRightCorner<3, 3>() - D).norm(), 1e-13 * D.norm());
  EXPECT_LT((ours.right.tail<3>() - vR).norm(), 1e-13 * vR.norm());
  EXPECT_NEAR(acceleration[6], u / Js - g.dot(acceleration.segment<3>(3)), 1e-15);
}

TEST(Charts, TurnTheSameWay) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 100; ++i) {
    const Vector3d r = test::random_vector(random, 1.0);
    const Quaterniond q = Quaterniond(r.norm() - 0.7, r.x(), r.y(), r.z()).normalized();
    const Vector3d sigma = bsm::MrpChart::from(q);
    EXPECT_LE(sigma.norm(), 1.0 + 1e-15);
    EXPECT_LT((bsm::MrpChart::dcm_NB(sigma) - q.toRotationMatrix()).norm(), 1e-14);
    EXPECT_LT((bsm::MrpChart::quaternion(sigma).toRotationMatrix() - q.toRotationMatrix()).norm(),
              1e-14);
    const Vector3d shadow = bsm::MrpChart::regular(-sigma / sigma.squaredNorm());
    EXPECT_LT((bsm::MrpChart::dcm_NB(shadow) - q.toRotationMatrix()).norm(), 1e-14);
  }
}

TEST(Charts, MoveAsTheRateSays) {
  const Vector3d omega(0.3, -0.2, 0.5);
  const Quaterniond q = Quaterniond(0.9, 0.1, -0.3, 0.2).normalized();
  const double h = 1e-6;
  const Matrix3d expected = q.toRotationMatrix() * tilde(omega);  // d(dcm_NB)/dt
  const Vector3d sigma = bsm::MrpChart::from(q);
  const Vector3d d_sigma = h * bsm::MrpChart::rate(sigma, omega);
  const Matrix3d by_mrp =
      (bsm::MrpChart::dcm_NB(sigma + d_sigma) - bsm::MrpChart::dcm_NB(sigma - d_sigma)) / (2 * h);
  EXPECT_LT((by_mrp - expected).norm(), 1e-9);
  const Eigen::Vector4d p = bsm::QuaternionChart::from(q);
  const Eigen::Vector4d d_p = h * bsm::QuaternionChart::rate(p, omega);
  const Matrix3d by_quaternion =
      (bsm::QuaternionChart::dcm_NB(p + d_p) - bsm::QuaternionChart::dcm_NB(p - d_p)) / (2 * h);
  EXPECT_LT((by_quaternion - expected).norm(), 1e-9);
}

Model random_model(std::mt19937_64& random, AttitudeChart chart) {
  Model model;
  model.assembly = test::random_assembly(random, 5, 2);
  const OracleState state = test::random_state(random, model.assembly);
  model.engines.attitude = chart;
  model.gravity = {3.98600436e14, GravityLaw::kBodyGradient, GravityLaw::kNone};
  model.initial.r_BN_N = {7.0e6, 1.0e5, -2.0e5};
  model.initial.v_BN_N = {10.0, 7500.0, 30.0};
  model.initial.q_BN = Quaterniond(0.5, 0.5, -0.5, 0.5);
  model.initial.omega_BN_B = state.omega_BN_B;
  model.initial.joint_position = state.q;
  model.initial.joint_rate = state.q_dot;
  model.initial.rotor_speed = state.rotor_speed;
  Load load{"push", 2, {}, {}, Vector3d(0.1, 0.2, 0.3)};
  load.force_L[1] = Schedule::constant(3.0);
  load.torque_L[2] = Schedule::constant(-2.0);
  model.loads = {load};
  return model;
}

/// The books' rates by central differences along the motion against what the outside does.
TEST(Books, ChangeByWhatTheOutsideDoes) {
  std::mt19937_64 random(6);
  for (const AttitudeChart chart : {AttitudeChart::kMrp, AttitudeChart::kQuaternion}) {
    const auto engine = make_bsm_engine(random_model(random, chart));
    const Eigen::VectorXd x = engine->initial_state();
    Eigen::VectorXd rate(x.size());
    const auto span = [](Eigen::VectorXd& v) {
      return std::span<double>(v.data(), static_cast<std::size_t>(v.size()));
    };
    Eigen::VectorXd at = x;
    engine->derivative(0.0, span(at), span(rate));
    const ExternalRates outside = engine->external_rates(0.0, span(at));
    const double h = 1e-4;
    Eigen::VectorXd ahead = x + h * rate, behind = x - h * rate;
    const Observation a = engine->observe(h, span(ahead));
    const Observation b = engine->observe(-h, span(behind));
    const Observation o = engine->observe(0.0, span(at));
    // Central differences of quantities of size kinetic, H_scale: rounding / h and h^2.
    EXPECT_LT(((a.H_PntC_N - b.H_PntC_N) / (2 * h) - outside.torque_PntC_N).norm(),
              1e-6 * o.H_scale);
    EXPECT_LT(((a.momentum - b.momentum) / (2 * h) - outside.force_N).norm(),
              1e-5 * outside.force_N.norm());
    const double energy_rate = (a.kinetic + a.potential - b.kinetic - b.potential) / (2 * h);
    EXPECT_NEAR(energy_rate, outside.power, 1e-11 * o.kinetic / h);
  }
}

TEST(BsmEngine, GivesTheKineticEnergyOfItsMassMatrix) {
  std::mt19937_64 random(8);
  const Model model = random_model(random, AttitudeChart::kQuaternion);
  const auto engine = make_bsm_engine(model);
  Eigen::VectorXd x = engine->initial_state();
  const std::span<const double> state(x.data(), static_cast<std::size_t>(x.size()));
  const Eigen::MatrixXd M = engine->mass_matrix(state);
  Eigen::VectorXd u(model.degrees_of_freedom());
  const StateLayout& at = engine->layout();
  u << x.segment<3>(StateLayout::velocity()), x.segment<3>(at.rate()),
      x.segment(at.joint_rate(), at.joints), x.segment(at.wheel(), at.wheels);
  EXPECT_NEAR(0.5 * u.dot(M * u), engine->observe(0.0, state).kinetic,
              1e-13 * engine->observe(0.0, state).kinetic);
}

}  // namespace
}  // namespace twincraft
