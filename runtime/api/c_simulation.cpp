// The C interface: simulations. See include/twincraft.h.
#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "compiler/units/units.h"
#include "runtime/api/handles.h"

namespace twincraft::api {

void check_size(std::size_t count, std::size_t wanted, const char* what) {
  if (count != wanted) refuse(fmt::format("{} numbers of {}, not {}", wanted, what, count));
}

void check_input(const CompiledModel& model, std::size_t input, std::size_t count) {
  const std::size_t inputs = model.inputs().size();
  if (input > inputs || count > inputs - input)
    refuse(fmt::format("`{}` has {} inputs: there is no input {}", model.model().name, inputs,
                       input + count - 1));
}

double read_input(const CompiledModel& model, std::size_t input, const char* text) {
  const Quantity quantity = parse_quantity(text == nullptr ? "" : text, model.inputs().unit(input));
  if (!quantity.error.empty())
    refuse(fmt::format("`{}`: {}{}", model.inputs().name(input), quantity.error,
                       quantity.hint.empty() ? "" : "; " + quantity.hint));
  return quantity.value;
}

void hand_over(const std::string& bytes, void* to, std::size_t capacity, std::size_t* size) {
  if (size != nullptr) *size = bytes.size();
  if (to != nullptr && capacity >= bytes.size()) std::memcpy(to, bytes.data(), bytes.size());
}

Control control_of(const tc_control* from, Simulation& seen,
                   std::function<void(std::size_t, double)> drive) {
  if (from == nullptr) return {};
  check_struct(from);
  if (from->every != 0.0 && !(from->every > 0.0 && std::isfinite(from->every)))
    refuse("`every` must be a time > 0, or 0: every step end");
  for (std::size_t i = 0; i < from->driven_count; ++i)
    check_input(seen.model(), from->driven[i], 1);
  Control control{from->every};
  auto outputs = std::make_shared<std::vector<double>>(seen.model().outputs().size());
  if (from->stop != nullptr)
    control.stop = [from, &seen, outputs](double time) {
      seen.read_outputs(*outputs);
      return from->stop(from->context, time, outputs->data()) != 0;
    };
  if (from->controller == nullptr) return control;
  auto inputs = std::make_shared<std::vector<double>>(seen.model().inputs().size());
  control.control = [from, &seen, outputs, inputs, drive = std::move(drive)](double time) {
    seen.read_outputs(*outputs);
    seen.read_inputs(*inputs);
    if (from->controller(from->context, time, outputs->data(), inputs->data()) != 0)
      throw Fault(TC_INTERRUPTED, "ended by its controller");
    const std::span<const std::size_t> driven{from->driven, from->driven_count};
    for (const std::size_t input : driven)
      if (!std::isfinite((*inputs)[input]))
        refuse(fmt::format("the controller's {} for `{}` is not finite", (*inputs)[input],
                           seen.model().inputs().name(input)));
    for (const std::size_t input : driven) drive(input, (*inputs)[input]);
  };
  return control;
}

namespace {

void refuse_borrowed(const tc_simulation& handle) {
  if (handle.is_borrowed()) refuse("it is one of a twin: move the twin");
}

EngineKind kind_of(tc_engine engine) {
  if (engine != TC_BSM && engine != TC_MUJOCO) refuse("an engine is TC_BSM or TC_MUJOCO");
  return engine == TC_BSM ? EngineKind::kBsm : EngineKind::kMujoco;
}

}  // namespace
}  // namespace twincraft::api

using namespace twincraft;
using namespace twincraft::api;

