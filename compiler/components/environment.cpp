// See environment.h. Tested by tests/compiler/engines_test.cpp.
#include "compiler/components/environment.h"

namespace twincraft {
namespace {

const Table<GravitySpec>& gravity_table() {
  static const Table<GravitySpec> table{
      "gravity",
      "A point mass at the origin of N: the field -mu r/|r|^3.",
      {
          required("mu", &GravitySpec::mu, quantity("m3/s2", Range::kPositive),
                   "Gravitational parameter of the attracting body; the Earth's is "
                   "3.98600436e14 m3/s2."),
          optional("application", &GravitySpec::application, gravity_law(),
                   "`system_com`: one force, at the system centre of mass. `body_com`: one force "
                   "at the centre of mass of every body. `body_gradient`: also every body's own "
                   "gravity-gradient torque."),
      }};
  return table;
}

}  // namespace

Kind<GravityLaw> gravity_law() {
  return one_of<GravityLaw>({{"system_com", GravityLaw::kSystemCom},
                             {"body_com", GravityLaw::kBodyCom},
                             {"body_gradient", GravityLaw::kBodyGradient}});
}

const Table<EnvironmentSpec>& environment_table() {
  static const Table<EnvironmentSpec> table{
      "environment",
      "What surrounds the vehicle.",
      {
          optional("gravity", &EnvironmentSpec::gravity, maybe(object(gravity_table())),
                   "Default: none, deep space."),
      }};
  return table;
}

}  // namespace twincraft
