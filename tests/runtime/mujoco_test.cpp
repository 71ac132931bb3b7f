// Claims about the MuJoCo engine: it is MuJoCo's own forward dynamics, in a frame that does not
// care how fast the vehicle flies, with forces, books and failures told truthfully.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>

#include "compiler/components/model_builder.h"
#include "compiler/emit/mjcf.h"
#include "runtime/mujoco/engine.h"
#include "runtime/mujoco/handles.h"
#include "runtime/mujoco/tree_map.h"
#include "runtime/mujoco/wrenches.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/asked.h"
#include "tests/support/dense_oracle.h"
#include "tests/support/sample_models.h"

namespace twincraft {
namespace {

using Eigen::VectorXd;
using test::span_of;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::unique_ptr<Engine> engine_of(const Model& model) {
  return make_mujoco_engine(model, emit_mjcf(model));
}

VectorXd derivative(Engine& engine, const VectorXd& state, double time = 0.0) {
  return test::derivative_at(engine, time, state);
}

double relative_difference(const VectorXd& a, const VectorXd& b) {
  return (a - b).norm() / b.norm();
}

std::vector<Model> samples() {
  return {test::offset_hub(), test::wheels_and_panels(), test::two_chains(4), test::menagerie()};
}

Model without_loads(Model model) {
  model.loads.clear();
  return model;
}

// Small enough a planet that neither its pull nor its gradient drowns the rest.
Model beside_an_asteroid(Model model, GravityLaw law) {
  model.gravity = {50.0, law, law};
  model.initial.r_BN_N = Vector3d(20.0, -15.0, 10.0);
  return model;
}

VectorXd near_asteroid(const Model& model, unsigned seed) {
  VectorXd state = test::sample_state(model, seed);
  state.head<6>() << 20.0, -15.0, 10.0, 0.5, 0.7, -0.4;
  return state;
}

/// MuJoCo itself at a state of ours: the loaded model with its data filled in.
struct Bare {
  Bare(const Model& model, const VectorXd& state)
      : m(load_mjcf(emit_mjcf(model))), map(map_tree(model, *m)) {
    restore_exact_masses(model.tree, *m);
    d = make_data(*m);
    const StateLayout layout{.chart = AttitudeChart::kQuaternion,
                             .joints = static_cast<int>(map.joint_dof.size()),
                             .wheels = static_cast<int>(map.wheel_dof.size())};
    std::copy_n(state.data(), 3, d->qpos);
    std::copy_n(state.data() + 3, 3, d->qvel);
    std::copy_n(state.data() + 6, 4, d->qpos + 3);
    std::copy_n(state.data() + 10, 3, d->qvel + 3);
    for (std::size_t i = 0; i < map.joint_dof.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      d->qpos[map.joint_qpos[i]] = state[layout.joint() + k];
      d->qvel[map.joint_dof[i]] = state[layout.joint_rate() + k];
      d->qfrc_applied[map.joint_dof[i]] = model.assembly.links[i + 1].joint.effort.at(0.0);
    }
    for (std::size_t i = 0; i < map.wheel_dof.size(); ++i) {
      d->qvel[map.wheel_dof[i]] = state[layout.wheel() + static_cast<Eigen::Index>(i)];
      d->qfrc_applied[map.wheel_dof[i]] = model.assembly.rotors[i].torque.at(0.0);
    }
  }
  /// (v_B in N, omega, joints, wheels), as mj_forward has it.
  VectorXd accelerations() {
    mj_forward(m.get(), d.get());
    VectorXd all(m->nv);
    all.head<6>() = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(d->qacc);
    Eigen::Index next = 6;
    for (const int dof : map.joint_dof) all[next++] = d->qacc[dof];
    for (const int dof : map.wheel_dof) all[next++] = d->qacc[dof];
    return all;
  }

