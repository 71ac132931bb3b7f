// Claims about the proof: it passes for one machine built twice, and every kind of difference
// between two machines is found and named.
#include "runtime/compare/proof.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "compiler/components/model_builder.h"
#include "compiler/emit/mjcf.h"
#include "runtime/bsm/engine.h"
#include "runtime/compare/random_state.h"
#include "runtime/mujoco/engine.h"
#include "tests/support/sample_models.h"

namespace twincraft {
namespace {

using testing::HasSubstr;

Model scheduled(Model model) {
  model.simulation.duration = 100.0;
  return model;
}

Bundle bundle_of(Model model) {
  Bundle bundle;
  bundle.emitted[kMjcf].text = emit_mjcf(model);
  bundle.model = std::move(model);
  return bundle;
}

/// The proof of a model against itself with one change.
ProofReport against(const Model& model, const std::function<void(Model&)>& change) {
  Model changed = model;
  change(changed);
  const auto a = make_bsm_engine(model);
  const auto b = make_bsm_engine(changed);
  return prove(model, *a, *b);
}

std::vector<std::string> failing(const ProofReport& report) {
  std::vector<std::string> names;
  for (const ProofLine& line : report.lines)
    if (!line.pass()) names.push_back(line.what);
  return names;
}

TEST(Proof, HoldsForEverySampleVehicle) {
  for (const Model& model :
       {test::offset_hub(), test::wheels_and_panels(), test::two_chains(4), test::menagerie()}) {
    const ProofReport report = prove(bundle_of(scheduled(model)));
    EXPECT_TRUE(report.pass()) << model.name << "\n" << to_text(report);
  }
}

TEST(Proof, HoldsForEitherChartAndFrame) {
  Model model = scheduled(test::wheels_and_panels());
  model.engines.attitude = AttitudeChart::kQuaternion;
  model.engines.frame = MujocoFrame::kInertial;
  const ProofReport report = prove(bundle_of(model));
  EXPECT_TRUE(report.pass()) << to_text(report);
}

/// Seeded, and the same with every library.
class Draw {
 public:
  explicit Draw(unsigned seed) : bits_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  double size(double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); }
  Vector3d direction() {
    Vector3d v;
    do {
      v = Vector3d(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0));
    } while (v.squaredNorm() > 1.0 || v.squaredNorm() < 0.01);
    return v.normalized();
  }
  /// Moments of a box of sides about `length` in turned axes.
  MassElement box(const std::string& name, double mass, double length) {
    const Vector3d side(size(0.1, 1.0), size(0.1, 1.0), size(0.1, 1.0));
    const Vector3d squares = length * length / 12.0 * side.cwiseAbs2();
    const Vector3d moments = mass * (Vector3d::Constant(squares.sum()) - squares);
    const Matrix3d turn = Eigen::AngleAxisd(between(0.0, 3.0), direction()).toRotationMatrix();
    const Matrix3d I = turn * moments.asDiagonal() * turn.transpose();
    return {name, mass, between(0.2, 0.5) * length * direction(), 0.5 * (I + I.transpose())};
  }

 private:
  std::mt19937_64 bits_;
};

/// A hub with a camera of a ten-millionth of its mass on a sprung hinge 50 m out: on the hub
/// itself, on a rail, or on a boom that turns as well. Some have a wheel beside it.
Model far_camera(unsigned seed) {
  Draw draw(seed);
  ModelBuilder builder{EngineControls{}};
  builder.add_hub();
  const double mass = draw.size(1.0e2, 1.0e6);
  builder.add_mass({}, draw.box("hub", mass, draw.size(1.0, 60.0)));
  const auto joint_at = [&draw](const Vector3d& place) {
    Joint joint;
    joint.r_HP_P = place;
    joint.dcm_PL0 = Eigen::AngleAxisd(draw.between(0.0, 3.0), draw.direction()).toRotationMatrix();
    joint.axis_L = draw.direction();
    return joint;
  };
  const auto add = [&builder](const Mount& mount, const std::string& name, const Joint& joint,
                              Coordinate::Kind kind) {
    const Mount made = builder.add_link(mount, name, joint);
    builder.add_coordinate(kind, name, made.link, 0.1, 0.0);
    return made;
  };
  const Vector3d place = 50.0 * draw.direction();
  Mount mount;
  Vector3d at = place;
  const bool has_boom = seed % 3 == 1, has_rail = seed % 3 == 2;
  if (has_boom || has_rail) {
    Joint first = joint_at(draw.between(0.1, 0.9) * place);
    first.kind = has_rail ? JointKind::kSlide : JointKind::kHinge;
    mount = add({}, "first", first,
                has_rail ? Coordinate::Kind::kBodyDisplacement : Coordinate::Kind::kBodyAngle);
    builder.add_mass(mount, draw.box("first", draw.size(1.0e-4, 1.0e-1) * mass, 5.0));
    at = first.dcm_PL0.transpose() * (place - first.r_HP_P);
  }
  const double length = draw.size(1.0e-2, 1.0), small = 1.0e-7 * mass;
  Joint hinge = joint_at(at);
  const double rate = draw.size(0.3, 30.0);  // [rad/s] about
  hinge.stiffness = small * length * length * rate * rate;
  const Mount camera = add(mount, "cam", hinge, Coordinate::Kind::kBodyAngle);
  builder.add_mass(camera, draw.box("cam", small, length));
  if (seed % 2 == 0) {
    Rotor rotor;
    rotor.name = "rw";
    rotor.axis_L = draw.direction();
    rotor.spin_inertia = 1.0e-5 * mass;
    const Matrix3d I = 0.6 * rotor.spin_inertia * Matrix3d::Identity() +
                       0.4 * rotor.spin_inertia * rotor.axis_L * rotor.axis_L.transpose();
    const int index = builder.add_wheel({}, rotor, {"rw", 1.0e-3 * mass, draw.direction(), I});
    builder.add_coordinate(Coordinate::Kind::kWheel, "rw", index, 0.0, 600.0);
  }
  Model model = std::move(builder).build();
  model.name = "far_camera";
  model.initial.omega_BN_B = 0.01 * draw.direction();
  return scheduled(model);
}

