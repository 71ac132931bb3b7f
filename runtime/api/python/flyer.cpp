// See flyer.h.
#include "runtime/api/python/flyer.h"

#include <nanobind/stl/string.h>

#include <cmath>

#include "runtime/api/python/arrays.h"
#include "runtime/api/python/faults.h"

namespace twincraft::python {
namespace {

constexpr double kWorthOthers = 4.0;  // [us] taking Python's lock again can cost as much

std::string shown(nb::handle value) { return nb::cast<std::string>(nb::repr(value)); }

const char* plural(std::size_t count) { return count == 1 ? "a number" : "three numbers"; }

double read_text(const twincraft::Model& model, std::size_t input, const std::string& text) {
  try {
    return model.read_input(input, text);
  } catch (const UsageError& error) {
    refuse_input(error.what());
  }
}

/// What went wrong in reading: only another thread inside can be it.
void check(tc_status status, tc_simulation* handle) {
  if (status != TC_OK) twincraft::detail::check(status, tc_simulation_error(handle));
}

/// True while a callback runs, also when it throws.
class Calling {
 public:
  explicit Calling(bool& flag) : flag_(flag) { flag_ = true; }
  ~Calling() { flag_ = false; }
  Calling(const Calling&) = delete;
  Calling& operator=(const Calling&) = delete;

