// Orbits in kilometres that are written as metres, and those that are meant as they stand.
#include "compiler/spec/kilometres.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/compiler/trial.h"

namespace twincraft {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> said_about(const std::string& mu, const std::string& initial) {
  const Trial trial(
      brick_with("environment: {gravity: {mu: " + mu + "}}\ninitial: {" + initial + "}\n"));
  EXPECT_TRUE(trial.model) << mu << " " << initial;
  return trial.faults();
}

std::string orbit(const std::string& semi_major_axis) {
  return "orbit: {semi_major_axis: " + semi_major_axis +
         ", eccentricity: 0, inclination: 0, raan: 0, argument_of_periapsis: 0, true_anomaly: 0}";
}

TEST(Kilometres, AreNoticedInAGravitationalParameter) {
  for (const char* place : {"7000 km", "7.0e6", "42164 km"})
    EXPECT_THAT(said_about("398600.4418", orbit(place)),
                ElementsAre(AllOf(HasSubstr("8:29 SC2018 `mu` of gravity has the plain number"),
                                  HasSubstr("the Earth has 398600.4 km3/s2"),
                                  HasSubstr("write `398600.4418 km3/s2`"))));
  EXPECT_THAT(said_about("4902.8", "position: [2000 km, 0, 0]"),
              ElementsAre(HasSubstr("the Moon has")));
  // Of no body in the table: a moon of Saturn at a distance of its own kilometres.
  EXPECT_THAT(said_about("8978.1", orbit("3000 km")),
              ElementsAre(HasSubstr("makes an orbit at 3000 km one of 0.0547 m/s")));
}

TEST(Kilometres, AreNoticedInAnOrbitInsideItsBody) {
  EXPECT_THAT(said_about("3.986e14", orbit("7000")),
              ElementsAre(AllOf(HasSubstr("`semi_major_axis` of orbit has the plain number `7000`"),
                                HasSubstr("write `7000 km`"))));
  EXPECT_THAT(said_about("398600.44 km3/s2", "position: [7000, 0, 0]"),
              ElementsAre(HasSubstr("`position` of initial has the plain number `7000`")));
}

TEST(Kilometres, PerSecondAreNoticedInAVelocity) {
  EXPECT_THAT(said_about("3.986e14", "position: [7000 km, 0, 0], velocity: [0, 7.5, 0]"),
              ElementsAre(AllOf(HasSubstr("the plain number `7.5`: 7.5 m/s, where a circular orbit "
                                          "has 7546 m/s"),
                                HasSubstr("write `7.5 km/s`"))));
}

TEST(Kilometres, AreNotSeenWhereMetresAreMeant) {
  EXPECT_THAT(said_about("3.98600436e14", orbit("7.0e6")), IsEmpty());
  EXPECT_THAT(said_about("1.32712440e20", orbit("1.495978707e11")), IsEmpty());
  EXPECT_THAT(said_about("1.32712440e20", orbit("4.5e12")), IsEmpty());       // Neptune
  EXPECT_THAT(said_about("3.98600436e14", orbit("1.5e9")), IsEmpty());        // L2
  EXPECT_THAT(said_about("4.463e5", orbit("35 km")), IsEmpty());              // 433 Eros
  EXPECT_THAT(said_about("5.2", orbit("1500")), IsEmpty());                   // Bennu
  EXPECT_THAT(said_about("1", orbit("1")), IsEmpty());                        // canonical units
  EXPECT_THAT(said_about("398600.4418 m3/s2", orbit("7000 km")), IsEmpty());  // said to be meant
  EXPECT_THAT(said_about("3.986e14", "position: [7.0e6, 0, 0]"), IsEmpty());  // falls from rest
}

TEST(Millimetres, AreNoticedInAPlate) {
  const auto panel = [](const std::string& thickness) {
    return brick_with(
        "panels: [{name: w, mass: 2, length: 1, stiffness: 1, inertia: {shape: plate, width: 0.5, "
        "thickness: " +
        thickness + "}, hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: [1, 0, 0]}}]\n");
  };
  EXPECT_THAT(Trial(panel("20")).faults(),
              ElementsAre(AllOf(HasSubstr("`thickness` of panel `w`"), HasSubstr("`20 mm`"))));
  EXPECT_THAT(Trial(panel("0.02")).faults(), IsEmpty());
}

}  // namespace
}  // namespace twincraft
