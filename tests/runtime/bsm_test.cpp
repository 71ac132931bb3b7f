// Claims about the analytic engine: the recursion equals the dense assembly and the published
// contribution blocks, charts agree, books balance, and a step never allocates.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "runtime/bsm/charts.h"
#include "runtime/bsm/engine.h"
#include "runtime/bsm/motion.h"
#include "runtime/engine/attitude.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/kernel_of.h"

namespace twincraft {
namespace {

using test::HubEquation;
using test::inputs_of;
using test::KernelOf;
using test::OracleState;

constexpr double kMu = 3.98600436e14;  // [m^3/s^2]

/// Random forces and torques on every link, in its axes and about its origin.
bsm::HeldInputs pushed(const Assembly& assembly, std::mt19937_64& random) {
  bsm::HeldInputs held = inputs_of(assembly);
  for (Vector3d& force : held.force_L) force = test::random_vector(random, 1.0);
  for (Vector3d& torque : held.torque_L) torque = test::random_vector(random, 1.0);
  return held;
}

TEST(Kernel, EqualsTheDenseAssemblyOnRandomTrees) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const Assembly assembly = test::random_assembly(random, trial % 12, trial % 4);
    const OracleState state = test::random_state(random, assembly);
    const bsm::HeldInputs held = pushed(assembly, random);
    const Eigen::VectorXd dense =
        test::dense_accelerations(assembly, state, held.force_L, held.torque_L);
    KernelOf kernel(assembly, ChainPath::kGeneral);
    EXPECT_LT((dense - kernel.accelerations(state, held)).norm(), 1e-11 * dense.norm())
        << "trial " << trial;
  }
}

/// The same limbs twice, of other masses, springs and places: they share lanes.
Assembly with_twins(Assembly assembly, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  const int links = static_cast<int>(assembly.links.size());
  const std::vector<Rotor> rotors = assembly.rotors;
  for (int i = 1; i < links; ++i) {
    Link twin = assembly.links[static_cast<std::size_t>(i)];
    if (twin.parent > 0) {
      twin.parent += links - 1;
    } else {
      twin.joint.r_HP_P += test::random_vector(random, 0.5);
    }
    twin.joint.stiffness *= uniform(random);
    twin.joint.effort = Schedule::constant(uniform(random));
    for (MassElement& element : twin.elements) {
      const double scale = uniform(random);
      element.mass *= scale;
      element.I_PntE_L *= scale;
    }
    assembly.links.push_back(twin);
  }
  for (Rotor rotor : rotors) {
    if (rotor.link > 0) rotor.link += links - 1;
    assembly.rotors.push_back(rotor);
  }
  return assembly;
}

TEST(Kernel, EqualsTheDenseAssemblyOnTwinLimbs) {
  std::mt19937_64 random(23);
  for (int trial = 0; trial < 200; ++trial) {
    const Assembly assembly =
        with_twins(test::random_assembly(random, 1 + trial % 8, trial % 3), random);
    const OracleState state = test::random_state(random, assembly);
    const bsm::HeldInputs held = pushed(assembly, random);
    const Eigen::VectorXd dense =
        test::dense_accelerations(assembly, state, held.force_L, held.torque_L);
    KernelOf kernel(assembly, ChainPath::kGeneral);
    EXPECT_LT((dense - kernel.accelerations(state, held)).norm(), 1e-11 * dense.norm())
        << "trial " << trial;
  }
}

