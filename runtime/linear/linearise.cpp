#include "runtime/linear/linearise.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/bsm/engine.h"

namespace twincraft {
namespace {

// Central differences: their error is of second order in these, rounding of first order in their
// inverse; both are far below the two digits that a rate is told to.
constexpr double kPositionStep = 1.0e-5;  // [rad] or [m]
constexpr double kRateStep = 1.0e-4;      // relative to a rate, at least 1 rad/s or 1 m/s

// Real parts this small beside the eigenvalue are rounding of the decomposition.
constexpr double kRounding = 1.0e-9;

Model in_deep_space(const Model& model) {
  Model own = model;
  own.gravity = {};
  own.engines.attitude = AttitudeChart::kQuaternion;
  return own;
}

/// Of every entry of x.
std::vector<std::string> coordinates_of(const Model& model, int joints, int wheels) {
  std::vector<std::string> names;
  const auto add_joints = [&] {
    for (int joint = 0; joint < joints; ++joint)
      names.push_back(joint_name(model, static_cast<std::size_t>(joint)));
  };
  add_joints();
  names.insert(names.end(), 3, "rotation");
  add_joints();
  for (int wheel = 0; wheel < wheels; ++wheel)
    names.push_back(wheel_name(model, static_cast<std::size_t>(wheel)));
  return names;
}

/// The entry that moves fastest: a position counts with the rate it swings at.
int leading_entry(const OwnMotion& motion, const Eigen::VectorXcd& shape, double rate) {
  int leading = 0;
  double largest = -1.0;
  for (int entry = 0; entry < motion.size(); ++entry) {
    const double speed = std::abs(shape[entry]) * (entry < motion.joints() ? rate : 1.0);
    if (speed <= largest) continue;
    largest = speed;
    leading = entry;
  }
  return leading;
}

struct Products {
  double pp, qq, pq;
};

/// Of two columns. In one walk: three sums do not wait for one another, as three walks would.
Products products_of(const Eigen::MatrixXd& B, Eigen::Index p, Eigen::Index q) {
  Products sum{0.0, 0.0, 0.0};
  for (Eigen::Index row = 0; row < B.rows(); ++row) {
    const double a = B(row, p), b = B(row, q);
    sum.pp += a * a;
    sum.qq += b * b;
    sum.pq += a * b;
  }
  return sum;
}

/// The smallest w that brings B w nearest to b. The columns of B are turned in pairs until they are
/// perpendicular (one-sided Jacobi, Hestenes 1958). Eigen's decompositions that know a rank would
/// make this the file that takes longest to compile.
Eigen::VectorXd least_solution(Eigen::MatrixXd B, const Eigen::VectorXd& b) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  constexpr int kSweeps = 30;  // it takes about six
  Eigen::MatrixXd turns = Eigen::MatrixXd::Identity(B.cols(), B.cols());
  bool is_turning = true;
  for (int sweep = 0; is_turning && sweep < kSweeps; ++sweep) {
    is_turning = false;
    for (Eigen::Index q = 1; q < B.cols(); ++q)
      for (Eigen::Index p = 0; p < q; ++p) {
        const auto [pp, qq, pq] = products_of(B, p, q);
        if (std::abs(pq) <= kEpsilon * std::sqrt(pp * qq)) continue;
        is_turning = true;
        Eigen::JacobiRotation<double> turn;
        turn.makeJacobi(pp, pq, qq);
        B.applyOnTheRight(p, q, turn);
        turns.applyOnTheRight(p, q, turn);
      }
  }
  const double rounding = kEpsilon * static_cast<double>(B.cols());
  const double smallest = rounding * B.colwise().norm().maxCoeff();
  Eigen::VectorXd w = Eigen::VectorXd::Zero(B.cols());
  for (Eigen::Index k = 0; k < B.cols(); ++k) {
    const double size = B.col(k).norm();
    if (size > smallest) w += turns.col(k) * (B.col(k).dot(b) / size / size);
  }
  return w;
}

/// The shares of the shapes in `drive`, the smallest where shapes depend on each other. Of a
/// complex pair x +- i y the columns x and y do, which keeps it in real numbers; sqrt(2) keeps
/// lengths.
Eigen::VectorXcd weights_of(const Eigen::MatrixXcd& shapes, const Eigen::VectorXd& drive) {
  constexpr double kRoot = std::numbers::sqrt2;
  const auto is_real = [&](Eigen::Index k) { return shapes.col(k).imag().isZero(0.0); };
  Eigen::MatrixXd columns = shapes.real();
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    if (is_real(k)) continue;
    columns.col(k) *= kRoot;
    columns.col(k + 1) = kRoot * shapes.col(k).imag();
    ++k;
  }
  const Eigen::VectorXd shares = least_solution(columns, drive);
  Eigen::VectorXcd weights = shares.cast<std::complex<double>>();
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    if (is_real(k)) continue;
    weights[k] = std::complex<double>(shares[k], -shares[k + 1]) / kRoot;
    weights[k + 1] = std::conj(weights[k]);
    ++k;
  }
  return weights;
}

}  // namespace

