// Both engines of one model in lock step, and how far they are apart so far.
// Tested by tests/api/twin_test.cpp.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "runtime/api/simulation.h"
#include "runtime/compare/agreement.h"

namespace twincraft::api {

class Twin {
 public:
  /// At t = 0. @param lead  the engine that run_until()'s callers look at
  Twin(std::shared_ptr<const CompiledModel> model, EngineKind lead);
  /// Goes on from the same instant, and from the same comparison.
  Twin(const Twin& other);
  Twin& operator=(const Twin&) = delete;

  const CompiledModel& model() const { return of(lead_).model(); }
  EngineKind lead_kind() const { return lead_; }
  Simulation& of(EngineKind engine) { return *engines_[static_cast<std::size_t>(engine)]; }
  const Simulation& of(EngineKind engine) const {
    return *engines_[static_cast<std::size_t>(engine)];
  }
  Simulation& lead() { return of(lead_); }

  double time() const { return of(lead_).time(); }
  double next_landing() const;
  double tolerance() const { return of(lead_).tolerance(); }

  /// In both.
  void drive(std::size_t first, std::span<const double> values);
  void release(std::size_t input);

  /// As a simulation's; both stand at the same step end after a fault.
  void step(std::size_t count, const Poll& poll = {});
  void advance_to(double time, const Poll& poll = {});

  std::string snapshot() const;
  /// Comparison begins anew with it.
  void restore(std::string_view bytes);
  void reset();

  /// Of all step ends so far.
  Comparison disagreement() const { return meter_.result(true); }
  /// Every metric's last value, in the order of disagreement().
  const std::vector<double>& now() const { return meter_.now(); }

 private:
  void land(double time);
  void compare_anew();
  void see() { meter_.take(of(EngineKind::kBsm).observe(), of(EngineKind::kMujoco).observe()); }

  EngineKind lead_;
  std::array<std::unique_ptr<Simulation>, 2> engines_;
  AgreementMeter meter_;
};

}  // namespace twincraft::api