TEST(Proof, HoldsForATinyBodyFarFromTheCenterOfMass) {
  int raised = 0;
  for (unsigned seed = 0; seed < 90; ++seed) {
    const ProofReport report = prove(bundle_of(far_camera(seed)));
    EXPECT_TRUE(report.pass()) << "seed " << seed << "\n" << to_text(report);
    raised += std::ranges::any_of(
        report.lines, [](const ProofLine& line) { return line.difference > kProofBound; });
  }
  EXPECT_GT(raised, 0) << "none of these vehicles needs a bound of its own";
}

/// What a part in a billion of one number of the tree's `cam` does to the proof.
std::vector<std::string> failing_after(void (*change)(TreeBody&), unsigned seed) {
  Model model = far_camera(seed);
  change(*std::ranges::find(model.tree.bodies, "cam", &TreeBody::name));
  return failing(prove(bundle_of(std::move(model))));
}

TEST(Proof, FindsAPartPerBillionInATinyBodyFarFromTheCenterOfMass) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const auto finds = [seed](void (*change)(TreeBody&)) { return failing_after(change, seed); };
    EXPECT_THAT(finds([](TreeBody&) {}), testing::IsEmpty());
    EXPECT_THAT(finds([](TreeBody& cam) { cam.inertial.mass *= 1.0 + 1.0e-9; }),
                testing::Contains("masses of links"));
    EXPECT_THAT(finds([](TreeBody& cam) { cam.inertial.r_CL_L *= 1.0 + 1.0e-9; }),
                testing::Contains("centres of mass of links"));
    EXPECT_THAT(finds([](TreeBody& cam) {
                  const PrincipalInertia principal = principal_inertia(cam.inertial.I_PntC_L);
                  const Vector3d axis = principal.axes * Vector3d::UnitX();
                  cam.inertial.I_PntC_L += 1.0e-9 * principal.moments[0] * axis * axis.transpose();
                }),
                testing::Contains("inertias of links"));
    EXPECT_THAT(finds([](TreeBody& cam) { cam.pos *= 1.0 + 1.0e-9; }),
                testing::Contains("places of joints"));
    EXPECT_THAT(finds([](TreeBody& cam) {
                  Vector3d& axis = cam.joints.front().axis;
                  axis = Eigen::AngleAxisd(1.0e-9, axis.unitOrthogonal()) * axis;
                }),
                testing::Contains("axes of joints"));
    EXPECT_THAT(finds([](TreeBody& cam) { cam.joints.front().stiffness *= 1.0 + 1.0e-9; }),
                testing::Contains("springs and dampers"));
  }
}

TEST(Proof, SaysWhichBoundItUsedAndWhy) {
  const auto text_of = [](const Model& model) { return to_text(prove(bundle_of(model))); };
  EXPECT_THAT(text_of(scheduled(test::wheels_and_panels())),
              testing::Not(HasSubstr("a bound of its own")));
  EXPECT_THAT(text_of(far_camera(0)), testing::AllOf(HasSubstr("ok, bound "), HasSubstr("m r^2")));
}

TEST(Proof, GivesTheSameNumbersEveryTime) {
  const Bundle bundle = bundle_of(scheduled(test::wheels_and_panels()));
  EXPECT_EQ(to_text(prove(bundle)), to_text(prove(bundle)));
}

