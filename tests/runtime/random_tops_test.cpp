// Euler's top in closed form against an integration with 32 digits, over random tops of which half
// are drawn where formulas of this kind fail: rates with zeros, symmetric and nearly symmetric
// bodies, and the neighbourhood of the separatrix.
//
// What the bounds rest on. Both start from the same doubles, so nothing is lost to their rounding.
// The closed form keeps its constants with 50 digits and the rest with 19, of which an angle up to
// 40 (a period of a top at 1e-14 from the separatrix) leaves 1e-16 deg; a double holds an attitude
// to 3e-14 deg. The integration errs by some 1e-30 a step, which the way past the middle axis blows
// up by the inverse of the distance from the separatrix, at most 1e14, at every passage: 1e-13 deg
// after the dozens of passages flown here.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

#include "compiler/ir/angle.h"
#include "runtime/reference/torque_free.h"
#include "tests/runtime/precise_top.h"

namespace twincraft {
namespace {

constexpr double kAttitude = 1.0e-10;  // [deg]
constexpr double kRate = 1.0e-13;      // [rad/s], of rates of about 1

struct Tumble {
  Vector3d moments, omega;
  double duration = 48.0;  // [s]
};

class Tops {
 public:
  explicit Tops(unsigned seed) : generator_(seed) {}

  /// Every other one is plain.
  Tumble draw() {
    const int kind = count_++ % 8;
    Tumble top = plain();
    if (kind == 1) top.omega[axis()] = 0.0;
    if (kind == 3) symmetric(top);
    if (kind == 5 || kind == 7) near_separatrix(top);
    if (kind == 3 && axis() == 0) top.omega[axis()] = 0.0;
    if (kind == 1 && axis() == 0) top.omega[axis()] = 0.0;
    if (kind == 5 && axis() == 0) std::swap(top.moments[0], top.moments[2]);
    return top;
  }

  Quaterniond attitude() {
    return Quaterniond(Eigen::Vector4d(any(), any(), any(), any()).normalized());
  }

 private:
  double any() { return std::uniform_real_distribution(-1.0, 1.0)(generator_); }
  Eigen::Index axis() { return std::uniform_int_distribution<Eigen::Index>(0, 2)(generator_); }
  /// From 10^least to 1, evenly in the exponent.
  double small(double least) { return std::pow(10.0, 0.5 * least * (1.0 + any())); }

  /// Moments of three masses on the axes: any that a body can have, over two decades.
  Tumble plain() {
    const Vector3d masses(std::exp(3.0 * any()), std::exp(3.0 * any()), std::exp(3.0 * any()));
    return of_masses(masses, Vector3d(any(), any(), any()).normalized());
  }

  static Tumble of_masses(const Vector3d& masses, const Vector3d& omega) {
    return {masses.sum() * Vector3d::Ones() - masses, omega};
  }

  /// Two moments alike, or three, exactly or nearly. Three may not be farther apart than by half of
  /// one, else they are no body's, and PreciseTop's series do not converge.
  void symmetric(Tumble& top) {
    const double off = axis() == 0 ? 0.0 : 0.5 * small(-15.0);
    const Eigen::Index first = axis();
    top.moments[(first + 1) % 3] = top.moments[first] * (1.0 + off);
    const bool is_ball = axis() == 0 || !is_physical(top.moments);
    if (is_ball) top.moments[(first + 2) % 3] = top.moments[first] * (1.0 - off);
  }

  static bool is_physical(const Vector3d& moments) {
    return 2.0 * moments.maxCoeff() <= moments.sum();
  }

  /// On either side of I1 (I2 - I1) w1^2 = I3 (I3 - I2) w3^2, down to 1e-14 of it.
  void near_separatrix(Tumble& top) {
    std::array<Eigen::Index, 3> order{0, 1, 2};
    Vector3d& I = top.moments;
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return I[a] < I[b]; });
    const auto [least, middle, most] = order;
    const double off = (any() < 0.0 ? -1.0 : 1.0) * 0.1 * small(-13.0);
    const double ratio = I[most] * (I[most] - I[middle]) / (I[least] * (I[middle] - I[least]));
    top.omega[least] = top.omega[most] * std::sqrt(ratio * (1.0 + off));
    top.omega.normalize();
    top.duration = 160.0;
  }

