// What an engine answers at a state, for tests that think in Eigen's vectors.
#pragma once

#include <span>

#include "runtime/compare/random_state.h"
#include "runtime/engine/engine.h"

namespace twincraft::test {

inline std::span<const double> span_of(const Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

/// @param x  a state vector of the engine's layout  @param books  null: not asked for
inline Eigen::VectorXd derivative_at(Engine& engine, double time, const Eigen::VectorXd& x,
                                     BookRates* books = nullptr) {
  Eigen::VectorXd rate(x.size());
  engine.derivative(time, span_of(x), {rate.data(), static_cast<std::size_t>(rate.size())}, books);
  return rate;
}

/// Under the inputs of the state's time: v_B, omega, joint rates and wheel rates differentiated,
/// whatever the attitude chart.
inline Eigen::VectorXd accelerations_at(const Model& model, Engine& engine,
                                        const RandomState& state, BookRates* books = nullptr) {
  const Eigen::VectorXd x = pack(state, engine.layout());
  engine.hold(inputs_at(model, state.time));
  return accelerations_of(derivative_at(engine, state.time, x, books), engine.layout());
}

}  // namespace twincraft::test
