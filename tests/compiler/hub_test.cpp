// The hub and what makes an inertia physical.
#include "compiler/components/hub.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiler/components/physical.h"
#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string hub(const std::string& inertia, const std::string& more = "") {
  return "format: spacecraft/1\nname: brick\nhub: {mass: 600 kg, inertia: " + inertia + more +
         "}\nsimulation: {step: 1 s, duration: 10 s}\n";
}

TEST(Hub, PutsItsMassOnTheFirstLinkOfBothHalves) {
  const Trial trial(hub("[400, 380, 360]", ", center_of_mass: [0, 0, 20 mm]"));
  ASSERT_TRUE(trial.model);
  EXPECT_THAT(trial.faults(), IsEmpty());
  const MassElement& element = trial.model->assembly.links.at(0).elements.at(0);
  EXPECT_EQ(element.mass, 600.0);
  EXPECT_EQ(element.r_EL_L, Vector3d(0.0, 0.0, 0.02));
  const MassProperties& inertial = trial.model->tree.bodies.at(0).inertial;
  EXPECT_EQ(inertial.mass, 600.0);
  EXPECT_EQ(inertial.I_PntC_L, Matrix3d(Vector3d(400.0, 380.0, 360.0).asDiagonal()));
}

TEST(Hub, RefusesAMassOfZeroOrLess) {
  for (const char* mass : {"0", "-1", "1.0e-16"}) {
    const Trial trial("format: spacecraft/1\nname: brick\nhub: {mass: " + std::string(mass) +
                      ", inertia: [4, 3, 2]}\nsimulation: {step: 1, duration: 10}\n");
    EXPECT_EQ(trial.faults().size(), 1u) << mass;
    EXPECT_FALSE(trial.model) << mass;
  }
}

TEST(Hub, RefusesAnInertiaThatNoBodyHas) {
  const Trial negative(hub("[400, -380, 360]"));
  EXPECT_THAT(negative.codes(), ElementsAre(Code::kInertiaNotPositive));
  EXPECT_THAT(negative.faults().at(0), HasSubstr("3:30 SC3101 inertia of the hub"));
  // Positive on the diagonal, yet not positive definite.
  const Trial products(hub("[[2, 3, 0], [3, 2, 0], [0, 0, 3]]"));
  EXPECT_THAT(products.codes(), ElementsAre(Code::kInertiaNotPositive));
  const Trial long_moment(hub("[100, 100, 201]"));
  EXPECT_THAT(long_moment.codes(), ElementsAre(Code::kInertiaTriangle));
}

TEST(Hub, AcceptsAFlatPlateRoundedUpwardsWithANote) {
  const Trial exact(hub("[1, 2, 3]"));
  EXPECT_THAT(exact.faults(), IsEmpty());
  const Trial rounded(hub("[1, 2, 3.000000001]"));
  EXPECT_THAT(rounded.codes(), ElementsAre(Code::kInertiaOnEdge));
  EXPECT_EQ(rounded.diagnostics.all().at(0).severity, Severity::kNote);
  EXPECT_TRUE(rounded.model);
}

TEST(Physicality, ToleratesARelativeBillionthOfTheTriangleAndNoMore) {
  const auto fate = [](double largest) {
    return physicality(Vector3d(1.0e-3, 2.0e-3, largest).asDiagonal());
  };
  EXPECT_EQ(fate(2.9e-3), Physicality::kPhysical);
  EXPECT_EQ(fate(3.0e-3 * (1.0 + 0.9e-9)), Physicality::kOnEdge);
  EXPECT_EQ(fate(3.0e-3 * (1.0 + 1.1e-9)), Physicality::kTriangleViolated);
}

}  // namespace
}  // namespace twincraft
