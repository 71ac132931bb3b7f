// How far rounding may take an engine that adds up terms larger than their sum. A bound, derived:
// every entry of the mass matrix and every force is off by no more than kRoundings epsilons of its
// terms, and accelerations follow by |M^-1| (|dM| |a| + |df|).
// Tested by tests/runtime/proof_test.cpp.
#pragma once

#include <Eigen/Core>

#include "runtime/engine/held.h"

namespace twincraft {

/// One term goes through some twenty roundings: the products and sums of its entry, and those of
/// the places and axes that are its factors. Each is half an epsilon at most, of either sign, so
/// together they come to two. 1000 vehicles with a ten-millionth of their mass 50 m out show 0.6 at
/// most.
inline constexpr double kRoundings = 4.0;

/// Of every entry; empty when the terms are.
Eigen::MatrixXd mass_rounding(const RoundingTerms& terms);

/// Inverse of a mass matrix, also of a vehicle whose bodies differ by many orders.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& M);

/// Of every acceleration; empty when the terms are.
/// @param M  the mass matrix  @param acceleration  at the same state
Eigen::VectorXd acceleration_rounding(const RoundingTerms& terms, const Eigen::MatrixXd& M,
                                      const Eigen::VectorXd& acceleration);

}  // namespace twincraft
