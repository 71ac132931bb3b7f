// A duel says that two engines differ; a third vote says which one is wrong. Simbody 3.7 on every
// vehicle of the component battery and on the shipped models.
#include <gtest/gtest.h>

#include "runtime/bsm/engine.h"
#include "runtime/mujoco/engine.h"
#include "tests/support/asked.h"
#include "tests/support/compiled.h"
#include "tests/support/simbody_oracle.h"

namespace twincraft {
namespace {

class Simbody : public testing::TestWithParam<std::string> {};

TEST_P(Simbody, AgreesWithBothEngines) {
  const Bundle bundle = test::compiled_file(GetParam() + ".yaml");
  const Model& model = bundle.model;
  const auto bsm = make_bsm_engine(model);
  const auto mujoco = make_mujoco_engine(model, bundle.text(kMjcf));
  for (const RandomState& state : random_states(model, 20)) {
    const Eigen::VectorXd truth = test::simbody_accelerations(model, model.gravity.bsm, state);
    const Eigen::VectorXd a = test::accelerations_at(model, *bsm, state);
    const Eigen::VectorXd b = test::accelerations_at(model, *mujoco, state);
    const auto agrees = [&truth](const Eigen::VectorXd& answer, Eigen::Index at,
                                 Eigen::Index count) {
      // Rates of about 0.1 rad/s make 0.01 of any acceleration; what is smaller is a difference.
      const double scale = std::max(0.01, truth.segment(at, count).norm());
      return (answer - truth).segment(at, count).norm() <= 1.0e-10 * scale;
    };
    const Eigen::Index rest = truth.size() - 6;
    for (const Eigen::VectorXd& answer : {a, b}) {
      EXPECT_TRUE(agrees(answer, 0, 3)) << "linear\n"
                                        << answer.transpose() << "\n"
                                        << truth.transpose();
      EXPECT_TRUE(agrees(answer, 3, 3)) << "angular\n"
                                        << answer.transpose() << "\n"
                                        << truth.transpose();
      EXPECT_TRUE(agrees(answer, 6, rest)) << "joints and wheels\n"
                                           << answer.transpose() << "\n"
                                           << truth.transpose();
    }
  }
}

std::string name_of(const testing::TestParamInfo<std::string>& one) {
  return one.param.substr(one.param.rfind('/') + 1);
}

INSTANTIATE_TEST_SUITE_P(
    Components, Simbody,
    testing::Values("tests/components/vehicles/hub", "tests/components/vehicles/wheel",
                    "tests/components/vehicles/panel", "tests/components/vehicles/chain",
                    "tests/components/vehicles/damped", "tests/components/vehicles/gravity",
                    "tests/components/vehicles/arm", "tests/components/vehicles/arm_in_orbit",
                    "tests/components/vehicles/particle", "tests/components/vehicles/pendulum",
                    "tests/components/vehicles/bob", "tests/components/vehicles/burn",
                    "tests/components/vehicles/jet"),
    name_of);
INSTANTIATE_TEST_SUITE_P(Models, Simbody,
                         testing::Values("models/quickstart", "models/gallery/branched_arm",
                                         "models/gallery/jet_damping", "models/nesc/case_10a",
                                         "models/paper/orbit_extended",
                                         "models/paper/variable_mass", "models/paper/flex_panels"),
                         name_of);

}  // namespace
}  // namespace twincraft
