// The difference of two trajectories with its direction, sample by sample. A maximum says how far
// two engines are apart; a direction says whether two causes push the same way, so that a
// difference can be divided among them. Tested by tests/runtime/attribution_test.cpp.
#pragma once

#include <vector>

#include "runtime/simulate/propagate.h"

namespace twincraft {

struct ErrorSeries {
  std::vector<double> time;     // [s] ascending
  std::vector<Vector3d> value;  // in N components

  double maximum() const;  // largest Euclidean norm; NaN when a sample is
};

/// The rotation from the hub attitude of `a` to that of `b`, as angle times axis [rad], at the
/// times both were sampled.
ErrorSeries attitude_error(const Trajectory& a, const Trajectory& b);

/// From the system centre of mass of `a` to that of `b` [m], likewise.
ErrorSeries position_error(const Trajectory& a, const Trajectory& b);

/// Of one entry of the joint vector [rad] or [m], likewise; along x, as it has no direction.
ErrorSeries joint_error(std::size_t joint, const Trajectory& a, const Trajectory& b);

/// x - y at the times both have.
ErrorSeries difference(const ErrorSeries& x, const ErrorSeries& y);

/// How much of `whole` is gone in `without`: sum of (whole - without) . whole over sum of
/// whole . whole, at the times both have. Shares of causes that add up add up to one; what
/// `without` has across `whole` does not count. 0 when there is no whole.
double share(const ErrorSeries& whole, const ErrorSeries& without);

/// Least-squares slope of log y over log x. @pre at least two, all positive
double log_slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace twincraft