  std::mt19937_64 generator_;
  int count_ = 0;
};

/// The largest error at a dozen and more times of the tumble.
void expect_exact(const Tumble& tumble, const Quaterniond& q) {
  const EulerTop top(tumble.moments.asDiagonal(), tumble.omega, q);
  test::PreciseTop truth(tumble.moments, tumble.omega, q);
  double attitude = 0.0, rate = 0.0;
  for (double time = 0.0; time <= tumble.duration; time += 4.0) {
    const EulerTop::State found = top.at(time);
    attitude = std::max(attitude, kDegrees * principal_angle(found.q_BN, truth.q()));
    rate = std::max(rate, (found.omega_BN_B - truth.omega()).norm());
    ASSERT_FALSE(std::isnan(kDegrees * principal_angle(found.q_BN, truth.q())));
    truth.advance(4.0);
  }
  EXPECT_LE(attitude, kAttitude);
  EXPECT_LE(rate, kRate);
}

void expect_exact_tops(int number, unsigned seed) {
  Tops tops(seed);
  for (int i = 0; i < number; ++i) {
    const Tumble tumble = tops.draw();
    SCOPED_TRACE(testing::Message() << "top " << i << ": inertia " << tumble.moments.transpose()
                                    << ", rate " << tumble.omega.transpose());
    expect_exact(tumble, tops.attitude());
    if (testing::Test::HasFailure()) return;
  }
}

#ifdef TWINCRAFT_SANITIZED
constexpr int kTops = 8;  // one of each kind: the rest is the same code for longer
#else
constexpr int kTops = 120;
#endif
TEST(RandomTops, AreExact) { expect_exact_tops(kTops, 1); }

class Thousand : public testing::TestWithParam<unsigned> {};
/// One thousand in the gate; all ten, some ten minutes of processor time, when asked for.
unsigned last_seed() { return std::getenv("TWINCRAFT_ALL_TOPS") != nullptr ? 12U : 3U; }
INSTANTIATE_TEST_SUITE_P(LongRandomTops, Thousand, testing::Range(2U, last_seed()));
TEST_P(Thousand, AreExact) { expect_exact_tops(1000, GetParam()); }

TEST(Tops, AreExactWhereTheyWereWrong) {
  expect_exact({{10, 12, 15}, {0, 0.1, 0.02}, 240.0}, Quaterniond::Identity());
  expect_exact({{3, 5, 7}, {0.458257569495584, 0.4, 0.3}, 80.0}, Quaterniond::Identity());
}

TEST(Tops, AreExactOnTheSeparatrixItself) {
  // 3 (4 - 3) w1^2 = 6 (6 - 4) w3^2 to the last bit.
  for (const double sign : {-1.0, 1.0})
    expect_exact({{3, 4, 6}, {0.25, 0.5 * sign, 0.125}, 100.0}, Quaterniond::Identity());
  const EulerTop top(Vector3d(3, 4, 6).asDiagonal(), {0.25, 0.5, 0.125}, Quaterniond::Identity());
  // For ever on the middle axis, towards which it went: there 2 T = I2 w2^2.
  const double rest = std::sqrt((3.0 * 0.0625 + 4.0 * 0.25 + 6.0 * 0.015625) / 4.0);
  for (const double time : {1.0e3, 1.0e6, 1.0e9}) {
    EXPECT_NEAR(std::abs(top.at(time).omega_BN_B.y()), rest, 1.0e-15) << time;
    EXPECT_LT(std::abs(top.at(time).omega_BN_B.x()), 1.0e-15) << time;
    EXPECT_NEAR(top.at(time).q_BN.norm(), 1.0, 1.0e-15) << time;
  }
}

TEST(Tops, AreExactWithRatesSmallerThanTheirRounding) {
  for (const double least : {1.0e-300, 1.0e-30, 1.0e-17, 1.0e-9})
    for (Eigen::Index small = 0; small < 3; ++small)
      for (Eigen::Index large = 0; large < 3; ++large) {
        Vector3d omega = Vector3d::Constant(least);
        omega[large] = 0.5;
        omega[small] = -least;
        expect_exact({{3, 4, 6}, omega, 40.0}, Quaterniond::Identity());
      }
}

}  // namespace
}  // namespace twincraft
