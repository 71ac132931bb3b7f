#include "runtime/linear/linearise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

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

std::vector<Mode> decompose(const OwnMotion& motion, const Eigen::MatrixXd& A,
                            const Eigen::VectorXd& drive, double slowest) {
  if (A.rows() == 0 || !A.allFinite() || !drive.allFinite()) return {};
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  if (solver.info() != Eigen::Success) return {};
  const Eigen::MatrixXcd shapes = solver.eigenvectors();
  Eigen::VectorXcd weights = Eigen::VectorXcd::Zero(A.rows());
  if (!drive.isZero(0.0))
    weights = shapes.completeOrthogonalDecomposition().solve(drive.cast<std::complex<double>>());
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
