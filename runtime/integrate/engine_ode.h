// An engine as the right-hand side of a Runge-Kutta method.
#pragma once

#include "runtime/engine/engine.h"
#include "runtime/integrate/runge_kutta.h"

namespace twincraft {

class EngineOde final : public Ode {
 public:
  explicit EngineOde(Engine& engine) : engine_(engine) {}
  int size() const override { return engine_.layout().size(); }
  void derivative(double time, std::span<const double> state, std::span<double> rate) override {
    engine_.derivative(time, state, rate);
  }
  void finish_step(std::span<double> state) override { engine_.finish_step(state); }
  StageAccess access() const override { return {engine_.may_use_avx2()}; }

 private:
  Engine& engine_;
};

}  // namespace twincraft
