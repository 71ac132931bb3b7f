// Claims about the rates of the books that the kernel finds: those of a sweep over all links in
// plain doubles, for every kind of vehicle, force and law of gravity, with every instruction set.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/any_vehicle.h"
#include "tests/support/plain_books.h"

namespace twincraft {
namespace {

using test::span_of;

constexpr double kRounding = 1.0e-13;

void expect_same(const BookRates& found, const test::SizedRates& plain) {
  EXPECT_NEAR(found.power, plain.power, kRounding * plain.power_size);
  EXPECT_NEAR(found.own_power, plain.own_power, kRounding * plain.own_power_size);
  EXPECT_LE((found.force_N - plain.force_N).norm(), kRounding * plain.force_size);
  EXPECT_LE((found.torque_PntC_N - plain.torque_PntC_N).norm(), kRounding * plain.torque_size);
}

/// On the hub, and on the last link where it can take one: at a point, and at the centre of mass.
void push(Model& model) {
  const int last = static_cast<int>(model.assembly.links.size()) - 1;
  for (const int link : {0, last}) {
    Load at_point{"push", link, {}, {}, Vector3d(0.1, 0.2, 0.3)};
    at_point.force_L[1] = Schedule::constant(3.0);
    at_point.torque_L[2] = Schedule::constant(-2.0);
    Load at_center{"pull", link, {}, {}, {}};
    at_center.force_L[0] = Schedule::constant(-4.0);
    model.loads.insert(model.loads.end(), {at_point, at_center});
  }
}

class Books : public test::AnyVehicle {
 protected:
  static void expect_plain_books(const Model& model) {
    at_random_states<test::PlainBooks>(
        model, [](Engine& engine, test::PlainBooks& plain, double time, const Eigen::VectorXd& x) {
          BookRates books;
          test::derivative_at(engine, time, x, &books);
          expect_same(books, plain.rates(time, span_of(x)));
        });
  }
};

TEST_P(Books, AreThoseOfASweepOverAllLinks) { expect_plain_books(model_); }

TEST_P(Books, AreSoUnderEveryLawOfGravityAndUnderLoads) {
  under_every_law([](Model model) {
    expect_plain_books(model);
    push(model);
    expect_plain_books(model);
  });
}

TEST_P(Books, AreSoOnTheGeneralPathAndInQuaternions) {
  Model model = beside_an_asteroid(GravityLaw::kBodyCom);
  model.engines.chains = ChainPath::kGeneral;
  model.engines.attitude = AttitudeChart::kQuaternion;
  expect_plain_books(model);
}

TEST_P(Books, HaveTheSameBytesWhateverIsBookedWithThem) {
  const std::vector<RandomState> states = random_states(model_, 9);  // more than are booked at once
  for (const bsm::InstructionSet set : bsm::instruction_sets()) {
    const auto engine = make_bsm_engine(model_, set);
    engine->hold(inputs_at(model_, 1.0));
    std::vector<Eigen::VectorXd> x;
    std::vector<BookRates> alone(states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      x.push_back(pack(states[i], engine->layout()));
      test::derivative_at(*engine, 1.0, x[i], &alone[i]);
    }
    Eigen::VectorXd rate(x[0].size());
    for (std::size_t count = 1; count <= x.size(); ++count) {
      std::vector<BookRates> together(count);
      for (std::size_t i = 0; i < count; ++i)
        engine->derivative_to_book(
            1.0, span_of(x[i]), {rate.data(), static_cast<std::size_t>(rate.size())}, together[i]);
      engine->settle_books();
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_EQ(std::memcmp(&together[i], &alone[i], sizeof(BookRates)), 0)
            << i << " of " << count;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Books, test::kAnyVehicle, test::vehicle_name);

}  // namespace
}  // namespace twincraft
