// Twincraft in C++17: a spec becomes a Model, and a Model flies as a Simulation (one engine), a
// Twin (both, in lock step), a Batch (many), or as the Run of `scsim`. Header-only over
// twincraft.h, the stable interface; needs nothing but the standard library.
//
//   const auto model = twincraft::Model::load("models/quickstart.yaml");
//   twincraft::Simulation sim(model);
//   sim.drive("rw_x.torque", 0.01);
//   sim.run_until(60.0);
//   const std::vector<double> y = sim.observe();
//
// Numbers are SI and radians; names are those of the CSV's columns. What can go wrong is an
// exception derived from Error; the object is then as it was before. A Model may be shared by
// threads; every other object serves one thread at a time and refuses a second with BusyError.
#ifndef TWINCRAFT_SIMULATION_H
#define TWINCRAFT_SIMULATION_H

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../twincraft.h"
#include "campaign.h"
#include "error.h"
#include "model.h"

namespace twincraft {
namespace detail {

/// @param failure  tells time and coordinate of a numerical failure
template <class Handle>
void check(tc_status status, const Handle* handle, const char* (*error)(const Handle*),
           tc_status (*failure)(const Handle*, double*, const char**)) {
  if (status == TC_NUMERICAL) {
    double time = 0.0;
    const char* coordinate = "";
    failure(handle, &time, &coordinate);
    throw NumericalFailure(error(handle), time, coordinate);
  }
  check(status, error(handle));
}

/// A control whose callbacks are function objects; what they throw waits in `thrown`.
struct Callbacks {
  std::function<void(double)> controller;
  std::function<bool(double)> stop;
  std::exception_ptr thrown;

  tc_control control(double every) {
    tc_control c{};
    c.size = sizeof c;
    c.every = every;
    c.context = this;
    if (controller)
      c.controller = [](void* self, double time, const double*, double*) {
        Callbacks& callbacks = *static_cast<Callbacks*>(self);
        try {
          callbacks.controller(time);
          return 0;
        } catch (...) {
          callbacks.thrown = std::current_exception();
          return 1;
        }
      };
    if (stop)
      c.stop = [](void* self, double time, const double*) {
        Callbacks& callbacks = *static_cast<Callbacks*>(self);
        try {
          return callbacks.stop(time) ? 1 : 0;
        } catch (...) {
          callbacks.thrown = std::current_exception();
          return 1;
        }
      };
    return c;
  }
  void rethrow() {
    if (thrown) std::rethrow_exception(thrown);
  }
};

/// run_until of a simulation and of a twin. What a callback threw comes before what `check` throws.
template <class Handle, class Check>
double run_until(tc_status (*run)(Handle*, double, const tc_control*, double*), Handle* handle,
                 double time, double every, Callbacks callbacks, const Check& check) {
  const tc_control control = callbacks.control(every);
  double reached = 0.0;
  const tc_status status = run(handle, time, &control, &reached);
  callbacks.rethrow();
  check(status);
  return reached;
}

template <class Snapshot>
std::vector<std::uint8_t> bytes_of(const Snapshot& snapshot) {
  std::size_t size = 0;
  snapshot(nullptr, 0, &size);
  std::vector<std::uint8_t> bytes(size);
  snapshot(bytes.data(), bytes.size(), &size);
  return bytes;
}

}  // namespace detail

/// One engine of a model on its way, from t = 0. It has no end.
class Simulation {
 public:
  explicit Simulation(const Model& model, Engine engine = Engine::bsm) : model_(model) {
    tc_simulation* handle = nullptr;
    const tc_status status =
        tc_simulation_new(model.handle(), static_cast<tc_engine>(engine), &handle);
    simulation_.reset(handle, tc_simulation_free);
    check(status);
  }
  /// Goes on from the same instant to the same bytes.
  Simulation(const Simulation& other) : model_(other.model_) {
    tc_simulation* handle = nullptr;
    const tc_status status = tc_simulation_copy(other.handle(), &handle);
    simulation_.reset(handle, tc_simulation_free);
    other.check(status);
  }
  Simulation(Simulation&&) = default;
  Simulation& operator=(Simulation&&) = default;

  const Model& model() const { return model_; }
  double time() const { return tc_simulation_time(handle()); }  // [s]
  /// In the order of the model's states.
  std::vector<double> state() const { return read(tc_simulation_state, TC_STATES); }
  /// In the order of the model's outputs.
  std::vector<double> observe() const { return read(tc_simulation_observe, TC_OUTPUTS); }
  /// What acts, in the order of the model's inputs.
  std::vector<double> inputs() const { return read(tc_simulation_inputs, TC_INPUTS); }
  void read_state(double* to, std::size_t n) const { check(tc_simulation_state(handle(), to, n)); }
  void read_outputs(double* to, std::size_t n) const {
    check(tc_simulation_observe(handle(), to, n));
  }
  void read_inputs(double* to, std::size_t n) const {
    check(tc_simulation_inputs(handle(), to, n));
  }
  /// What rounding left over of earlier steps is dropped.
  void set_state(const std::vector<double>& state) {
    check(tc_simulation_set_state(handle(), state.data(), state.size()));
  }