extern "C" {

tc_status tc_simulation_new(const tc_model* model, tc_engine engine, tc_simulation** simulation) {
  if (model == nullptr || !model->is_whole() || simulation == nullptr) return TC_USAGE;
  *simulation = new (std::nothrow) tc_simulation;
  if (*simulation == nullptr) return TC_MEMORY;
  tc_simulation& handle = **simulation;
  return attempt(handle.parts.error, [&] {
    handle.owned = std::make_unique<Simulation>(model->model, kind_of(engine));
    handle.simulation = handle.owned.get();
  });
}

tc_status tc_simulation_copy(tc_simulation* simulation, tc_simulation** copy) {
  if (copy == nullptr) return TC_USAGE;
  *copy = new (std::nothrow) tc_simulation;
  if (*copy == nullptr) return TC_MEMORY;
  tc_simulation& handle = **copy;
  return inside(simulation, Use::kAsks, [&] {
    handle.owned = simulation->simulation->copy();
    handle.simulation = handle.owned.get();
  });
}

void tc_simulation_free(tc_simulation* simulation) {
  if (simulation != nullptr && (!simulation->is_borrowed() || !simulation->is_whole()))
    delete simulation;
}

const char* tc_simulation_error(const tc_simulation* simulation) {
  return simulation == nullptr ? "out of memory" : simulation->parts.error.c_str();
}

tc_status tc_simulation_failure(const tc_simulation* simulation, double* time,
                                const char** coordinate) {
  if (simulation == nullptr) return TC_USAGE;
  if (time != nullptr) *time = simulation->parts.failed_at;
  if (coordinate != nullptr) *coordinate = simulation->parts.failed_coordinate.c_str();
  return TC_OK;
}

tc_status tc_simulation_set_poll(tc_simulation* simulation, tc_poll poll, void* context) {
  return inside(simulation, Use::kAsks, [&] {
    simulation->parts.poll = poll;
    simulation->parts.poll_context = context;
  });
}

double tc_simulation_time(const tc_simulation* simulation) {
  return number_inside(simulation, [&] { return simulation->simulation->time(); });
}

tc_status tc_simulation_state(tc_simulation* simulation, double* state, size_t count) {
  return inside(simulation, Use::kAsks, [&] {
    check_size(count, simulation->simulation->model().states().size(), "a state");
    simulation->simulation->read_state({state, count});
  });
}

tc_status tc_simulation_observe(tc_simulation* simulation, double* outputs, size_t count) {
  return inside(simulation, Use::kAsks, [&] {
    check_size(count, simulation->simulation->model().outputs().size(), "outputs");
    simulation->simulation->read_outputs({outputs, count});
  });
}

tc_status tc_simulation_inputs(tc_simulation* simulation, double* inputs, size_t count) {
  return inside(simulation, Use::kAsks, [&] {
    check_size(count, simulation->simulation->model().inputs().size(), "inputs");
    simulation->simulation->read_inputs({inputs, count});
  });
}

tc_status tc_simulation_set_state(tc_simulation* simulation, const double* state, size_t count) {
  return inside(simulation, Use::kMoves, [&] {
    refuse_borrowed(*simulation);
    simulation->simulation->set_state({state, count});
  });
}

tc_status tc_simulation_drive(tc_simulation* simulation, size_t input, double value) {
  return tc_simulation_drive_many(simulation, input, &value, 1);
}

tc_status tc_simulation_drive_many(tc_simulation* simulation, size_t first, const double* values,
                                   size_t count) {
  return inside(simulation, Use::kAsks, [&] {
    check_input(simulation->simulation->model(), first, count);
    simulation->simulation->drive(first, {values, count});
  });
}

tc_status tc_simulation_drive_text(tc_simulation* simulation, size_t input, const char* value) {
  return inside(simulation, Use::kAsks, [&] {
    check_input(simulation->simulation->model(), input, 1);
    const double number = read_input(simulation->simulation->model(), input, value);
    simulation->simulation->drive(input, {&number, 1});
  });
}

tc_status tc_simulation_release(tc_simulation* simulation, size_t input) {
  return inside(simulation, Use::kAsks, [&] {
    check_input(simulation->simulation->model(), input, 1);
    simulation->simulation->release(input);
  });
}

int tc_simulation_is_driven(const tc_simulation* simulation, size_t input) {
  bool is_driven = false;
  inside(const_cast<tc_simulation*>(simulation), Use::kAsks, [&] {
    check_input(simulation->simulation->model(), input, 1);
    is_driven = simulation->simulation->is_driven(input);
  });
  return is_driven ? 1 : 0;
}

tc_status tc_simulation_step(tc_simulation* simulation, size_t count) {
  return inside(simulation, Use::kMoves, [&] {
    refuse_borrowed(*simulation);
    if (count == 0) refuse("a number of steps must be > 0");
    moving(simulation, *simulation->simulation,
           [&] { simulation->simulation->step(count, simulation->parts.polled()); });
  });
}

tc_status tc_simulation_run_until(tc_simulation* simulation, double time, const tc_control* control,
                                  double* reached) {
  const tc_status status = inside(simulation, Use::kMoves, [&] {
    refuse_borrowed(*simulation);
    Simulation& flyer = *simulation->simulation;
    const Control how = control_of(control, flyer, [&flyer](std::size_t input, double value) {
      flyer.drive(input, {&value, 1});
    });
    moving(simulation, flyer, [&] {
      if (control == nullptr)
        flyer.advance_to(time, simulation->parts.polled());
      else
        run_until(flyer, time, how, simulation->parts.polled());
    });
  });
  if (reached != nullptr) *reached = tc_simulation_time(simulation);
  return status;
}

tc_status tc_simulation_snapshot(tc_simulation* simulation, void* bytes, size_t capacity,
                                 size_t* size) {
  return inside(simulation, Use::kAsks,
                [&] { hand_over(simulation->simulation->snapshot(), bytes, capacity, size); });
}

tc_status tc_simulation_restore(tc_simulation* simulation, const void* bytes, size_t size) {
  return inside(simulation, Use::kMoves, [&] {
    refuse_borrowed(*simulation);
    simulation->simulation->restore({static_cast<const char*>(bytes), size});
  });
}

tc_status tc_simulation_reset(tc_simulation* simulation) {
  return inside(simulation, Use::kMoves, [&] {
    refuse_borrowed(*simulation);
    simulation->simulation->reset();
  });
}

}  // extern "C"