  MujocoModel m;
  MujocoData d;
  TreeMap map;
};

/// (v_B in N, omega, joints, wheels) of a state; of a rate, the accelerations.
VectorXd velocity_part(const StateLayout& layout, const VectorXd& state) {
  VectorXd part(6 + layout.joints + layout.wheels);
  part << state.segment<3>(3), state.segment<3>(layout.rate()),
      state.segment(layout.joint_rate(), layout.joints), state.tail(layout.wheels);
  return part;
}

// The co-moving frame hands the hub over at rest at zero with its axes along the world's.
TEST(MujocoEngine, IsMujocosOwnForwardDynamicsBitForBit) {
  for (const Model& sample : samples()) {
    const Model model = without_loads(sample);
    const auto engine = engine_of(model);
    for (unsigned seed = 0; seed < 20; ++seed) {
      const VectorXd state = test::sample_state(model, seed);
      VectorXd aligned = state;
      aligned.head<10>() << VectorXd::Zero(6), 1.0, 0.0, 0.0, 0.0;
      VectorXd expected = Bare(model, aligned).accelerations();
      const Quaterniond q_BN(state[6], state[7], state[8], state[9]);
      const Vector3d a_BN_B = expected.head<3>();
      expected.head<3>() = q_BN.normalized().toRotationMatrix() * a_BN_B;
      const VectorXd found = velocity_part(engine->layout(), derivative(*engine, state));
      // Its slanted wheels are made round: the same machine, not the same sums.
      if (model.name == "menagerie")
        EXPECT_LT(relative_difference(found, expected), 1e-12) << " seed " << seed;
      else
        EXPECT_EQ(found, expected) << model.name << " seed " << seed;
    }
  }
}

/// A hub at rest with one fast wheel, with mass and off the centre; it may be on an arm.
Model with_fast_wheel(const Vector3d& axis, bool on_arm) {
  ModelBuilder builder{EngineControls{}};
  builder.add_hub();
  const auto box = [](const Vector3d& moments) -> Matrix3d { return moments.asDiagonal(); };
  builder.add_mass({}, {"hub", 1000.0, Vector3d::Zero(), box({700.0, 650.0, 500.0})});
  Mount mount;
  if (on_arm) {
    Joint joint;
    joint.r_HP_P = Vector3d(0.5, 0.0, 0.2);
    joint.dcm_PL0 = Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, -1.0).normalized()).matrix();
    mount = builder.add_link({}, "arm", joint);
    builder.add_mass(mount, {"arm", 50.0, Vector3d(0.3, 0.0, 0.0), box({10.0, 12.0, 13.0})});
    builder.add_coordinate(Coordinate::Kind::kBodyAngle, "arm", mount.link, 0.3, 0.0);
  }
  Rotor rotor;
  rotor.name = "rw";
  rotor.axis_L = axis;
  rotor.spin_inertia = 0.024;
  const Matrix3d I = 0.013 * Matrix3d::Identity() + 0.011 * axis * axis.transpose();
  const int index = builder.add_wheel(mount, rotor, {"rw", 10.0, Vector3d(0.4, 0.3, -0.3), I});
  builder.add_coordinate(Coordinate::Kind::kWheel, "rw", index, 0.0, 628.3);
  Model model = std::move(builder).build();
  model.name = "fast_wheel";
  return model;
}

// A balanced wheel that turns and nothing else moves nothing. Of the wheel's m r^2 Omega^2, about
// 1.3e6 N m, rounding would leave 3e-10 N m; of its Js Omega^2, 9.5e3 N m, a unit in the last
// place.
TEST(MujocoEngine, LeavesNothingOfAFastWheelsOwnTurning) {
  const double torque = std::numeric_limits<double>::epsilon() * 0.024 * 628.3 * 628.3;  // [N m]
  for (const bool on_arm : {false, true}) {
    for (int i = 0; i < 30; ++i) {
      const Vector3d axis = Vector3d(std::cos(2.0 * i), std::sin(3.0 * i), 0.1 + std::cos(5.0 * i));
      const Model model = with_fast_wheel(axis.normalized(), on_arm);
      const auto engine = engine_of(model);
      const VectorXd rate = derivative(*engine, engine->initial_state());
      const double found = rate.segment<3>(engine->layout().rate()).norm();
      EXPECT_LT(found, torque / 500.0) << "axis " << axis.transpose() << ", on arm: " << on_arm;
    }
  }
}

