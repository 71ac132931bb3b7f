// Single derivative evaluations of both engines, exact Jacobians, and whole RK4 steps of many
// spacecraft side by side, one per SIMD lane, by Google Benchmark: its own options choose and
// repeat.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "runtime/bsm/engine.h"
#include "runtime/bsm/jacobian.h"
#include "runtime/bsm/kernel.h"
#include "runtime/integrate/runge_kutta.h"
#include "runtime/mujoco/engine.h"
#include "tests/bench/vehicle.h"

namespace twincraft::bench {
namespace {

struct Case {
  std::string name;
  std::string spec;
  std::vector<std::string> settings;
};

std::string paper(const std::string& name) { return TWINCRAFT_ROOT "/models/paper/" + name; }

Case flex(int segments) {
  return {fmt::format("flex_{}", segments),
          paper("flex_panels.yaml"),
          {fmt::format("panels.*.segments={}", segments)}};
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* name :
       {"orbit", "torque", "rw_panels", "orbit_compact", "orbit_extended", "variable_mass"})
    all.push_back({name, paper(name) + ".yaml", {}});
  for (const int segments : {1, 2, 4, 8, 16, 32, 64}) all.push_back(flex(segments));
  return all;
}

using MakeEngine = std::unique_ptr<Engine> (*)(const Bundle&);

std::unique_ptr<Engine> analytic(const Bundle& bundle) { return make_bsm_engine(bundle.model); }
std::unique_ptr<Engine> by_mujoco(const Bundle& bundle) {
  return make_mujoco_engine(bundle.model, bundle.text(kMjcf));
}

void evaluate(benchmark::State& loop, const Case& what, MakeEngine make) {
  const Bundle bundle = compiled(what.spec, what.settings);
  const std::unique_ptr<Engine> engine = make(bundle);
  const Eigen::VectorXd state = engine->initial_state();
  Eigen::VectorXd rate(state.size());
  const auto size = static_cast<std::size_t>(state.size());
  // What depends on time alone is computed once per time, so the time moves as in a run.
  double time = 0.0;
  for (auto _ : loop) {
    engine->derivative(time, {state.data(), size}, {rate.data(), size});
    benchmark::DoNotOptimize(rate.data());
    benchmark::ClobberMemory();
    time = time < 1.0 ? time + 1.0e-4 : 0.0;
  }
}

/// All of A and B.
void differentiate(benchmark::State& loop, const Case& what) {
  const Bundle bundle = compiled(what.spec, what.settings);
  bsm::Differentiator differentiator(bundle.model);
  const Eigen::VectorXd state = make_bsm_engine(bundle.model)->initial_state();
  bsm::Jacobian jacobian;
  double time = 0.0;
  for (auto _ : loop) {
    differentiator.differentiate(time, {state.data(), static_cast<std::size_t>(state.size())},
                                 jacobian);
    benchmark::DoNotOptimize(jacobian.A.data());
    benchmark::ClobberMemory();
    time = time < 1.0 ? time + 1.0e-4 : 0.0;
  }
}

/// The same spacecraft in every lane of one instruction set.
class Batch final : public Ode {
 public:
  Batch(const Model& model, bsm::InstructionSet set)
      : lanes_(bsm::batch_lanes(set)),
        plan_(bsm::make_plan(model.assembly, model.engines.attitude, model.gravity, model.loads)),
        held_(bsm::HeldInputs::none(model.assembly)) {
    held_.set(inputs_at(model, 0.0), model.loads);
    const std::vector<const bsm::Plan*> plans(lanes_, &plan_);
    const std::vector<const bsm::HeldInputs*> held(lanes_, &held_);
    kernel_ = bsm::make_batch_kernel(plans, set);
    kernel_->hold(held);
    const Eigen::VectorXd one = make_bsm_engine(model)->initial_state();
    initial_ = one.transpose().replicate(static_cast<Eigen::Index>(lanes_), 1).reshaped();
  }

  std::size_t lanes() const { return lanes_; }
  const Eigen::VectorXd& initial_state() const { return initial_; }

  int size() const override { return static_cast<int>(initial_.size()); }
  void derivative(double time, std::span<const double> state, std::span<double> rate) override {
    kernel_->derivative(time, state.data(), rate.data());
  }
  void finish_step(std::span<double> state) override { kernel_->finish_step(state.data()); }
  StageAccess access() const override { return {lanes_ >= 4, lanes_}; }

 private:
  std::size_t lanes_;
  bsm::Plan plan_;
  bsm::HeldInputs held_;
  std::unique_ptr<bsm::Kernel> kernel_;
  Eigen::VectorXd initial_;
};

/// spacecraft_steps: whole RK4 steps per second, all lanes together.
void step_batch(benchmark::State& loop, const Case& what, bsm::InstructionSet set) {
  const Bundle bundle = compiled(what.spec, what.settings);
  Batch batch(bundle.model, set);
  RungeKutta stepper(kRk4, batch);
  std::copy(batch.initial_state().begin(), batch.initial_state().end(), stepper.state().begin());
  const double h = bundle.model.simulation.step;
  double time = 0.0;
  for (auto _ : loop) {
    stepper.step(time, h);
    time += h;
  }
  if (!stepper.state_is_finite()) loop.SkipWithError("the state is not finite");
  loop.counters["lanes"] = static_cast<double>(batch.lanes());
  loop.counters["is_chosen"] = set == bsm::fastest_instruction_set(bsm::Use::kBatch) ? 1.0 : 0.0;
  loop.counters["spacecraft_steps"] = benchmark::Counter(
      static_cast<double>(batch.lanes()) * static_cast<double>(loop.iterations()),
      benchmark::Counter::kIsRate);
}

void register_all() {
  for (const Case& what : cases()) {
    benchmark::RegisterBenchmark(("evaluation/bsm/" + what.name).c_str(), evaluate, what, analytic);
    benchmark::RegisterBenchmark(("evaluation/mujoco/" + what.name).c_str(), evaluate, what,
                                 by_mujoco);
    benchmark::RegisterBenchmark(("jacobian/" + what.name).c_str(), differentiate, what);
  }
  for (const bsm::InstructionSet set : bsm::instruction_sets()) {
    for (const int segments : {1, 2, 4, 8, 16, 32}) {
      const Case what = flex(segments);
      const std::string name = fmt::format("batch/{}/{}", name_of(set), what.name);
      benchmark::RegisterBenchmark(name.c_str(), step_batch, what, set);
    }
  }
}

}  // namespace
}  // namespace twincraft::bench

int main(int argc, char** argv) {
  twincraft::bench::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
