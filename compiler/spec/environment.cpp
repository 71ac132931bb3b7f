// See environment.h. Tested by tests/compiler/engines_test.cpp.
#include "compiler/spec/environment.h"

#include <utility>
#include <vector>

#include "compiler/ir/gravity_law.h"

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
                   "`system_com`: one uniform field, that of the system centre of mass, on every "
                   "body. `body_com`: one force at the centre of mass of every body. "
                   "`body_gradient`: also every body's own gravity-gradient torque; that of a "
                   "massless wheel is part of its mount's, at the mount's centre of mass."),
      }};
  return table;
}

}  // namespace

Kind<GravityLaw> gravity_law() {
  std::vector<std::pair<std::string_view, GravityLaw>> words;
  for (const GravityLaw law :
       {GravityLaw::kSystemCom, GravityLaw::kBodyCom, GravityLaw::kBodyGradient})
    words.emplace_back(word_of(law), law);
  return one_of(words);
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
