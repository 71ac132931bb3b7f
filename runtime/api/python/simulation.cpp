// Simulation and Twin in Python. See flyer.h.
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <memory>

#include "runtime/api/python/faults.h"
#include "runtime/api/python/flyer.h"

using namespace nanobind::literals;

namespace twincraft::python {
namespace {

/// All that the C++ interface says alike of both.
template <class Flown>
class Flying : public Flyer {
 public:
  Flying(nb::object model, Flown flown) : Flyer(std::move(model)), flown_(std::move(flown)) {}

 protected:
  void move_steps(std::size_t count) override { flown_.step(count); }
  double move_to(double time) override { return flown_.run_until(time); }
  double move_to(double time, double every, Controller controller, Stop stop) override {
    return flown_.run_until(time, every, std::move(controller), std::move(stop));
  }
  void drive(std::size_t first, const double* values, std::size_t count) override {
    flown_.drive(first, values, count);
  }
  void release(std::size_t input) override { flown_.release(input); }
  std::vector<std::uint8_t> bytes() const override { return flown_.snapshot(); }
  void go_on_from(const void* data, std::size_t size) override { flown_.restore(data, size); }
  void start_again() override { flown_.reset(); }

  Flown flown_;
};

const twincraft::Model& model_in(const nb::object& model) {
  return nb::cast<const CompiledModel&>(model.attr("_core")).model;
}

class Simulation : public Flying<twincraft::Simulation> {
 public:
  static constexpr const char* kRunUntil =
      "def run_until(self, t: float, every: float | None = None, controller: "
      "collections.abc.Callable[[float, dict[str, typing.Any]], collections.abc.Mapping[str, "
      "typing.Any] | None] | None = None, stop: collections.abc.Callable[[float, dict[str, "
      "typing.Any]], bool] | None = None) -> float";

  Simulation(const nb::object& model, const std::string& engine)
      : Flying(model, twincraft::Simulation(model_in(model), engine_named(engine))),
        engine_(engine_named(engine)) {
    tc_simulation_set_poll(flown_.handle(), poll_signals, nullptr);
  }
  Simulation(const Simulation& other)
      : Flying(other.model(), other.flown_), engine_(other.engine_) {
    tc_simulation_set_poll(flown_.handle(), poll_signals, nullptr);
  }
  /// One of a twin's, which moves it.
  Simulation(nb::object twin, const nb::object& model, twincraft::Simulation flown,
             twincraft::Engine engine)
      : Flying(model, std::move(flown)), twin_(std::move(twin)), engine_(engine) {}

  const char* engine() const { return name_of(engine_); }
  void set_state(const std::vector<double>& state) {
    check_free();
    flown_.set_state(state);
  }

 protected:
  tc_simulation* seen() const override { return flown_.handle(); }
  double step_cost() const override { return compiled().step_cost(engine_); }
  void check_free() const override {
    if (twin_.is_valid()) refuse_busy("it is one of a twin: move the twin");
    Flyer::check_free();
  }

 private:
  nb::object twin_;
  twincraft::Engine engine_;
};

class Twin : public Flying<twincraft::Twin> {
 public:
  static constexpr const char* kRunUntil =
      "def run_until(self, t: float, every: float | None = None, controller: "
      "collections.abc.Callable[[float, dict[str, typing.Any]], collections.abc.Mapping[str, "
      "typing.Any] | None] | dict[str, collections.abc.Callable[[float, dict[str, typing.Any]], "
      "collections.abc.Mapping[str, typing.Any] | None]] | None = None, stop: "
      "collections.abc.Callable[[float, dict[str, typing.Any]], bool] | None = None) -> float";

  Twin(const nb::object& model, const std::string& lead)
      : Flying(model, twincraft::Twin(model_in(model), engine_of(lead))), lead_(lead) {
    tc_twin_set_poll(flown_.handle(), poll_signals, nullptr);
  }
  Twin(const Twin& other) : Flying(other.model(), other.flown_), lead_(other.lead_) {
    tc_twin_set_poll(flown_.handle(), poll_signals, nullptr);
  }

  const std::string& lead() const { return lead_; }
  twincraft::Simulation simulation(twincraft::Engine engine) const {
    return flown_.simulation(engine);
  }
  nb::object disagreement() const {
    time();  // refuses while another thread moves it
    return nb::module_::import_("json").attr("loads")(flown_.disagreement());
  }

