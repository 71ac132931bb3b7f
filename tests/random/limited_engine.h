// An engine that works so much and no more. An adaptive method goes on for as long as it makes any
// way; derivatives are counted instead of seconds, so that a busy machine finds nothing else.
#pragma once

#include <atomic>

#include "runtime/engine/engine.h"

namespace twincraft::random_vehicles {

class LimitedEngine : public Engine {
 public:
  LimitedEngine(Engine& engine, long most_derivatives) : engine_(engine), left_(most_derivatives) {}

  /// Set once there have been so many: for PropagateOptions::stop.
  const std::atomic<bool>& exhausted() const { return exhausted_; }

  std::string_view name() const override { return engine_.name(); }
  const StateLayout& layout() const override { return engine_.layout(); }
  std::unique_ptr<Engine> another() const override { return engine_.another(); }  // without limits
  Eigen::VectorXd initial_state() const override { return engine_.initial_state(); }
  void hold(const Inputs& inputs) override { engine_.hold(inputs); }
  void derivative(double time, std::span<const double> state, std::span<double> rate,
                  BookRates* books) override {
    if (--left_ <= 0) exhausted_ = true;
    engine_.derivative(time, state, rate, books);
  }
  void finish_step(std::span<double> state) override { engine_.finish_step(state); }
  void observe(double time, std::span<const double> state, Observation& seen) override {
    engine_.observe(time, state, seen);
  }
  Eigen::MatrixXd mass_matrix(std::span<const double> state) override {
    return engine_.mass_matrix(state);
  }

 private:
  Engine& engine_;
  long left_;
  std::atomic<bool> exhausted_ = false;
};

}  // namespace twincraft::random_vehicles