  /// Hold an input at a value from now on, in place of its schedule.
  void drive(std::size_t input, double value) {
    check(tc_simulation_drive(handle(), input, value));
  }
  void drive(std::size_t first, const double* values, std::size_t count) {
    check(tc_simulation_drive_many(handle(), first, values, count));
  }
  void drive(const std::string& name, double value) { drive(one(name), value); }
  /// With a unit: `10 mN m`.
  void drive(const std::string& name, const std::string& value) { drive_text(one(name), value); }
  void drive_text(std::size_t input, const std::string& value) {
    check(tc_simulation_drive_text(handle(), input, value.c_str()));
  }
  /// Give it back to its schedule.
  void release(std::size_t input) { check(tc_simulation_release(handle(), input)); }
  void release(const std::string& name) {
    const Range range = model_.find(TC_INPUTS, name);
    for (std::size_t i = 0; i < range.count; ++i) release(range.first + i);
  }

  /// To the `count`-th next point of the grid k * step.
  void step(std::size_t count = 1) { check(tc_simulation_step(handle(), count)); }
  /// To exactly `time` [s].
  double run_until(double time) {
    double reached = 0.0;
    check(tc_simulation_run_until(handle(), time, nullptr, &reached));
    return reached;
  }
  /// The same, calling at every tick start + k * every, the end left out, `stop` and then
  /// `controller`, and at the end `stop` alone: each with the time; they may ask and drive this
  /// simulation. What they throw comes through. @param every  [s]; 0: every step end
  double run_until(double time, double every, std::function<void(double)> controller,
                   std::function<bool(double)> stop = {}) {
    return detail::run_until(tc_simulation_run_until, handle(), time, every,
                             {std::move(controller), std::move(stop), nullptr},
                             [this](tc_status status) { check(status); });
  }

  std::vector<std::uint8_t> snapshot() const {
    return detail::bytes_of([this](void* bytes, std::size_t capacity, std::size_t* size) {
      check(tc_simulation_snapshot(handle(), bytes, capacity, size));
    });
  }
  /// @throws SnapshotError
  void restore(const std::vector<std::uint8_t>& bytes) { restore(bytes.data(), bytes.size()); }
  void restore(const void* bytes, std::size_t size) {
    check(tc_simulation_restore(handle(), bytes, size));
  }
  /// As just made.
  void reset() { check(tc_simulation_reset(handle())); }

  tc_simulation* handle() const { return simulation_.get(); }

 private:
  friend class Twin;
  /// A twin's, which stays as long as this does.
  Simulation(const Model& model, std::shared_ptr<tc_simulation> of_a_twin)
      : model_(model), simulation_(std::move(of_a_twin)) {}

  std::size_t one(const std::string& name) const {
    const Range range = model_.find(TC_INPUTS, name);
    if (range.count != 1) throw UsageError("`" + name + "` is a vector: it takes 3 numbers");
    return range.first;
  }
  std::vector<double> read(tc_status (*from)(tc_simulation*, double*, std::size_t),
                           tc_signals which) const {
    std::vector<double> numbers(model_.count(which));
    check(from(handle(), numbers.data(), numbers.size()));
    return numbers;
  }
  void check(tc_status status) const {
    detail::check(status, handle(), tc_simulation_error, tc_simulation_failure);
  }

  Model model_;
  std::shared_ptr<tc_simulation> simulation_;
};

/// Both engines in lock step.
class Twin {
 public:
  /// @param lead  whose outputs controllers see
  explicit Twin(const Model& model, Engine lead = Engine::bsm) : model_(model) {
    tc_twin* handle = nullptr;
    const tc_status status = tc_twin_new(model.handle(), static_cast<tc_engine>(lead), &handle);
    twin_.reset(handle, tc_twin_free);
    check(status);
  }
  Twin(const Twin& other) : model_(other.model_) {
    tc_twin* handle = nullptr;
    const tc_status status = tc_twin_copy(other.handle(), &handle);
    twin_.reset(handle, tc_twin_free);
    other.check(status);
  }
  Twin(Twin&&) = default;
  Twin& operator=(Twin&&) = default;

  const Model& model() const { return model_; }
  double time() const { return tc_twin_time(handle()); }
  /// One of the two, to be asked and driven; the twin moves it.
  Simulation simulation(Engine engine) const {
    return {model_, std::shared_ptr<tc_simulation>(
                        twin_, tc_twin_simulation(handle(), static_cast<tc_engine>(engine)))};
  }