 protected:
  tc_simulation* seen() const override { return handle_of(engine_of(lead_)); }
  double step_cost() const override {
    return compiled().step_cost(twincraft::Engine::bsm) +
           compiled().step_cost(twincraft::Engine::mujoco);
  }
  Controller controller_of(nb::handle controller) override {
    pair_.clear();
    const bool is_pair = PyDict_Check(controller.ptr()) != 0;
    if (lead_ != "each") {
      if (is_pair)
        throw nb::type_error("a controller for each engine needs a twin with lead=\"each\"");
      return Flyer::controller_of(controller);
    }
    if (controller.is_none()) return {};
    if (!is_pair)
      throw nb::type_error(
          "with lead=\"each\" a controller is a dict: {\"bsm\": f, \"mujoco\": g}");
    pair_ = pair_of(nb::borrow<nb::dict>(controller));
    return [](double) {};  // those of the pair are called
  }
  double move_to(double time, double every, Controller controller, Stop stop) override {
    if (pair_.empty()) return Flying::move_to(time, every, std::move(controller), std::move(stop));
    return flown_.run_each_until(time, every, pair_[0], pair_[1], std::move(stop));
  }

 private:
  static twincraft::Engine engine_of(const std::string& lead) {
    if (lead == "each") return twincraft::Engine::bsm;
    for (const twincraft::Engine engine : {twincraft::Engine::bsm, twincraft::Engine::mujoco})
      if (lead == name_of(engine)) return engine;
    refuse_value("lead is 'bsm', 'mujoco' or 'each', not '" + lead + "'");
  }
  tc_simulation* handle_of(twincraft::Engine engine) const {
    return tc_twin_simulation(flown_.handle(), static_cast<tc_engine>(engine));
  }
  std::vector<Controller> pair_of(const nb::dict& given) {
    std::vector<Controller> both;
    std::size_t known = 0;
    for (const twincraft::Engine engine : {twincraft::Engine::bsm, twincraft::Engine::mujoco}) {
      const char* name = name_of(engine);
      const nb::object controller = given.attr("get")(name);
      if (given.contains(name)) ++known;
      both.push_back(controller.is_none()
                         ? Controller([](double) {})
                         : calling(controller, handle_of(engine), Drives::kOneOfTwin));
    }
    if (known != given.size())
      refuse_value("a dict of controllers has the keys 'bsm' and 'mujoco' alone");
    return both;
  }