OwnMotion::OwnMotion(const Model& model)
    : feed_(model),
      engine_(make_bsm_engine(in_deep_space(model))),
      joints_(engine_->layout().joints),
      wheels_(engine_->layout().wheels),
      coordinates_(coordinates_of(model, joints_, wheels_)),
      derivative_(engine_->layout().size()) {}

int OwnMotion::state_entry(int entry) const {
  const StateLayout& layout = engine_->layout();
  if (entry < joints_) return layout.joint() + entry;
  if (entry < joints_ + 3) return layout.rate() + entry - joints_;
  return layout.joint_rate() + entry - joints_ - 3;  // joint rates, then wheels: adjacent there too
}

Eigen::VectorXd OwnMotion::reduced(double time, const Eigen::VectorXd& state) {
  const auto count = static_cast<std::size_t>(state.size());
  engine_->derivative(time, {state.data(), count}, {derivative_.data(), count});
  Eigen::VectorXd rates(size());
  for (int entry = 0; entry < size(); ++entry) rates[entry] = derivative_[state_entry(entry)];
  return rates;
}

Eigen::VectorXd OwnMotion::rates(const Observation& seen, double held_at) {
  engine_->hold(feed_.begin(held_at));
  return reduced(seen.time, pack(seen, engine_->layout()));
}

Eigen::MatrixXd OwnMotion::jacobian(const Observation& seen, double held_at) {
  engine_->hold(feed_.begin(held_at));
  Eigen::VectorXd state = pack(seen, engine_->layout());
  Eigen::MatrixXd A(size(), size());
  for (int entry = 0; entry < size(); ++entry) {
    double& value = state[state_entry(entry)];
    const double centre = value;
    const double step =
        entry < joints_ ? kPositionStep : kRateStep * std::max(1.0, std::abs(centre));
    value = centre + step;
    const Eigen::VectorXd above = reduced(seen.time, state);
    value = centre - step;
    A.col(entry) = (above - reduced(seen.time, state)) / (2.0 * step);
    value = centre;
  }
  return A;
}

std::optional<Eigen::VectorXcd> eigenvalues(const Eigen::MatrixXd& A) {
  if (!A.allFinite()) return std::nullopt;
  if (A.rows() == 0) return Eigen::VectorXcd();
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A, false);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return solver.eigenvalues();
}

std::vector<Mode> decompose(const OwnMotion& motion, const Eigen::MatrixXd& A,
                            const Eigen::VectorXd& drive, double slowest) {
  if (A.rows() == 0 || !A.allFinite() || !drive.allFinite()) return {};
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  if (solver.info() != Eigen::Success) return {};
  const Eigen::MatrixXcd shapes = solver.eigenvectors();
  Eigen::VectorXcd weights = Eigen::VectorXcd::Zero(A.rows());
  if (!drive.isZero(0.0)) weights = weights_of(shapes, drive);
  std::vector<Mode> modes;
  for (Eigen::Index k = 0; k < A.rows(); ++k) {
    std::complex<double> s = solver.eigenvalues()[k];
    if (std::abs(s) < slowest || s.imag() < 0.0) continue;
    if (std::abs(s.real()) < kRounding * std::abs(s)) s.real(0.0);
    Mode mode{s, shapes.col(k), {}, false, weights[k]};
    const int leading = leading_entry(motion, mode.shape, mode.rate());
    mode.coordinate = motion.coordinate(leading);
    mode.is_rotation = leading >= motion.rate() && leading < motion.rate() + 3;
    modes.push_back(std::move(mode));
  }
  return modes;
}

}  // namespace twincraft