TEST(MujocoEngine, IsExactForAFastWheelAlongAHubAxis) {
  const auto engine = engine_of(with_fast_wheel(Vector3d::UnitY(), false));
  const VectorXd rate = derivative(*engine, engine->initial_state());
  EXPECT_EQ(rate.segment<3>(engine->layout().rate()), Vector3d(Vector3d::Zero()));
}

// The oracle forms a dense mass matrix from the assembly, so this also holds emission to account.
TEST(MujocoEngine, MovesTheMachineThatTheAssemblyDescribes) {
  for (const Model& sample : samples()) {
    const Model model = without_loads(sample);
    const auto engine = engine_of(model);
    const StateLayout& layout = engine->layout();
    const std::vector<Vector3d> none(model.assembly.links.size(), Vector3d::Zero());
    for (unsigned seed = 0; seed < 20; ++seed) {
      const VectorXd state = test::sample_state(model, seed);
      const auto entries = [&](int begin, int count) {
        return std::vector(state.data() + begin, state.data() + begin + count);
      };
      const test::OracleState seen{
          state.segment<3>(layout.rate()), entries(layout.joint(), layout.joints),
          entries(layout.joint_rate(), layout.joints), entries(layout.wheel(), layout.wheels)};
      VectorXd expected = test::dense_accelerations(model.assembly, seen, none, none);
      const Quaterniond q_BN(state[6], state[7], state[8], state[9]);
      expected.head<3>() = (q_BN * expected.head<3>()).eval();
      const VectorXd found = velocity_part(layout, derivative(*engine, state));
      EXPECT_LT(relative_difference(found, expected), 1e-11) << model.name << " seed " << seed;
    }
  }
}

TEST(MujocoEngine, ReadsTheFreeJointAsHubOriginInNAndRateInB) {
  Model model = test::offset_hub();
  model.tree.bodies[0].inertial.r_CL_L = Vector3d(0.5, 0.0, 0.0);
  model.tree.bodies[0].inertial.I_PntC_L = Vector3d(900.0, 800.0, 600.0).asDiagonal();
  const auto engine = engine_of(model);
  VectorXd state = VectorXd::Zero(13);
  state.segment<3>(3) << 1.0, 2.0, 3.0;
  state[6] = state[9] = std::sqrt(0.5);  // yawed by 90 deg: the centre of mass lies along N's y
  state[12] = 1.0;                       // spin about z
  VectorXd expected = VectorXd::Zero(13);
  expected.head<3>() << 1.0, 2.0, 3.0;
  expected[4] = 0.5;  // B is drawn towards the centre of mass, omega^2 r
  expected[6] = -0.5 * state[9];
  expected[9] = 0.5 * state[6];
  EXPECT_LT((derivative(*engine, state) - expected).norm(), 1e-15);
}

TEST(MujocoEngine, DoesNotCareInTheComovingFrameHowFastAndWhereTheVehicleFlies) {
  for (const Model& model : samples()) {
    const auto engine = engine_of(model);
    const VectorXd at_rest = test::sample_state(model, 1);
    VectorXd in_orbit = at_rest;
    in_orbit.head<6>() << 7.0e6, -1.0e5, 3.0e4, 10.0, -7.5e3, 1.0e3;
    EXPECT_EQ(velocity_part(engine->layout(), derivative(*engine, in_orbit)),
              velocity_part(engine->layout(), derivative(*engine, at_rest)))
        << model.name;
  }
}