  std::string lead_;
  std::vector<Controller> pair_;  // of a run with a controller for each engine
};

template <class Flown>
std::unique_ptr<Flown> copied(const Flown& flown) {
  return std::make_unique<Flown>(flown);
}

template <class Flown>
void bind_common(nb::class_<Flown>& flown) {
  flown
      .def_prop_ro(
          "model", [](const Flown& self) { return self.model(); },
          nb::sig("def model(self) -> twincraft.Model"), "The model that it is made of.")
      .def_prop_ro("time", &Flown::time, "Time since the start [s].")
      .def_prop_ro("state", &Flown::state,
                   nb::sig("def state(self) -> numpy.typing.NDArray[numpy.float64]"),
                   "The state, a read-only copy: float64 (states,), SI, in the order of "
                   "``model.states``.\n\nIt is not all that the motion depends on: a "
                   ":meth:`snapshot` is.")
      .def_prop_ro(
          "inputs",
          [](nb::handle_t<Flown> self) {
            return InputsView(nb::borrow(self), nb::cast<Flown&>(self));
          },
          "Inputs by name. Reading says what acts now, writing drives.")
      .def("observe", &Flown::observe, nb::sig("def observe(self) -> dict[str, typing.Any]"),
           "The outputs now, in a new dict: the CSV's columns, SI.\n\nVectors are float64 arrays, "
           "(3,) or (4,). Everything else is a float.")
      .def("step", &Flown::step, nb::arg("n") = 1, nb::sig("def step(self, n: int = 1) -> None"),
           "Go to the ``n``-th next point of the grid k * simulation.step.\n\nRaises ValueError "
           "for n <= 0, and NumericalError when the motion is no longer finite.")
      .def("run_until", &Flown::run_until, nb::arg("t"), nb::arg("every") = nb::none(),
           nb::arg("controller") = nb::none(), nb::arg("stop") = nb::none(),
           nb::sig(Flown::kRunUntil),
           "Go to exactly ``t`` [s], or to where ``stop`` says so. Returns the time reached [s].\n"
           "\n"
           "Ticks are start + k * ``every`` [s]; None means every step end. At each tick but the\n"
           "end, ``stop(t, y)`` is asked and then ``controller(t, y)``. At the end ``stop`` is\n"
           "asked alone. ``y`` is what :meth:`observe` returns. A controller returns a dict of\n"
           "inputs to drive, or None. Inputs that it leaves out keep what they have.\n"
           "\n"
           "Raises ValueError for a time that is over or not finite and for ``every`` <= 0,\n"
           "InputError for an unknown name or a value that is not finite, NumericalError, and\n"
           "whatever the callbacks raise. It then stands at the tick, or at the last good step\n"
           "end.")
      .def("snapshot", &Flown::snapshot,
           "All that the motion from here on depends on, as bytes. Any process that runs the same\n"
           "version can go on from it.")
      .def("restore", &Flown::restore, nb::arg("snapshot"),
           "Go on from a snapshot, to the bit.\n\nRaises SnapshotError for bytes of another model, "
           "engine or version. Nothing has changed then.")
      .def("reset", &Flown::reset, "Start again at t = 0, with all inputs released.")
      .def("copy", copied<Flown>, "Another one, which goes on from this instant to the same bytes.")
      .def("__copy__", copied<Flown>)
      .def(
          "__deepcopy__", [](const Flown& self, nb::handle) { return copied(self); },
          nb::arg("memo"));
}

void bind_simulation(nb::module_& module) {
  nb::class_<Simulation> simulation(
      module, "Simulation",
      "One engine of a model on its way, from t = 0. It has no end. Made by "
      ":meth:`Model.simulate`.");
  simulation.def(
      nb::init<const nb::object&, const std::string&>(), nb::arg("model"),
      nb::arg("engine") = name_of(twincraft::Engine::bsm),
      nb::sig("def __init__(self, model: twincraft.Model, engine: str = 'bsm') -> None"));
  bind_common(simulation);
  simulation.def_prop_ro("engine", &Simulation::engine, "``bsm`` or ``mujoco``.")
      .def("set_state", &Simulation::set_state, nb::arg("state"),
           nb::sig("def set_state(self, state: collections.abc.Sequence[float] | "
                   "numpy.typing.NDArray[numpy.float64]) -> None"),
           "Go on from another state, (states,) in the order of ``model.states``, SI.\n\nRaises "
           "InputError for another size or a number that is not finite.")
      .def("__repr__", [](const Simulation& self) {
        return "<twincraft.Simulation of " + self.compiled().model.name() + ", " + self.engine() +
               ", t = " + nb::cast<std::string>(nb::repr(nb::float_(self.time()))) + " s>";
      });
}

void bind_twin(nb::module_& module) {
  const auto one = [](twincraft::Engine engine) {
    return [engine](nb::handle_t<Twin> self) {
      const Twin& twin = nb::cast<const Twin&>(self);
      return std::make_unique<Simulation>(nb::borrow(self), twin.model(), twin.simulation(engine),
                                          engine);
    };
  };
  nb::class_<Twin> twin(module, "Twin",
                        "Both engines of a model in lock step. Made by :meth:`Model.twin`.");
  twin.def(nb::init<const nb::object&, const std::string&>(), nb::arg("model"),
           nb::arg("lead") = name_of(twincraft::Engine::bsm),
           nb::sig("def __init__(self, model: twincraft.Model, lead: str = 'bsm') -> None"));
  bind_common(twin);
  twin.def_prop_ro("lead", &Twin::lead, "``bsm``, ``mujoco`` or ``each``.")
      .def_prop_ro(name_of(twincraft::Engine::bsm), one(twincraft::Engine::bsm),
                   nb::sig("def bsm(self) -> Simulation"),
                   "The analytic engine, to be observed and driven. The twin moves it.")
      .def_prop_ro(name_of(twincraft::Engine::mujoco), one(twincraft::Engine::mujoco),
                   nb::sig("def mujoco(self) -> Simulation"),
                   "MuJoCo, to be observed and driven. The twin moves it.")
      .def_prop_ro("disagreement", &Twin::disagreement,
                   nb::sig("def disagreement(self) -> dict[str, dict[str, typing.Any]]"),
                   "How far the engines are apart over all step ends so far: ``agreement`` of\n"
                   "report.json, with ``now`` beside ``max``.")
      .def("__repr__", [](const Twin& self) {
        return "<twincraft.Twin of " + self.compiled().model.name() + ", lead " + self.lead() +
               ", t = " + nb::cast<std::string>(nb::repr(nb::float_(self.time()))) + " s>";
      });
}

nb::object entries(const InputsView& self, const char* which) {
  const nb::dict all;
  const nb::object names = self.signals().names();
  for (const nb::handle name : names) all[name] = self.flyer().input(name);
  return all.attr(which)();
}

void bind_inputs(nb::module_& module) {
  nb::class_<InputsView>(
      module, "Inputs",
      "The inputs of a simulation or a twin by name.\n\nReading says what acts now, driven or "
      "scheduled, in SI. Writing a number (SI), a text with a\nunit, or three for a vector such as "
      "``push.force`` drives the input from now on, in place of\nits schedule, until it is set "
      "again or released. Iteration is over the scalar names.")
      .def(
          "__getitem__",
          [](const InputsView& self, nb::handle name) { return self.flyer().input(name); },
          nb::arg("name"), nb::sig("def __getitem__(self, name: str) -> typing.Any"))
      .def(
          "__setitem__",
          [](const InputsView& self, nb::handle name, nb::handle value) {
            self.flyer().set_input(name, value);
          },
          nb::arg("name"), nb::arg("value").none(),
          nb::sig("def __setitem__(self, name: str, value: typing.Any) -> None"))
      .def(
          "__contains__",
          [](const InputsView& self, nb::handle name) { return self.signals().contains(name); },
          nb::arg("name"), nb::sig("def __contains__(self, name: object) -> bool"))
      .def(
          "__iter__", [](const InputsView& self) { return nb::iter(self.signals().names()); },
          nb::sig("def __iter__(self) -> collections.abc.Iterator[str]"))
      .def("__len__", [](const InputsView& self) { return self.signals().size(); })
      .def(
          "get",
          [](const InputsView& self, nb::handle name, nb::object otherwise) {
            return self.signals().contains(name) ? self.flyer().input(name) : otherwise;
          },
          nb::arg("name"), nb::arg("default") = nb::none(),
          nb::sig("def get(self, name: str, default: typing.Any = None) -> typing.Any"),
          "What acts now, or ``default`` where there is no such input.")
      .def(
          "keys", [](const InputsView& self) { return entries(self, "keys"); },
          nb::sig("def keys(self) -> collections.abc.KeysView[str]"), "The scalar names.")
      .def(
          "values", [](const InputsView& self) { return entries(self, "values"); },
          nb::sig("def values(self) -> collections.abc.ValuesView[float]"), "What acts now, SI.")
      .def(
          "items", [](const InputsView& self) { return entries(self, "items"); },
          nb::sig("def items(self) -> collections.abc.ItemsView[str, float]"),
          "Names and what acts now, SI.")
      .def(
          "update",
          [](const InputsView& self, nb::handle inputs) { self.flyer().set_inputs(inputs); },
          nb::arg("inputs").none(),
          nb::sig("def update(self, inputs: collections.abc.Mapping[str, typing.Any]) -> None"),
          "Drive several inputs, all or none.\n\nRaises InputError.")
      .def(
          "release",
          [](const InputsView& self, nb::handle name) { self.flyer().release_input(name); },
          nb::arg("name"), nb::sig("def release(self, name: str) -> None"),
          "Give an input back to its schedule as it stands by now.\n\nRaises InputError.")
      .def("__repr__", [](const InputsView& self) {
        const nb::object all =
            nb::module_::import_("builtins").attr("dict")(entries(self, "items"));
        return "<twincraft.Inputs " + nb::cast<std::string>(nb::repr(all)) + ">";
      });
}

}  // namespace

void bind_flyers(nb::module_& module) {
  bind_inputs(module);
  bind_simulation(module);
  bind_twin(module);
}

}  // namespace twincraft::python
