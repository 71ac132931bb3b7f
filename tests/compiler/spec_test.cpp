// What holds between the sections of a spec, and the model as a whole.
#include "compiler/spec/spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Spec, NamesTheFormatsItReads) {
  const Text other("format: spacecraft/2\nhubs: []\n");
  Diagnostics diagnostics;
  EXPECT_FALSE(check_format(other.root, diagnostics));
  EXPECT_THAT(lines_of(diagnostics),
              ElementsAre("1:9 SC3001 format `spacecraft/2` is not read by this program (it reads "
                          "`spacecraft/1`)"));
  Diagnostics none;
  EXPECT_TRUE(check_format(Text("format: spacecraft/1\n").root, none));
  EXPECT_THAT(lines_of(none), IsEmpty());
}

TEST(Spec, ReportsANameTakenByAnotherComponentAtTheSecondPlace) {
  const Trial trial(brick_with(R"(loads:
  - {name: x, force: [1, 0, 0]}
wheels:
  - {name: x, axis: [1, 0, 0], spin_inertia: 0.08, transverse_inertia: 0.04}
  - {name: x, axis: [1, 0, 0], spin_inertia: 0.08, transverse_inertia: 0.04}
)"));
  EXPECT_THAT(trial.faults(),
              ElementsAre("12:12 SC3002 wheel `x` has the name of a wheel (names are unique in the "
                          "whole file) | 11:12 wheel `x` is named here",
                          "9:12 SC3002 load `x` has the name of a wheel (names are unique in the "
                          "whole file) | 11:12 wheel `x` is named here"));
}

TEST(Spec, ReportsTheFaultsOfAllComponentsTogether) {
  const Trial trial(brick_with(R"(wheels:
  - {name: a, axis: [1, 0, 0], spin_inertia: 1, transverse_inertia: 0.04}
  - {name: b, axis: [1, 0, 0], spin_inertia: 1, transverse_inertia: 0.5, mount: x}
initial: {attitude: {quaternion: [1, 1, 0, 0]}}
)"));
  EXPECT_THAT(trial.codes(), ElementsAre(Code::kInertiaTriangle, Code::kUnknownComponent,
                                         Code::kNotUnitQuaternion));
  EXPECT_FALSE(trial.model);
}

TEST(Spec, KeepsTheOrderOfTheLanguageInTheCoordinates) {
  const Trial trial(brick_with(R"(panels:
  - {name: wing, mass: 50, length: 2, segments: 2, inertia: [3, 2, 2],
     hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: [1, 0, 0]}}
wheels:
  - {name: rw, axis: [1, 0, 0], spin_inertia: 0.08, transverse_inertia: 0.04}
)"));
  ASSERT_TRUE(trial.model);
  std::vector<std::string> names;
  for (const Coordinate& coordinate : trial.model->coordinates) names.push_back(coordinate.name);
  EXPECT_THAT(names, ElementsAre("rw", "wing.1", "wing.2"));
  EXPECT_EQ(trial.model->coordinates.at(1).index, 1);
  EXPECT_EQ(trial.model->coordinates.at(2).index, 2);
}

TEST(Spec, ReadsItsOwnResolvedFormToTheSameModel) {
  const Trial first(brick_with(R"(panels:
  - {name: wing, mass: 50, length: 2, segments: 2, inertia: {shape: bar}, angle: 12 deg,
     hinge: {position: [1, 0, 0], axis: [0, 2, 0], outboard: [1, 0, 0]}}
initial: {attitude: {align: [{axis: -z, to: [1, 2, 3]}, {axis: y, to: [0, 1, 0]}]}}
)"));
  ASSERT_TRUE(first.model);
  const Json resolved = spec_table().write(first.spec);
  const Trial second(resolved.dump());
  ASSERT_TRUE(second.model) << resolved.dump(2);
  EXPECT_EQ(spec_table().write(second.spec), resolved);
  EXPECT_EQ(second.model->initial.r_BN_N, first.model->initial.r_BN_N);
  EXPECT_EQ(second.model->initial.q_BN.coeffs(), first.model->initial.q_BN.coeffs());
}

TEST(Spec, HasASchemaOfItsSections) {
  const Json schema = spec_table().schema();
  EXPECT_EQ(schema.at("required"), Json::array({"format", "name", "hub"}));
  EXPECT_TRUE(schema.at("properties").contains("panels"));
}

}  // namespace
}  // namespace twincraft