// A body at rest but for its speed has no angular acceleration. Handed the raw velocity, MuJoCo
// computes one from m v x v; powers of two keep the rounding itself, so the ratio is nearly exact.
TEST(MujocoEngine, ShowsInTheInertialFrameAnArtefactThatGrowsWithSpeedSquared) {
  Model model = test::offset_hub();
  model.tree.bodies[0].inertial.r_CL_L.setZero();
  model.engines.frame = MujocoFrame::kInertial;
  const auto engine = engine_of(model);
  const auto artefact = [&](double speed) {
    VectorXd state = VectorXd::Zero(13);
    state.segment<3>(3) = speed / 7.0 * Vector3d(2.0, -3.0, 6.0);
    state[6] = 1.0;
    return derivative(*engine, state).segment<3>(10).norm();
  };
  EXPECT_GT(artefact(7500.0), 1e-11);
  EXPECT_LT(artefact(7500.0), 1e-7);
  EXPECT_NEAR(artefact(7500.0) / artefact(3750.0), 4.0, 1e-3);
  EXPECT_NEAR(artefact(3750.0) / artefact(1875.0), 4.0, 1e-3);
}

TEST(MujocoEngine, FallsAlikeInBothFramesUnderEveryGravityLaw) {
  for (const GravityLaw law :
       {GravityLaw::kSystemCom, GravityLaw::kBodyCom, GravityLaw::kBodyGradient}) {
    Model model = beside_an_asteroid(test::menagerie(), law);
    const auto comoving = engine_of(model);
    model.engines.frame = MujocoFrame::kInertial;
    const auto inertial = engine_of(model);
    const VectorXd state = near_asteroid(model, 3);
    EXPECT_LT(relative_difference(derivative(*comoving, state), derivative(*inertial, state)),
              1e-12);
  }
}

TEST(WrenchProjector, EqualsMujocosOwnExternalForces) {
  for (const Model& sample : samples()) {
    const Model model = without_loads(sample);
    const VectorXd state = test::sample_state(model, 5);
    Bare direct(model, state), projected(model, state);
    mj_kinematics(projected.m.get(), projected.d.get());
    mj_comPos(projected.m.get(), projected.d.get());
    std::vector<Wrench> wrenches;
    for (const int body : direct.map.link_body) {
      const double k = body;
      wrenches.push_back({Vector3d(k, 1.0, -2.0), Vector3d(0.5, -k, 0.3)});
      const Vector3d r_CB_N = Eigen::Map<const Vector3d>(projected.d->xipos + 3 * body);
      const Vector3d torque_C =
          wrenches.back().torque_PntB_W - r_CB_N.cross(wrenches.back().force_W);
      Eigen::Map<Vector3d>(direct.d->xfrc_applied + 6 * body) = wrenches.back().force_W;
      Eigen::Map<Vector3d>(direct.d->xfrc_applied + 6 * body + 3) = torque_C;
    }
    WrenchProjector projector(*projected.m, projected.map);
    projector.add(*projected.m, *projected.d, wrenches,
                  {projected.d->qfrc_applied, static_cast<std::size_t>(projected.m->nv)});
    EXPECT_LT(relative_difference(projected.accelerations(), direct.accelerations()), 1e-12)
        << model.name;
  }
}

TEST(MujocoEngine, HasTheMassMatrixOfItsKineticEnergy) {
  for (const Model& model : samples()) {
    const auto engine = engine_of(model);
    VectorXd state = test::sample_state(model, 7);
    state.segment<3>(3) << 0.1, -0.2, 0.3;
    const VectorXd u = velocity_part(engine->layout(), state);
    const Eigen::MatrixXd mass = engine->mass_matrix(span_of(state));
    EXPECT_EQ(mass, mass.transpose());
    const double kinetic = engine->observe(0.0, span_of(state)).kinetic;
    EXPECT_NEAR(0.5 * u.dot(mass * u) / kinetic, 1.0, 1e-13) << model.name;
  }
}

