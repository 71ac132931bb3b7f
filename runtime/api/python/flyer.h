// What a Simulation and a Twin have in common in Python: they stand at an instant, are observed,
// driven and moved. The fast paths are here; Python's lock is let go of where a move takes longer
// than that costs.
#pragma once

#include <nanobind/nanobind.h>
#include <twincraft/simulation.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/api/python/model.h"

namespace twincraft::python {

class Flyer {
 public:
  explicit Flyer(nb::object model);
  virtual ~Flyer() = default;

  const nb::object& model() const { return model_; }
  const CompiledModel& compiled() const { return *compiled_; }

  double time() const;
  nb::object state() const;
  nb::object observe() const;
  /// Of a name: what acts now.
  nb::object input(nb::handle name) const;
  nb::object inputs() const;
  void set_input(nb::handle name, nb::handle value);
  /// All, or none.
  void set_inputs(nb::handle mapping);
  void release_input(nb::handle name);

  void step(nb::handle count);
  double run_until(double time, nb::handle every, nb::handle controller, nb::handle stop);
  nb::bytes snapshot() const;
  void restore(const nb::bytes& bytes);
  void reset();

 protected:
  using Controller = std::function<void(double)>;
  using Stop = std::function<bool(double)>;
  /// Whose inputs and outputs are read.
  virtual tc_simulation* seen() const = 0;
  virtual double step_cost() const = 0;  // [us]
  virtual void move_steps(std::size_t count) = 0;
  virtual double move_to(double time) = 0;
  virtual double move_to(double time, double every, Controller controller, Stop stop) = 0;
  virtual void drive(std::size_t first, const double* values, std::size_t count) = 0;
  virtual void release(std::size_t input) = 0;
  virtual std::vector<std::uint8_t> bytes() const = 0;
  virtual void go_on_from(const void* data, std::size_t size) = 0;
  virtual void start_again() = 0;
  /// A controller of Python, or nothing for None. @throws TypeError
  virtual Controller controller_of(nb::handle controller);
  enum class Drives { kAll, kOneOfTwin };
  /// One that is called with the outputs of `from`, and drives all or `from` alone.
  Controller calling(nb::handle controller, tc_simulation* from, Drives drives);
  /// Moving is refused: another one moves it.
  virtual void check_free() const;

 private:
  struct Change {
    Range range;
    double values[4];
  };
  Change change_of(nb::handle name, nb::handle value) const;
  double number_of(std::size_t input, nb::handle value) const;
  void collect(nb::handle mapping, std::vector<Change>& changes) const;
  nb::object observed(tc_simulation* from) const;
  Stop stop_of(nb::handle stop);
  /// @param cost  [us] without a stop for Python
  template <class Move>
  void moving(double cost, const Move& move);

  nb::object model_;
  const CompiledModel* compiled_;  // of model_
  bool is_calling_ = false;
};

/// `simulation.inputs`: a view, which keeps its simulation.
class InputsView {
 public:
  InputsView(nb::object owner, Flyer& flyer) : owner_(std::move(owner)), flyer_(&flyer) {}
  Flyer& flyer() const { return *flyer_; }
  const Signals& signals() const { return flyer_->compiled().inputs; }

 private:
  nb::object owner_;
  Flyer* flyer_;
};

}  // namespace twincraft::python
