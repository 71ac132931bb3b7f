// Claims about every engine: a derivative leaves nothing that a later call can see, and engines of
// one model do not disturb one another.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>

#include "runtime/bsm/engine.h"
#include "runtime/mujoco/engine.h"
#include "runtime/simulate/propagate.h"
#include "tests/support/asked.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

using test::span_of;
using Numbers = std::vector<double>;

/// MuJoCo, and the analytic engine with each instruction set of this processor.
std::vector<std::unique_ptr<Engine>> engines_of(const Bundle& bundle) {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(make_mujoco_engine(bundle.model, bundle.text(kMjcf)));
  for (const bsm::InstructionSet set : bsm::instruction_sets())
    engines.push_back(make_bsm_engine(bundle.model, set));
  return engines;
}

Numbers numbers_of(const BookRates& books) {
  Numbers all{books.power, books.own_power};
  for (const Vector3d& v : {books.force_N, books.torque_PntC_N})
    all.insert(all.end(), v.begin(), v.end());
  return all;
}

/// What an engine is asked at one time and state.
struct Question {
  double time = 0.0;  // [s]
  Eigen::VectorXd state;
  Numbers rate, books;  // first answers

  Numbers ask(Engine& engine, BookRates* rates) const {
    Numbers answer(static_cast<std::size_t>(state.size()));
    engine.derivative(time, span_of(state), answer, rates);
    return answer;
  }
};

/// Under inputs that are held since one time, evaluated at others.
std::vector<Question> questions_for(Engine& engine, const Model& model) {
  std::vector<Question> questions;
  for (const RandomState& state : random_states(model, 20)) {
    Question question{state.time, pack(state, engine.layout()), {}, {}};
    BookRates books;
    question.rate = question.ask(engine, &books);
    question.books = numbers_of(books);
    questions.push_back(std::move(question));
  }
  return questions;
}

void expect_first_answers(Engine& engine, const std::vector<Question>& questions, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < 3 * questions.size(); ++i) order.push_back(i % questions.size());
  std::shuffle(order.begin(), order.end(), random);
  for (const std::size_t i : order) {
    const Question& question = questions[i];
    BookRates books;
    const bool with_books = random() % 2 == 0;
    EXPECT_EQ(question.ask(engine, with_books ? &books : nullptr), question.rate) << engine.name();
    EXPECT_EQ(numbers_of(books), with_books ? question.books : numbers_of({})) << engine.name();
    // Nor do these.
    if (random() % 3 == 0) engine.observe(question.time, span_of(question.state));
    if (random() % 3 == 0) engine.mass_matrix(span_of(question.state));
  }
}

class Engines : public testing::TestWithParam<const char*> {
 protected:
  const Bundle bundle_ = test::compiled_file(GetParam());
};

TEST_P(Engines, LeaveNothingInADerivativeThatALaterCallCanSee) {
  const double since = 0.25 * bundle_.model.simulation.duration;
  for (const auto& engine : engines_of(bundle_)) {
    engine->hold(inputs_at(bundle_.model, since));
    const Eigen::VectorXd initial = engine->initial_state();
    const Eigen::MatrixXd mass = engine->mass_matrix(span_of(initial));
    expect_first_answers(*engine, questions_for(*engine, bundle_.model), 1);
    EXPECT_EQ(engine->mass_matrix(span_of(initial)), mass) << engine->name();
  }
}

TEST_P(Engines, HaveOthersThatGiveTheSameBytes) {
  for (const auto& engine : engines_of(bundle_)) {
    const std::vector<Question> questions = questions_for(*engine, bundle_.model);
    engine->hold(inputs_at(bundle_.model, bundle_.model.simulation.duration));
    const auto other = engine->another();  // as newly built, not as this one
    EXPECT_EQ(other->name(), engine->name());
    EXPECT_EQ(other->initial_state(), engine->initial_state());
    expect_first_answers(*other, questions, 2);
  }
}

TEST_P(Engines, DoNotDisturbOneAnother) {
  for (const auto& engine : engines_of(bundle_)) {
    const auto other = engine->another();
    const auto idle = other->another();
    const std::vector<Question> questions = questions_for(*idle, bundle_.model);
    const auto end_of = [this](Engine& flown) {
      const Observation end = propagate(flown, bundle_.model).samples.back();
      Numbers numbers{end.kinetic, end.potential, end.mass};
      for (const Vector3d& v : {end.r_BN_N, end.v_BN_N, end.omega_BN_B, end.H_PntC_N})
        numbers.insert(numbers.end(), v.begin(), v.end());
      return numbers;
    };
    Numbers ends[2];
    std::thread beside([&] { ends[1] = end_of(*other); });
    ends[0] = end_of(*engine);
    beside.join();
    EXPECT_EQ(ends[0], ends[1]) << engine->name();
    expect_first_answers(*idle, questions, 3);
  }
}

/// The state after a flight of bare steps.
Eigen::ArrayXd end_of(const Bundle& bundle, bsm::InstructionSet set) {
  const auto engine = make_bsm_engine(bundle.model, set);
  Flight flight(*engine, bundle.model, {});
  flight.advance_to(bundle.model.simulation.duration);
  const std::span<const double> state = flight.state();
  return Eigen::Map<const Eigen::ArrayXd>(state.data(), static_cast<Eigen::Index>(state.size()));
}

// A fused product and sum rounds once. docs/outputs.md promises the bound: of a number, or of one
// in its unit where that is more, after 1000 steps.
TEST(InstructionSets, FlyTheSameTrajectoryAndRepeatTheirBytes) {
  for (const char* file : {"models/paper/rw_panels.yaml", "models/paper/variable_mass.yaml",
                           "models/paper/orbit_extended.yaml", "models/paper/flex_panels.yaml",
                           "models/gallery/branched_arm.yaml"}) {
    Bundle bundle = test::compiled_file(file);
    bundle.model.simulation.method = Method::kRk4;
    bundle.model.simulation.duration = 1000 * bundle.model.simulation.step;
    const Eigen::ArrayXd portable = end_of(bundle, bsm::InstructionSet::kPortable);
    for (const bsm::InstructionSet set : bsm::instruction_sets()) {
      const Eigen::ArrayXd end = end_of(bundle, set);
      EXPECT_LT(((end - portable).abs() / portable.abs().max(1.0)).maxCoeff(), 1e-14)
          << file << ", " << name_of(set);
      EXPECT_TRUE((end == end_of(bundle, set)).all()) << file << ", " << name_of(set);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Engines,
                         testing::Values("tests/components/vehicles/burn.yaml",
                                         "tests/components/vehicles/jet.yaml",
                                         "tests/components/vehicles/arm_in_orbit.yaml",
                                         "tests/components/vehicles/wheel.yaml",
                                         "models/paper/orbit.yaml"));

}  // namespace
}  // namespace twincraft