TEST(Proof, SaysHowFarItIs) {
  std::vector<double> shown;
  prove(bundle_of(test::wheels_and_panels()), [&shown](double done) { shown.push_back(done); });
  ASSERT_EQ(shown.size(), static_cast<std::size_t>(kProofStates));
  EXPECT_EQ(shown.front(), 0.0);
  EXPECT_TRUE(std::ranges::is_sorted(shown));
  EXPECT_LT(shown.back(), 1.0);
}

TEST(Proof, FindsAPartPerBillionOfMass) {
  const ProofReport report = against(scheduled(test::wheels_and_panels()), [](Model& model) {
    model.assembly.links[0].elements[0].mass *= 1.0 + 1.0e-9;
  });
  EXPECT_FALSE(report.pass());
  EXPECT_THAT(failing(report), testing::Contains("mass"));
}

TEST(Proof, NamesTheJointWhoseSpringIsSofter) {
  const Model model = scheduled(test::wheels_and_panels());
  const ProofReport report = against(
      model, [](Model& changed) { changed.assembly.links[1].joint.stiffness *= 1.0 - 1.0e-8; });
  EXPECT_THAT(failing(report), testing::Contains("hinge accelerations"));
  EXPECT_THAT(failing(report), testing::Not(testing::Contains("mass matrix")));
  const auto worst = std::find_if(report.lines.begin(), report.lines.end(), [](const auto& line) {
    return line.what == "hinge accelerations";
  });
  EXPECT_THAT(worst->where, HasSubstr(model.assembly.links[1].name));
}

TEST(Proof, FindsAWheelThatTurnsTheWrongWay) {
  const ProofReport report = against(scheduled(test::wheels_and_panels()),
                                     [](Model& model) { model.assembly.rotors[0].axis_L *= -1.0; });
  EXPECT_THAT(failing(report), testing::Contains("hub angular acceleration"));
}

/// Both engines are fed the same inputs; where they take them to is their own.
TEST(Proof, FindsALoadOnAnotherLink) {
  Model model = scheduled(test::wheels_and_panels());
  Load push{"push", 0, {}, {}, Vector3d::Zero()};
  push.torque_L[0] = Schedule::constant(5.0);
  model.loads = {push};
  const ProofReport report = against(model, [](Model& changed) { changed.loads[0].link = 1; });
  EXPECT_THAT(failing(report), testing::Contains("hub angular acceleration"));
}

TEST(Proof, FindsACoordinateTooMany) {
  const ProofReport report = against(scheduled(test::wheels_and_panels()), [](Model& model) {
    model.assembly.rotors.pop_back();
    model.initial.wheel_rate.pop_back();
  });
  EXPECT_THAT(failing(report), testing::ElementsAre("coordinate count"));
}

TEST(Proof, IsNotMadeWithoutATree) {
  Bundle bundle = bundle_of(scheduled(test::wheels_and_panels()));
  bundle.model.mujoco_refusal = "a chain of 96 segments";
  const ProofReport report = prove(bundle);
  EXPECT_FALSE(report.pass());
  EXPECT_EQ(to_text(report), "no proof: a chain of 96 segments\n");
}

TEST(Proof, SaysWhenTheSpecItselfAsksForADifference) {
  Bundle bundle = bundle_of(scheduled(test::wheels_and_panels()));
  bundle.model.gravity = {3.986e14, GravityLaw::kSystemCom, GravityLaw::kBodyCom};
  bundle.model.initial.r_BN_N = {7.0e6, 0.0, 0.0};
  const ProofReport report = prove(bundle);
  EXPECT_FALSE(report.pass());
  EXPECT_THAT(to_text(report), HasSubstr("different gravity laws"));
}

TEST(RandomStates, AreTheSameEverywhere) {
  const std::vector<RandomState> states = random_states(scheduled(test::offset_hub()), 2);
  // The first number of std::mt19937_64 for the seed, by the standard's own definition.
  std::mt19937_64 bits(20240229);
  EXPECT_EQ(states[0].time, 100.0 * (static_cast<double>(bits() >> 11) * 0x1p-53));
  EXPECT_NE(states[0].omega_BN_B, states[1].omega_BN_B);
}

TEST(RandomStates, AreOneAttitudeInEitherChart) {
  const RandomState state = random_states(scheduled(test::offset_hub()), 1).front();
  const Eigen::VectorXd mrp = pack(state, {AttitudeChart::kMrp, 0, 0});
  const Eigen::VectorXd quaternion = pack(state, {AttitudeChart::kQuaternion, 0, 0});
  const Vector3d sigma = mrp.segment<3>(6);
  const double square = sigma.squaredNorm();
  EXPECT_NEAR(quaternion[6], (1.0 - square) / (1.0 + square), 1.0e-15);
  EXPECT_NEAR((quaternion.segment<3>(7) - 2.0 * sigma / (1.0 + square)).norm(), 0.0, 1.0e-15);
  EXPECT_NEAR(quaternion.segment<4>(6).norm(), 1.0, 1.0e-15);
}

}  // namespace
}  // namespace twincraft