/// Exact along coordinate axes, or the zeros of most vehicles would become rounding errors.
TEST(Tree, TurnsLinksToWhereTheThirdAxisIsTheJoints) {
  std::mt19937_64 random(37);
  Assembly assembly = test::random_assembly(random, 1, 0);
  const auto dcm_KL_about = [&assembly](const Vector3d& axis) {
    assembly.links[1].joint.axis_L = axis;
    return bsm::prepare(assembly).links[1].dcm_KL;
  };
  for (int i = 0; i < 3; ++i) {
    for (const double sign : {1.0, -1.0}) {
      const Vector3d axis = sign * Vector3d::Unit(i);
      const Matrix3d dcm_KL = dcm_KL_about(axis);
      EXPECT_EQ(Vector3d(dcm_KL * axis), Vector3d::UnitZ());
      EXPECT_EQ(Matrix3d(dcm_KL * dcm_KL.transpose()), Matrix3d::Identity());
      EXPECT_EQ(dcm_KL.determinant(), 1.0);
    }
  }
  const Vector3d axis = Vector3d(0.3, -0.5, 0.2).normalized();
  const Matrix3d dcm_KL = dcm_KL_about(axis);
  EXPECT_LT((dcm_KL * axis - Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((dcm_KL * dcm_KL.transpose() - Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_NEAR(dcm_KL.determinant(), 1.0, 1e-15);
}

/// The force room's wrenches through the dense assembly, against the kernel's own gravity.
TEST(Kernel, FeelsTheGravityOfTheForceRoom) {
  std::mt19937_64 random(29);
  for (const GravityLaw law :
       {GravityLaw::kSystemCom, GravityLaw::kBodyCom, GravityLaw::kBodyGradient}) {
    for (int trial = 0; trial < 50; ++trial) {
      Model model;
      model.assembly = with_twins(test::random_assembly(random, 1 + trial % 5, 1), random);
      // A field steep enough to be felt over a metre.
      model.gravity = {1.0e4, law, GravityLaw::kNone};
      const OracleState state = test::random_state(random, model.assembly);
      const Vector3d r_BN(30.0, -40.0, 20.0);
      const bsm::Tree tree = bsm::prepare(model.assembly);
      const bsm::Motion motion = bsm::motion_of(tree, state.q, state.q_dot, state.omega_BN_B);
      std::vector<std::vector<MassElement>> elements;
      for (const Link& link : model.assembly.links) elements.push_back(link.elements);
      const ForceModel forces(model, law, elements, FieldFrame::kFalling);
      std::vector<Wrench> wrenches(motion.poses.size());
      forces.apply(r_BN, motion.poses, {}, wrenches);
      const Vector3d g = forces.fall(r_BN, Matrix3d::Identity(), motion.poses);
      std::vector<Vector3d> force_L, torque_L;
      for (std::size_t i = 0; i < wrenches.size(); ++i) {
        const auto& [dcm, r_LB] = motion.poses[i];
        const Wrench& w = wrenches[i];
        force_L.push_back(dcm.transpose() * w.force_W);
        torque_L.push_back(dcm.transpose() * (w.torque_PntB_W - r_LB.cross(w.force_W)));
      }
      Eigen::VectorXd dense = test::dense_accelerations(model.assembly, state, force_L, torque_L);
      dense.head<3>() += g;
      KernelOf kernel(model.assembly, ChainPath::kPlanar, model.gravity);
      const Eigen::VectorXd ours = kernel.accelerations(state, inputs_of(model.assembly), r_BN);
      EXPECT_LT((dense - ours).norm(), 1e-11 * dense.norm()) << "trial " << trial;
    }
  }
}

/// A force that follows the centre of mass is one at the place where that is now.
TEST(Kernel, PutsAForceAtTheCenterOfMass) {
  std::mt19937_64 random(31);
  for (int trial = 0; trial < 50; ++trial) {
    const Assembly assembly = with_twins(test::random_assembly(random, 4, 1), random);
    const OracleState state = test::random_state(random, assembly);
    const bsm::Motion motion =
        bsm::motion_of(bsm::prepare(assembly), state.q, state.q_dot, state.omega_BN_B);
    double mass = 0.0;
    Vector3d moment = Vector3d::Zero();
    for (std::size_t i = 0; i < assembly.links.size(); ++i) {
      const auto& [dcm, r_LB] = motion.poses[i];
      for (const MassElement& e : assembly.links[i].elements) {
        mass += e.mass;
        moment += e.mass * (r_LB + dcm * e.r_EL_L);
      }
    }
    const std::size_t link = static_cast<std::size_t>(trial) % assembly.links.size();
    const auto& [dcm, r_LB] = motion.poses[link];
    bsm::HeldInputs at_center = inputs_of(assembly), fixed = inputs_of(assembly);
    const Vector3d force_L = test::random_vector(random, 10.0);
    at_center.force_at_center_L[link] = force_L;
    at_center.acts_at_center = true;
    fixed.force_L[link] = force_L;
    fixed.torque_L[link] = Vector3d(dcm.transpose() * (moment / mass - r_LB)).cross(force_L);
    KernelOf kernel(assembly);
    const Eigen::VectorXd expected = kernel.accelerations(state, fixed);
    EXPECT_LT((kernel.accelerations(state, at_center) - expected).norm(), 1e-12 * expected.norm());
  }
}

/// Whether hinges and centres of mass of an array lie on one line, its principal axis.
enum class Shape { kBent, kStraight };

/// An array of unlike segments on a skew hinge, beside a slide that carries another one.
Assembly random_arrays(std::mt19937_64& random, int segments_on_hub = 5,
                       Shape shape = Shape::kBent) {
  const double off_line = shape == Shape::kBent ? 0.1 : 0.0;
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  Assembly assembly = test::random_assembly(random, 0, 1);
  const auto add_array = [&](int mount, int segments) {
    for (int i = 0; i < segments; ++i) {
      Link link;
      link.parent = i == 0 ? mount : static_cast<int>(assembly.links.size()) - 1;
      link.joint.axis_L = Vector3d::UnitY();
      link.joint.r_HP_P = i == 0 ? test::random_vector(random, 1.0)
                                 : Vector3d(uniform(random), 0.0, 2.0 * off_line * uniform(random));
      if (i == 0) {
        const Vector3d turn = test::random_vector(random, 1.0);
        link.joint.dcm_PL0 =
            Quaterniond(1.0, turn.x(), turn.y(), turn.z()).normalized().toRotationMatrix();
      }
      link.joint.stiffness = 10.0 * uniform(random);
      link.joint.damping = uniform(random);
      link.joint.effort = Schedule::constant(uniform(random));
      Matrix3d I = Vector3d(uniform(random), uniform(random), uniform(random)).asDiagonal();
      I(0, 2) = I(2, 0) = off_line;
      link.elements = {{"s", uniform(random), Vector3d(uniform(random), 0.0, off_line), I}};
      assembly.links.push_back(link);
    }
  };
  add_array(0, segments_on_hub);
  Link slide;
  slide.parent = 0;
  slide.joint.kind = JointKind::kSlide;
  slide.joint.axis_L = Vector3d::UnitX();
  slide.elements = {{"slide", 2.0, Vector3d(0.1, 0.2, 0.3), Matrix3d::Identity()}};
  assembly.links.push_back(slide);
  add_array(static_cast<int>(assembly.links.size()) - 1, 3);
  return assembly;
}

TEST(Chain, EqualsTheGeneralRecursionOnRandomArrays) {
  std::mt19937_64 random(11);
  // Near enough that every link feels another field.
  const Gravity near{1.0e4, GravityLaw::kBodyCom, GravityLaw::kNone};
  for (const Gravity& gravity : {Gravity{}, near}) {
    for (int trial = 0; trial < 400; ++trial) {
      const Shape shape = trial < 200 ? Shape::kBent : Shape::kStraight;
      const Assembly alone = random_arrays(random, 5, shape);
      const Assembly assembly = trial % 2 == 0 ? alone : with_twins(alone, random);
      const OracleState state = test::random_state(random, assembly);
      KernelOf planar(assembly, ChainPath::kPlanar, gravity);
      KernelOf general(assembly, ChainPath::kGeneral, gravity);
      ASSERT_EQ(planar.plan().planar_links(), trial % 2 == 0 ? 8u : 16u);
      ASSERT_EQ(general.plan().planar_links(), 0u);
      const bsm::HeldInputs held = inputs_of(assembly);
      const Vector3d r_BN(30.0, -40.0, 20.0);
      const Eigen::VectorXd a = planar.accelerations(state, held, r_BN);
      const Eigen::VectorXd b = general.accelerations(state, held, r_BN);
      EXPECT_LT((a - b).norm(), 1e-13 * b.norm()) << "trial " << trial;
    }
  }
}

TEST(Chain, OfAnyLengthHasUnlikeLinksAndEqualsTheGeneralRecursion) {
  std::mt19937_64 random(14);
  for (const int segments : {1, 2, 3, 4, 7, 8, 15, 16, 32, 64}) {
    for (const Shape shape : {Shape::kBent, Shape::kStraight}) {
      const Assembly assembly = random_arrays(random, segments, shape);
      const OracleState state = test::random_state(random, assembly);
      const bsm::HeldInputs held = inputs_of(assembly);
      for (const bsm::InstructionSet set : bsm::instruction_sets()) {
        KernelOf planar(assembly, ChainPath::kPlanar, {}, set);
        KernelOf general(assembly, ChainPath::kGeneral, {}, set);
        ASSERT_EQ(planar.plan().planar_links(), static_cast<std::size_t>(segments) + 3u);
        const Eigen::VectorXd a = planar.accelerations(state, held);
        const Eigen::VectorXd b = general.accelerations(state, held);
        EXPECT_LT((a - b).norm(), 1e-12 * b.norm()) << segments << ", " << bsm::name_of(set);
      }
    }
  }
}

TEST(Chain, IsStraightIfEveryLinkIs) {
  std::mt19937_64 random(15);
  const auto is_straight = [&random](auto change) {
    Assembly assembly = random_arrays(random, 5, Shape::kStraight);
    change(assembly.links[3].elements[0], assembly.links[4].joint);  // the third of the array
    const KernelOf kernel(assembly);
    EXPECT_EQ(kernel.plan().limbs.size(), 2u);
    EXPECT_TRUE(kernel.plan().limbs[1].chains[0].is_straight) << "that on the slide";
    return kernel.plan().limbs[0].chains[0].is_straight;
  };
  EXPECT_TRUE(is_straight([](MassElement&, Joint&) {}));
  // Against the line is on it.
  EXPECT_TRUE(is_straight([](MassElement& e, Joint& next) {
    e.r_EL_L.x() *= -1.0;
    next.r_HP_P.x() *= -1.0;
  }));
  EXPECT_FALSE(is_straight([](MassElement& e, Joint&) { e.r_EL_L.z() = 1e-6; }));
  EXPECT_FALSE(is_straight([](MassElement&, Joint& next) { next.r_HP_P.z() = 1e-6; }));
  EXPECT_FALSE(
      is_straight([](MassElement& e, Joint&) { e.I_PntE_L(0, 2) = e.I_PntE_L(2, 0) = 1e-6; }));
  // A link that is turned at angle zero bends the line.
  EXPECT_FALSE(is_straight([](MassElement&, Joint& next) {
    next.dcm_PL0 = Eigen::AngleAxisd(0.1, Vector3d::UnitY()).toRotationMatrix();
  }));
}

TEST(Chain, HasTheFirstMomentsOfAStraightOneAsParticlesAtHinges) {
  std::mt19937_64 random(16);
  Assembly assembly = random_arrays(random, 5, Shape::kStraight);
  const auto mass_of = [](const bsm::ChainPlan& chain) {
    double mass = 0.0;
    for (const bsm::PlanarLinkPlan& link : chain.links) mass += link.mass;
    return mass;
  };
  const KernelOf straight(assembly);
  const bsm::ChainPlan& chain = straight.plan().limbs[0].chains[0];
  ASSERT_TRUE(chain.is_straight);
  for (const bsm::PlanarLinkPlan& link : chain.links)
    EXPECT_EQ(link.first_moment[0] == 0.0, &link != &chain.links.back());

  // But for a link whose centre of mass is too far beyond the next hinge.
  assembly.links[4].joint.r_HP_P *= 1e-3;
  const KernelOf far(assembly);
  const bsm::ChainPlan& as_it_is = far.plan().limbs[0].chains[0];
  EXPECT_FALSE(as_it_is.is_straight);
  for (const bsm::PlanarLinkPlan& link : as_it_is.links) EXPECT_NE(link.first_moment[0], 0.0);
  EXPECT_NEAR(mass_of(chain), mass_of(as_it_is), 1e-14 * mass_of(as_it_is));
}

TEST(Chain, ServesOnlyTailsThatAreBalancedAboutTheirPlane) {
  std::mt19937_64 random(12);
  const auto planar_links = [&random](auto change) {
    Assembly assembly = random_arrays(random);
    change(assembly.links[3]);  // the middle of the array of five; three more are on the slide
    return KernelOf(assembly).plan().planar_links();
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

/// A point mass at the end of two crossed hinges, in any attitude.
void add_bob(std::mt19937_64& random, Assembly& assembly) {
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  const auto hinge_about = [&](const Vector3d& axis) {
    Joint hinge;
    hinge.axis_L = axis;
    hinge.stiffness = 10.0 * uniform(random);
    hinge.damping = uniform(random);
    hinge.rest = 0.1 * uniform(random);
    hinge.effort = Schedule::constant(uniform(random));
    return hinge;
  };
  const int phi = static_cast<int>(assembly.links.size());
  Link inner{"phi", 0, hinge_about(Vector3d::UnitZ()), {}},
      outer{"bob", phi, hinge_about(Vector3d::UnitY()), {}};
  const Vector3d turn = test::random_vector(random, 1.0);
  inner.joint.dcm_PL0 =
      Quaterniond(1.0, turn.x(), turn.y(), turn.z()).normalized().toRotationMatrix();
  inner.joint.r_HP_P = test::random_vector(random, 1.0);
  inner.joint.damped_by_cosine_of = phi + 1;
  outer.elements = {
      {"bob", uniform(random), Vector3d(uniform(random), 0.0, 0.0), Matrix3d::Zero()}};
  assembly.links.push_back(inner);
  assembly.links.push_back(outer);
}

std::size_t bobs_in(const bsm::Plan& plan) {
  return static_cast<std::size_t>(
      std::ranges::count(plan.limbs, bsm::LimbKind::kBob, &bsm::LimbPlan::kind));
}

TEST(Bob, EqualsTheGeneralRecursion) {
  std::mt19937_64 random(37);
  const Gravity near{1.0e4, GravityLaw::kBodyCom, GravityLaw::kNone};
  for (const Gravity& gravity : {Gravity{}, near}) {
    for (std::size_t bobs = 1; bobs <= 3; ++bobs) {  // the last of three has a lane beside it idle
      for (const bsm::InstructionSet set : bsm::instruction_sets()) {
        Assembly assembly = test::random_assembly(random, 2, 1);
        for (std::size_t k = 0; k < bobs; ++k) add_bob(random, assembly);
        const OracleState state = test::random_state(random, assembly);
        KernelOf written_out(assembly, ChainPath::kPlanar, gravity, set);
        KernelOf general(assembly, ChainPath::kGeneral, gravity, set);
        ASSERT_EQ(bobs_in(written_out.plan()), bobs);
        ASSERT_EQ(bobs_in(general.plan()), 0u);
        const bsm::HeldInputs held = inputs_of(assembly);
        const Vector3d r_BN(30.0, -40.0, 20.0);
        const Eigen::VectorXd a = written_out.accelerations(state, held, r_BN);
        const Eigen::VectorXd b = general.accelerations(state, held, r_BN);
        EXPECT_LT((a - b).norm(), 1e-12 * b.norm()) << bobs << ", " << bsm::name_of(set);
      }
    }
  }
}

TEST(Bob, IsAPointOnCrossedHingesThatNothingActsOn) {
  std::mt19937_64 random(41);
  const auto bobs = [&random](auto change, const std::vector<Load>& loads = {}) {
    Assembly assembly = test::random_assembly(random, 0, 0);
    add_bob(random, assembly);
    change(assembly.links[1], assembly.links[2]);
    return bobs_in(bsm::make_plan(assembly, AttitudeChart::kMrp, {}, loads));
  };
  const auto as_it_is = [](Link&, Link&) {};
  EXPECT_EQ(bobs(as_it_is), 1u);
  for (const int link : {1, 2}) EXPECT_EQ(bobs(as_it_is, {{"push", link, {}, {}, {}}}), 0u);
  EXPECT_EQ(bobs([](Link&, Link& bob) { bob.elements[0].I_PntE_L(1, 1) = 1e-3; }), 0u);
  EXPECT_EQ(bobs([](Link&, Link& bob) { bob.elements[0].r_EL_L.y() = 1e-6; }), 0u);
  EXPECT_EQ(bobs([](Link&, Link& bob) { bob.elements[0].r_EL_L.z() = 1e-6; }), 0u);
  EXPECT_EQ(bobs([](Link&, Link& bob) { bob.elements[0].r_EL_L.setZero(); }), 0u);
  EXPECT_EQ(bobs([](Link&, Link& bob) { bob.joint.r_HP_P.x() = 1e-6; }), 0u);
  EXPECT_EQ(bobs([](Link&, Link& bob) { bob.joint.kind = JointKind::kSlide; }), 0u);
  EXPECT_EQ(
      bobs([](Link&, Link& bob) { bob.joint.axis_L = Vector3d(0.0, 1.0, 1e-6).normalized(); }), 0u);
  EXPECT_EQ(bobs([](Link& phi, Link&) { phi.joint.damped_by_cosine_of = -1; }), 0u);
  EXPECT_EQ(bobs([](Link& phi, Link& bob) { phi.elements = bob.elements; }), 0u);
}

TEST(BsmEngine, TakesNothingFromTheHeapInADerivative) {
  std::mt19937_64 random(13);
  Model model;
  model.assembly = random_arrays(random);
  const OracleState state = test::random_state(random, model.assembly);
  model.gravity = {kMu, GravityLaw::kBodyGradient, GravityLaw::kNone};
  model.initial.r_BN_N = {7.0e6, 0.0, 0.0};
  model.initial.joint_position = state.q;
  model.initial.joint_rate = state.q_dot;
  model.initial.wheel_rate = state.rotor_speed;
  const auto engine = make_bsm_engine(model);
  Eigen::VectorXd x = engine->initial_state(), rate(x.size());
  const std::span<double> state_span(x.data(), static_cast<std::size_t>(x.size()));
  const std::span<double> rate_span(rate.data(), static_cast<std::size_t>(rate.size()));
  InputFeed feed(model);
  const long before = test::allocation_count();
  for (int i = 0; i < 100; ++i) {
    engine->hold(feed.begin(i));
    engine->derivative(i, state_span, rate_span);
    engine->finish_step(state_span);
  }
  EXPECT_EQ(test::allocation_count(), before);
}

TEST(Kernel, KeepsTheHubMatrixSymmetricPositiveDefinite) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const Assembly assembly = test::random_assembly(random, 8, 2);
    KernelOf kernel(assembly);
    kernel.accelerations(test::random_state(random, assembly), inputs_of(assembly));
    const auto matrix = kernel.hub_equation().matrix;
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
HubEquation published_hinge(const Panel& p, double theta, double theta_dot, const Vector3d& omega) {
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

  HubEquation equation;
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

TEST(Kernel, GivesThePublishedBlocksOfAHinge) {
  const Panel panel;
  const Assembly assembly = hub_and_panel(panel);
  KernelOf kernel(assembly);
  for (const double theta : {0.0, 0.3, -1.1}) {
    const OracleState state{{0.3, -0.5, 0.2}, {theta}, {0.7}, {}};
    kernel.accelerations(state, inputs_of(assembly));
    const auto ours = kernel.hub_equation();
    const auto printed = published_hinge(panel, theta, 0.7, state.omega_BN_B);
    EXPECT_LT((ours.matrix - printed.matrix).norm(), 1e-13 * printed.matrix.norm());
    EXPECT_LT((ours.right - printed.right).norm(), 1e-13 * printed.right.norm());
  }
}

TEST(Kernel, GivesThePublishedBlocksOfAWheel) {
  const Vector3d g = Vector3d(1.0, 2.0, -2.0) / 3.0;
  const double Js = 0.08, u = 0.01, Omega = 200.0;
  Assembly assembly = hub_and_panel({});
  assembly.links.pop_back();
  const Matrix3d wheel = Js * g * g.transpose() + 0.04 * (Matrix3d::Identity() - g * g.transpose());
  assembly.links[0].elements.push_back({"rw", 0.0, Vector3d::Zero(), wheel});
  assembly.rotors.push_back({"rw", 0, g, Js, Schedule::constant(u)});
  KernelOf kernel(assembly);
  const OracleState state{{0.3, -0.5, 0.2}, {}, {}, {Omega}};
  const Eigen::VectorXd acceleration = kernel.accelerations(state, inputs_of(assembly));

  const Matrix3d I = Matrix3d(Vector3d(400.0, 380.0, 360.0).asDiagonal()) + wheel;
  const Matrix3d D = I - Js * g * g.transpose();
  const Vector3d& omega = state.omega_BN_B;
  const Vector3d vR = -omega.cross(I * omega) - g * u - Js * Omega * omega.cross(g);
  const auto ours = kernel.hub_equation();
  EXPECT_LT((ours.matrix.bottomRightCorner<3, 3>() - D).norm(), 1e-13 * D.norm());
  EXPECT_LT((ours.right.tail<3>() - vR).norm(), 1e-13 * vR.norm());
  EXPECT_NEAR(acceleration[6], u / Js - g.dot(acceleration.segment<3>(3)), 1e-15);
}

/// The chart at these numbers.
template <class Chart, class Numbers>
Chart chart_at(const Numbers& numbers) {
  return Chart(numbers.data(), 0);
}
using Mrp = bsm::portable::Mrp<double>;
using Quaternion = bsm::portable::Quaternion<double>;

Eigen::Vector4d numbers_of(const Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

template <class Chart, class Numbers>
Matrix3d dcm_at(const Numbers& numbers) {
  const auto dcm = chart_at<Chart>(numbers).dcm_NB();
  Matrix3d result;
  result << dcm.x.x, dcm.y.x, dcm.z.x, dcm.x.y, dcm.y.y, dcm.z.y, dcm.x.z, dcm.y.z, dcm.z.z;
  return result;
}

TEST(Charts, TurnTheSameWay) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 100; ++i) {
    const Vector3d r = test::random_vector(random, 1.0);
    const Quaterniond q = Quaterniond(r.norm() - 0.7, r.x(), r.y(), r.z()).normalized();
    const Matrix3d expected = q.toRotationMatrix();
    const Vector3d sigma = mrp_from(q);
    EXPECT_LE(sigma.norm(), 1.0 + 1e-15);
    EXPECT_LT((dcm_at<Mrp>(sigma) - expected).norm(), 1e-14);
    EXPECT_LT((quaternion_from(sigma).toRotationMatrix() - expected).norm(), 1e-14);
    Vector3d outside = -sigma / sigma.squaredNorm();
    Mrp shadow = chart_at<Mrp>(outside);
    shadow.make_regular();
    shadow.put(outside.data(), 0);
    EXPECT_LE(outside.norm(), 1.0 + 1e-15);
    EXPECT_LT((dcm_at<Mrp>(outside) - expected).norm(), 1e-14);
    // Off the unit sphere it is read as if on it, and regular() brings it back.
    Eigen::Vector4d scaled = 1.1 * numbers_of(q);
    EXPECT_LT((dcm_at<Quaternion>(scaled) - expected).norm(), 1e-14);
    Quaternion regular = chart_at<Quaternion>(scaled);
    regular.make_regular();
    regular.put(scaled.data(), 0);
    EXPECT_NEAR(scaled.norm(), 1.0, 1e-15);
  }
}

/// d(dcm)/dt along the chart's own rate, by central differences.
template <class Chart, class Numbers>
Matrix3d dcm_rate(const Numbers& numbers, const Vector3d& omega, double h) {
  Numbers rate;
  chart_at<Chart>(numbers).put_rate({omega.x(), omega.y(), omega.z()}, rate.data(), 0);
  const Numbers ahead = numbers + h * rate, behind = numbers - h * rate;
  return (dcm_at<Chart>(ahead) - dcm_at<Chart>(behind)) / (2 * h);
}

TEST(Charts, MoveAsTheRateSays) {
  const Vector3d omega(0.3, -0.2, 0.5);
  const Quaterniond q = Quaterniond(0.9, 0.1, -0.3, 0.2).normalized();
  const Matrix3d expected = q.toRotationMatrix() * tilde(omega);
  EXPECT_LT((dcm_rate<Mrp>(mrp_from(q), omega, 1e-6) - expected).norm(), 1e-9);
  EXPECT_LT((dcm_rate<Quaternion>(numbers_of(q), omega, 1e-6) - expected).norm(), 1e-9);
}

Model random_model(std::mt19937_64& random, AttitudeChart chart) {
  Model model;
  model.assembly = test::random_assembly(random, 5, 2);
  const OracleState state = test::random_state(random, model.assembly);
  model.engines.attitude = chart;
  model.gravity = {kMu, GravityLaw::kBodyGradient, GravityLaw::kNone};
  model.initial.r_BN_N = {7.0e6, 1.0e5, -2.0e5};
  model.initial.v_BN_N = {10.0, 7500.0, 30.0};
  model.initial.q_BN = Quaterniond(0.5, 0.5, -0.5, 0.5);
  model.initial.omega_BN_B = state.omega_BN_B;
  model.initial.joint_position = state.q;
  model.initial.joint_rate = state.q_dot;
  model.initial.wheel_rate = state.rotor_speed;
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
    BookRates outside;
    engine->derivative(0.0, span(at), span(rate), &outside);
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