// d/dt of what observe() shows, by central differences along the derivative, is what
// derivative() says comes from outside.
TEST(MujocoEngine, KeepsItsBooksUnderEveryGravityLaw) {
  for (const GravityLaw law : {GravityLaw::kNone, GravityLaw::kSystemCom, GravityLaw::kBodyCom,
                               GravityLaw::kBodyGradient}) {
    const Model model = beside_an_asteroid(test::menagerie(), law);
    const auto engine = engine_of(model);
    const VectorXd state = near_asteroid(model, 11);
    const VectorXd rate = derivative(*engine, state);
    const double h = 1e-5;  // [s]
    const Observation before = engine->observe(0.0, span_of(state - h * rate));
    const Observation after = engine->observe(0.0, span_of(state + h * rate));
    BookRates outside;
    VectorXd same(rate.size());
    engine->derivative(0.0, span_of(state), {same.data(), static_cast<std::size_t>(same.size())},
                       &outside);
    EXPECT_EQ(same, rate);
    const double power =
        (after.kinetic + after.potential - before.kinetic - before.potential) / (2 * h);
    const Vector3d force = (after.momentum - before.momentum) / (2 * h);
    const Vector3d torque = (after.H_PntC_N - before.H_PntC_N) / (2 * h);
    // Differences of 1e4 J and 1e3 N m s, rounded at 1e-16 and divided by 2e-5 s.
    EXPECT_NEAR(power, outside.power, 1e-5 * std::abs(outside.power));
    EXPECT_LT((force - outside.force_N).norm(), 1e-6 * outside.force_N.norm());
    EXPECT_LT((torque - outside.torque_PntC_N).norm(), 1e-6 * outside.torque_PntC_N.norm());
    EXPECT_GT(std::abs(outside.power), 1.0);
  }
}

TEST(MujocoEngine, ObservesTheCentreOfMassWhereMomentumSaysItMoves) {
  const Model model = test::menagerie();
  const auto engine = engine_of(model);
  VectorXd state = test::sample_state(model, 13);
  state.head<6>() << 7.0e6, 0.0, 0.0, 0.0, 7.5e3, 0.0;
  state.segment<4>(6) << -0.5, 0.5, 0.5, -0.5;
  const Observation seen = engine->observe(2.5, span_of(state));
  EXPECT_EQ(seen.time, 2.5);
  EXPECT_LT((seen.momentum - seen.mass * seen.v_CN_N).norm(), 1e-14 * seen.momentum_scale);
  EXPECT_NEAR(seen.mass, 600.0 + 25.0 + 12.0 + 3.0 + 2.0 + 6.0, 1e-12);
  EXPECT_EQ(seen.q_BN.w(), 0.5) << "of the two signs the one that is not negative";
  EXPECT_EQ(seen.q_BN.z(), 0.5);
  EXPECT_GE(seen.H_scale, seen.H_PntC_N.norm());
}

TEST(MujocoEngine, HoldsItsInputsUntilToldOtherwise) {
  const Model model = test::menagerie();  // `arm` turns from 0.5 to -0.5 N m at 2 s
  const auto engine = engine_of(model);
  const VectorXd state = test::sample_state(model, 17);
  const VectorXd at_start = derivative(*engine, state, 0.0);
  EXPECT_EQ(derivative(*engine, state, 2.0), at_start);
  engine->hold(inputs_at(model, 2.0));
  EXPECT_GT((derivative(*engine, state, 2.0) - at_start).norm(), 1e-3);
}