  void drive(std::size_t input, double value) { drive(input, &value, 1); }
  void drive(std::size_t first, const double* values, std::size_t count) {
    check(tc_twin_drive_many(handle(), first, values, count));
  }
  void drive_text(std::size_t input, const std::string& value) {
    check(tc_twin_drive_text(handle(), input, value.c_str()));
  }
  void release(std::size_t input) { check(tc_twin_release(handle(), input)); }
  void step(std::size_t count = 1) { check(tc_twin_step(handle(), count)); }
  double run_until(double time) {
    double reached = 0.0;
    check(tc_twin_run_until(handle(), time, nullptr, &reached));
    return reached;
  }
  /// As a simulation's.
  double run_until(double time, double every, std::function<void(double)> controller,
                   std::function<bool(double)> stop = {}) {
    return detail::run_until(tc_twin_run_until, handle(), time, every,
                             {std::move(controller), std::move(stop), nullptr},
                             [this](tc_status status) { check(status); });
  }

  /// The same with a controller for each engine, which sees its outputs and drives it alone.
  double run_each_until(double time, double every, std::function<void(double)> bsm,
                        std::function<void(double)> mujoco, std::function<bool(double)> stop = {}) {
    detail::Callbacks first{std::move(bsm), std::move(stop), nullptr};
    detail::Callbacks second{std::move(mujoco), {}, nullptr};
    const tc_control controls[] = {first.control(every), second.control(every)};
    double reached = 0.0;
    const tc_status status =
        tc_twin_run_each_until(handle(), time, &controls[0], &controls[1], &reached);
    first.rethrow();
    second.rethrow();
    check(status);
    return reached;
  }

  std::vector<std::uint8_t> snapshot() const {
    return detail::bytes_of([this](void* bytes, std::size_t capacity, std::size_t* size) {
      check(tc_twin_snapshot(handle(), bytes, capacity, size));
    });
  }
  void restore(const void* bytes, std::size_t size) {
    check(tc_twin_restore(handle(), bytes, size));
  }
  void reset() { check(tc_twin_reset(handle())); }
  /// `agreement` of report.json so far, with `now` beside `max`, as JSON.
  std::string disagreement() const { return tc_twin_disagreement(handle()); }

  tc_twin* handle() const { return twin_.get(); }

 private:
  void check(tc_status status) const {
    detail::check(status, handle(), tc_twin_error, tc_twin_failure);
  }

  Model model_;
  std::shared_ptr<tc_twin> twin_;
};

/// Many spacecraft of one model, by the analytic engine.
class Batch {
 public:
  /// @param threads  0: all cores; the same bytes for any number
  Batch(const Model& model, std::size_t count, std::size_t threads = 0) : model_(model) {
    tc_batch* handle = nullptr;
    const tc_status status = tc_batch_new(model.handle(), count, threads, &handle);
    batch_.reset(handle);
    check(status);
  }

  const Model& model() const { return model_; }
  std::size_t count() const { return tc_batch_count(handle()); }
  double time() const { return tc_batch_time(handle()); }
  /// A row per member.
  std::vector<double> states() const { return read(tc_batch_states, TC_STATES); }
  std::vector<double> outputs() const { return read(tc_batch_outputs, TC_OUTPUTS); }
  std::vector<double> inputs() const { return read(tc_batch_inputs, TC_INPUTS); }
  /// One row serves all members.
  void set_states(const double* rows, std::size_t size) {
    check(tc_batch_set_states(handle(), rows, size));
  }
  void drive(const double* rows, std::size_t size) { check(tc_batch_drive(handle(), rows, size)); }
  void release() { check(tc_batch_release(handle())); }
  void step(std::size_t count = 1) { check(tc_batch_step(handle(), count)); }
  /// 0, or TC_NUMERICAL of a member that has failed.
  std::vector<std::int32_t> status() const {
    std::vector<std::int32_t> all(count());
    check(tc_batch_status(handle(), all.data(), all.size()));
    return all;
  }
  std::string reason(std::size_t member) const { return tc_batch_reason(handle(), member); }

  tc_batch* handle() const { return batch_.get(); }

 private:
  std::vector<double> read(tc_status (*from)(tc_batch*, double*, std::size_t),
                           tc_signals which) const {
    std::vector<double> rows(count() * model_.count(which));
    check(from(handle(), rows.data(), rows.size()));
    return rows;
  }
  void check(tc_status status) const { detail::check(status, tc_batch_error(handle())); }

  Model model_;
  detail::Owned<tc_batch, tc_batch_free> batch_;
};

}  // namespace twincraft

#endif
