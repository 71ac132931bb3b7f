// Claims about the scalars of the kernel beside double and lanes: duals, and what a recorder does
// with a text that chooses.
#include "runtime/scalar/scalar.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <concepts>
#include <stdexcept>

#include "runtime/bsm/charts.h"
#include "runtime/scalar/dual.h"
#include "runtime/scalar/recorder.h"
#include "runtime/scalar/tangents.h"

namespace twincraft {
namespace {

using portable::Dual;
using portable::Recorded;

static_assert(portable::KernelScalar<double> && portable::KernelScalar<Dual> &&
              portable::KernelScalar<Recorded>);
static_assert(portable::KernelScalars<double, portable::Pair>);
static_assert(!portable::KernelScalars<Dual, portable::Pair>);
static_assert(!portable::KernelScalar<int> && !portable::KernelScalar<float>);
// A text that branches on a value does not compile for a recorder.
static_assert(!std::convertible_to<decltype(Recorded() > Recorded()), bool>);
static_assert(!std::constructible_from<bool, decltype(Recorded() > Recorded())>);
static_assert(!std::constructible_from<double, Recorded>);

/// Everything that a text may do.
template <class S>
S everything(const S& x, const S& y) {
  using portable::chosen, portable::root, portable::sine_cosine;
  const auto [sine, cosine] = sine_cosine(x * y);
  S sum = sine / (S(2.0) + cosine) - root(x * x + y);
  sum += chosen(x > y, x * y, -y / x);
  sum -= S(3.0) * y;
  return sum;
}

/// Of everything() with respect to x and y.
std::array<double, 2> slopes(double x, double y) {
  const double s = std::sin(x * y), c = std::cos(x * y), r = std::sqrt(x * x + y);
  const double turn = (c * (2.0 + c) + s * s) / ((2.0 + c) * (2.0 + c));
  return {turn * y - x / r + (x > y ? y : y / (x * x)),
          turn * x - 0.5 / r + (x > y ? x : -1.0 / x) - 3.0};
}

TEST(Dual, HasTheDerivativesOfEveryOperation) {
  for (const auto& [x, y] : {std::pair{1.3, 0.7}, std::pair{0.4, 0.9}}) {
    const Dual z = everything(Dual::variable(x, 0), Dual::variable(y, 5));
    EXPECT_EQ(z.value(), everything(x, y));
    EXPECT_NEAR(z.partial(0), slopes(x, y)[0], 1e-14);  // a dozen operations
    EXPECT_NEAR(z.partial(5), slopes(x, y)[1], 1e-14);
    EXPECT_EQ(z.partial(3), 0.0);
  }
}

TEST(Tape, TakesTheSideOfAChoiceThatItsInputsAskFor) {
  Tape tape;
  const Recorded x = Recorded::input(tape), y = Recorded::input(tape);
  everything(x, y).output(tape);
  const std::array<std::size_t, 2> both{0, 1};
  Tangents tangents(tape.simplified(), both);
  for (const auto& [a, b] : {std::pair{1.3, 0.7}, std::pair{0.4, 0.9}}) {
    const std::array in{a, b};
    std::array<double, 1> out;
    tape.replay(in, out);
    EXPECT_EQ(out[0], everything(a, b));
    tape.simplified().replay(in, out);
    EXPECT_EQ(out[0], everything(a, b));
    const std::span<const double> found = tangents.at(in);
    EXPECT_NEAR(found[0], slopes(a, b)[0], 1e-14);
    EXPECT_NEAR(found[1], slopes(a, b)[1], 1e-14);
  }
}

TEST(Tape, SwitchesAChartAsTheKernelDoes) {
  Tape tape;
  std::array<Recorded, 3> sigma;
  for (Recorded& number : sigma) number = Recorded::input(tape);
  bsm::portable::Mrp<Recorded> chart(sigma.data(), 0);
  chart.make_regular();
  chart.put(sigma.data(), 0);
  for (const Recorded& number : sigma) number.output(tape);
  for (const std::array<double, 3> in : {std::array{0.1, -0.2, 0.3}, std::array{0.9, -0.8, 0.3}}) {
    std::array<double, 3> expected = in, out;
    bsm::portable::Mrp<double> other(in.data(), 0);
    other.make_regular();
    other.put(expected.data(), 0);
    tape.replay(in, out);
    EXPECT_EQ(out, expected);
  }
}

TEST(Tape, LeavesOutWhatIsNeutralTwiceOrForNothing) {
  Tape tape;
  const Recorded x = Recorded::input(tape), y = Recorded::input(tape);
  const Recorded one = 1.0, zero = 0.0;
  EXPECT_FALSE((x / y).is_constant());  // and nobody asks for it
  const Recorded sum = one * (x * y) + zero * root(x) - (zero - y * x);
  (sum / one).output(tape);
  const Tape fewer = tape.simplified();
  EXPECT_EQ(fewer.operations(), 2u);  // x y, and its double
  std::array<double, 1> out;
  fewer.replay(std::array{3.0, 5.0}, out);
  EXPECT_EQ(out[0], 30.0);
}

TEST(Tape, FoldsConstants) {
  const Recorded folded = root(Recorded(2.0)) * Recorded(3.0);
  EXPECT_TRUE(folded.is_constant());
  EXPECT_EQ(folded.constant(), std::sqrt(2.0) * 3.0);
}

TEST(Tape, DoesNotMixWithAnother) {
  Tape one, other;
  const Recorded x = Recorded::input(one), y = Recorded::input(other);
  EXPECT_THROW(x + y, std::logic_error);
  EXPECT_THROW(x.output(other), std::logic_error);
  EXPECT_THROW(one.replay({}, {}), std::logic_error);
}

TEST(Tape, IsOfVariablesThatNeverVanish) {
  Tape tape;
  EXPECT_FALSE(vanishes(Recorded::input(tape)));
  EXPECT_TRUE(vanishes(Recorded(0.0)));
  EXPECT_FALSE(vanishes(Dual::variable(0.0, 2)));
  EXPECT_TRUE(vanishes(Dual(0.0)));
}

}  // namespace
}  // namespace twincraft