TEST(MujocoEngine, StartsWhereTheModelDoesAndNormalisesAfterAStep) {
  const Model model = test::menagerie();
  const auto engine = engine_of(model);
  VectorXd state = engine->initial_state();
  ASSERT_EQ(state.size(), engine->layout().size());
  EXPECT_EQ(state[6], 1.0);
  EXPECT_EQ(state[engine->layout().joint()], 0.02);
  EXPECT_EQ(state[engine->layout().wheel() + 1], -50.0);
  state.segment<4>(6) << 2.0, 0.0, 0.0, 2.0;
  engine->finish_step({state.data(), static_cast<std::size_t>(state.size())});
  EXPECT_DOUBLE_EQ(state[6], std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(state[9], std::sqrt(0.5));
}

TEST(TreeMap, CountsAWheelWithMassOnItsMount) {
  Model model = test::menagerie();
  TreeBody& wheel = model.tree.bodies.back();
  wheel.quat = Quaterniond(Eigen::AngleAxisd(0.5, Vector3d::UnitX()));
  const auto elements = gravity_elements(model);
  ASSERT_EQ(elements[2].size(), 2u);
  const MassElement& carried = elements[2][1];
  EXPECT_EQ(carried.name, "rw_arm");
  EXPECT_EQ(carried.r_EL_L, wheel.pos);
  const Matrix3d dcm = wheel.quat.toRotationMatrix();
  EXPECT_LT((carried.I_PntE_L - dcm * wheel.inertial.I_PntC_L * dcm.transpose()).norm(), 1e-16);
}

TEST(MujocoEngine, DoesNotAllocateInADerivative) {
  Model model = beside_an_asteroid(test::menagerie(), GravityLaw::kBodyGradient);
  const auto engine = engine_of(model);
  const VectorXd state = near_asteroid(model, 19);
  VectorXd rate(state.size());
  const std::span out(rate.data(), static_cast<std::size_t>(rate.size()));
  static const auto kInstalled = mju_user_malloc;
  mju_user_malloc = [](std::size_t size) {
    std::free(test::counted_malloc(1));  // counts
    return kInstalled(size);
  };
  const long before = test::allocation_count();
  for (int i = 0; i < 100; ++i) engine->derivative(0.0, span_of(state), out);
  const long after = test::allocation_count();
  mju_user_malloc = kInstalled;
  EXPECT_EQ(after - before, 0);
}

TEST(MujocoEngine, TurnsMujocosErrorsIntoExceptionsAndWritesNoLog) {
  std::filesystem::remove("MUJOCO_LOG.TXT");
  EXPECT_THAT([] { load_mjcf("<mujoco><worldbody><nonsense/></worldbody></mujoco>"); },
              ThrowsMessage<NumericalFailure>(HasSubstr("nonsense")));
  EXPECT_THAT([] { mju_error("broken"); },
              ThrowsMessage<NumericalFailure>(HasSubstr("mujoco: broken")));
  mju_warning("odd");
  EXPECT_EQ(take_mujoco_warnings(), "odd");
  EXPECT_EQ(take_mujoco_warnings(), "");
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

TEST(MujocoEngine, RefusesAModelThatIsNotInTheMjcf) {
  const std::string other = emit_mjcf(test::two_chains(1));
  EXPECT_THAT([&] { make_mujoco_engine(test::two_chains(2), other); },
              ThrowsMessage<NumericalFailure>(HasSubstr("wing_p.2")));
}

TEST(MujocoEngine, NamesTheCoordinateThatIsNotFinite) {
  const Model model = test::menagerie();
  const auto engine = engine_of(model);
  VectorXd state = test::sample_state(model, 23);
  state[engine->layout().joint() + 1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { derivative(*engine, state, 1.5); },
              ThrowsMessage<NumericalFailure>(HasSubstr("`arm` is not finite")));
  state[engine->layout().joint() + 1] = 0.0;
  EXPECT_TRUE(derivative(*engine, state).allFinite()) << "a failure leaves nothing behind";
}

TEST(MujocoEngine, SaysWhichJointMakesTheMassMatrixSingular) {
  Model model = test::two_chains(1);
  model.tree.bodies[2].inertial = MassProperties{};
  const auto engine = engine_of(model);
  EXPECT_THAT([&] { derivative(*engine, engine->initial_state()); },
              ThrowsMessage<NumericalFailure>(HasSubstr("singular at `wing_m.1`")));
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

}  // namespace
}  // namespace twincraft
