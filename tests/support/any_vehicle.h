// What the analytic engine finds of a vehicle beside its derivative, held against plain sums: for
// every kind of vehicle, with every instruction set, at random states.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "runtime/bsm/engine.h"
#include "tests/support/asked.h"
#include "tests/support/compiled.h"

namespace twincraft::test {

class AnyVehicle : public testing::TestWithParam<const char*> {
 protected:
  /// @tparam Plain  made of the model, and told the same inputs
  /// @param expect  takes both, a time [s] and a state vector
  template <class Plain, class Expect>
  static void at_random_states(const Model& model, const Expect& expect) {
    Plain plain(model);
    for (const bsm::InstructionSet set : bsm::instruction_sets()) {
      const auto engine = make_bsm_engine(model, set);
      for (const RandomState& state : random_states(model, 20)) {
        const Inputs inputs = inputs_at(model, state.time);
        engine->hold(inputs);
        plain.hold(inputs);
        expect(*engine, plain, state.time, pack(state, engine->layout()));
      }
    }
  }

  /// So near a small body that links metres apart feel very different gravity.
  Model beside_an_asteroid(GravityLaw law) const {
    Model model = model_;
    model.gravity = {5.0e4, law, law};
    model.initial.r_BN_N = {60.0, -20.0, 30.0};
    model.initial.v_BN_N = {-3.0, 20.0, 5.0};
    return model;
  }
  template <class Check>
  void under_every_law(const Check& check) const {
    for (const GravityLaw law : {GravityLaw::kNone, GravityLaw::kSystemCom, GravityLaw::kBodyCom,
                                 GravityLaw::kBodyGradient}) {
      SCOPED_TRACE(testing::Message() << "law " << static_cast<int>(law));
      check(beside_an_asteroid(law));
    }
  }

  const Model model_ =
      compiled_file("tests/components/vehicles/" + std::string(GetParam()) + ".yaml").model;
};

inline const auto kAnyVehicle =
    testing::Values("hub", "wheel", "panel", "chain", "damped", "gravity", "arm", "arm_in_orbit",
                    "flex_as_bodies", "particle", "pendulum", "bob", "burn", "swarm", "jet");
inline std::string vehicle_name(const testing::TestParamInfo<const char*>& info) {
  return info.param;
}

}  // namespace twincraft::test