 private:
  bool& flag_;
};

}  // namespace

Flyer::Flyer(nb::object model)
    : model_(std::move(model)), compiled_(&nb::cast<const CompiledModel&>(model_.attr("_core"))) {}

double Flyer::time() const {
  const double time = tc_simulation_time(seen());
  if (std::isnan(time)) throw BusyError();
  return time;
}

nb::object Flyer::state() const {
  return read_only_array({compiled_->states.size()}, [this](double* to, std::size_t count) {
    check(tc_simulation_state(seen(), to, count), seen());
  });
}

nb::object Flyer::observed(tc_simulation* from) const {
  return compiled_->outputs.dict([from](double* to, std::size_t count) {
    check(tc_simulation_observe(from, to, count), from);
  });
}

nb::object Flyer::observe() const { return observed(seen()); }

nb::object Flyer::inputs() const {
  return compiled_->inputs.dict([this](double* to, std::size_t count) {
    check(tc_simulation_inputs(seen(), to, count), seen());
  });
}

nb::object Flyer::input(nb::handle name) const {
  const Range range = compiled_->inputs.find(name);
  std::vector<double> all(compiled_->inputs.size());
  check(tc_simulation_inputs(seen(), all.data(), all.size()), seen());
  const double* first = all.data() + range.first;
  if (range.count == 1) return nb::float_(*first);
  return writable_array({range.count},
                        [&](double* to, std::size_t count) { std::copy_n(first, count, to); });
}

double Flyer::number_of(std::size_t input, nb::handle value) const {
  double number = 0.0;
  if (PyFloat_CheckExact(value.ptr())) {
    number = PyFloat_AsDouble(value.ptr());
  } else if (PyUnicode_Check(value.ptr())) {
    number = read_text(compiled_->model, input, nb::cast<std::string>(value));
  } else {
    number = PyFloat_AsDouble(value.ptr());
    if (number == -1.0 && PyErr_Occurred()) {
      PyErr_Clear();
      refuse_input("`" + compiled_->inputs.name(input) +
                   "` takes a number or a text with a unit, not " + shown(value));
    }
  }
  if (!std::isfinite(number))
    refuse_input(shown(value) + " for `" + compiled_->inputs.name(input) + "` is not finite");
  return number;
}

Flyer::Change Flyer::change_of(nb::handle name, nb::handle value) const {
  Change change{compiled_->inputs.find(name), {}};
  const std::size_t count = change.range.count;
  if (count == 1) {
    change.values[0] = number_of(change.range.first, value);
    return change;
  }
  const bool is_sequence = PySequence_Check(value.ptr()) != 0 && !PyUnicode_Check(value.ptr());
  const Py_ssize_t size = is_sequence ? PySequence_Size(value.ptr()) : -1;
  if (size != static_cast<Py_ssize_t>(count)) {
    PyErr_Clear();
    refuse_input("`" + nb::cast<std::string>(name) + "` takes " + plural(count) + ", not " +
                 shown(value));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const nb::object one = nb::steal(PySequence_GetItem(value.ptr(), static_cast<Py_ssize_t>(i)));
    if (!one.is_valid()) throw nb::python_error();
    change.values[i] = number_of(change.range.first + i, one);
  }
  return change;
}

void Flyer::collect(nb::handle mapping, std::vector<Change>& changes) const {
  nb::dict all;
  if (PyDict_Check(mapping.ptr()))
    all = nb::borrow<nb::dict>(mapping);
  else if (!nb::hasattr(mapping, "keys") || PyDict_Update(all.ptr(), mapping.ptr()) != 0)
    throw nb::type_error(
        ("inputs are a dict of names and values, or None, not " + shown(mapping)).c_str());
  PyObject *name = nullptr, *value = nullptr;
  Py_ssize_t position = 0;
  while (PyDict_Next(all.ptr(), &position, &name, &value) != 0)
    changes.push_back(change_of(name, value));
}

void Flyer::set_input(nb::handle name, nb::handle value) {
  const Change change = change_of(name, value);
  drive(change.range.first, change.values, change.range.count);
}

void Flyer::set_inputs(nb::handle mapping) {
  std::vector<Change> changes;
  collect(mapping, changes);
  for (const Change& change : changes) drive(change.range.first, change.values, change.range.count);
}

void Flyer::release_input(nb::handle name) {
  const Range range = compiled_->inputs.find(name);
  for (std::size_t i = 0; i < range.count; ++i) release(range.first + i);
}

void Flyer::check_free() const {
  if (is_calling_) refuse_busy("it is on its way already: a callback may ask and drive, not move");
}

template <class Move>
void Flyer::moving(double cost, const Move& move) {
  check_free();
  try {
    std::optional<nb::gil_scoped_release> others_go_on;
    if (cost > kWorthOthers) others_go_on.emplace();
    move();
  } catch (const Interrupted&) {
    throw_pending();
    throw;
  } catch (const UsageError& error) {
    refuse_value(error.what());
  }
}

void Flyer::step(nb::handle count) {
  const Py_ssize_t steps = PyNumber_AsSsize_t(count.ptr(), PyExc_OverflowError);
  throw_pending();
  if (steps <= 0) refuse_value("a number of steps must be > 0, not " + shown(count));
  const auto n = static_cast<std::size_t>(steps);
  moving(static_cast<double>(n) * step_cost(), [&] { move_steps(n); });
}

Flyer::Controller Flyer::calling(nb::handle controller, tc_simulation* from, Drives drives) {
  if (PyCallable_Check(controller.ptr()) == 0)
    throw nb::type_error(
        ("a controller is called with (t, y): " + shown(controller) + " cannot be called").c_str());
  return [this, controller, from, drives, changes = std::vector<Change>()](double time) mutable {
    const nb::gil_scoped_acquire gil;
    const Calling calling(is_calling_);
    const nb::object answer = controller(time, observed(from));
    if (answer.is_none()) return;
    changes.clear();
    collect(answer, changes);
    for (const auto& [range, values] : changes)
      if (drives == Drives::kAll)
        drive(range.first, values, range.count);
      else
        check(tc_simulation_drive_many(from, range.first, values, range.count), from);
  };
}

Flyer::Controller Flyer::controller_of(nb::handle controller) {
  return controller.is_none() ? Controller() : calling(controller, seen(), Drives::kAll);
}

Flyer::Stop Flyer::stop_of(nb::handle stop) {
  if (stop.is_none()) return {};
  if (PyCallable_Check(stop.ptr()) == 0)
    throw nb::type_error(
        ("stop is called with (t, y): " + shown(stop) + " cannot be called").c_str());
  return [this, stop](double time) {
    const nb::gil_scoped_acquire gil;
    const Calling calling(is_calling_);
    const nb::object answer = stop(time, observed(seen()));
    const int is_enough = PyObject_IsTrue(answer.ptr());
    if (is_enough < 0) throw nb::python_error();
    return is_enough != 0;
  };
}

double Flyer::run_until(double time, nb::handle every, nb::handle controller, nb::handle stop) {
  double period = 0.0;  // every step end
  if (!every.is_none()) {
    period = PyFloat_AsDouble(every.ptr());
    throw_pending();
    if (!(period > 0.0 && std::isfinite(period)))
      refuse_value("`every` must be a time > 0, not " + shown(every));
  }
  Controller control = controller_of(controller);
  Stop enough = stop_of(stop);
  const double step = compiled_->model.step();
  double reached = 0.0;
  if (!control && !enough) {
    const double now = this->time();
    moving((time - now) / step * step_cost(), [&] { reached = move_to(time); });
  } else {
    moving((period > 0.0 ? period / step : 1.0) * step_cost(),
           [&] { reached = move_to(time, period, std::move(control), std::move(enough)); });
  }
  return reached;
}

nb::bytes Flyer::snapshot() const {
  const std::vector<std::uint8_t> all = bytes();
  return nb::bytes(all.data(), all.size());
}

void Flyer::restore(const nb::bytes& bytes) {
  check_free();
  go_on_from(bytes.data(), bytes.size());
}

void Flyer::reset() {
  check_free();
  start_again();
}

}  // namespace twincraft::python
