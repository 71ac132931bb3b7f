// Models and what a program of ours says about one. See model.h.
#include "runtime/api/python/model.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <utility>

#include "runtime/api/python/arrays.h"
#include "runtime/api/python/faults.h"
#include "runtime/api/python/watched.h"

using namespace nanobind::literals;

namespace twincraft::python {

twincraft::Engine engine_named(const std::string& name) {
  for (const twincraft::Engine engine : {twincraft::Engine::bsm, twincraft::Engine::mujoco})
    if (name == name_of(engine)) return engine;
  refuse_value("an engine is 'bsm' or 'mujoco', not '" + name + "'");
}

namespace {

twincraft::Engines engines_named(const std::string& name) {
  if (name == "both") return twincraft::Engines::both;
  return engine_named(name) == twincraft::Engine::bsm ? twincraft::Engines::bsm
                                                      : twincraft::Engines::mujoco;
}

using Texts = std::vector<std::string>;

CompiledModel load(const std::string& path, const Texts& set) {
  std::optional<twincraft::Model> model;
  {
    const nb::gil_scoped_release others_go_on;
    model = twincraft::Model::load(path, set);
  }
  return CompiledModel(std::move(*model));
}

CompiledModel loads(const std::string& text, const Texts& set, const std::string& name) {
  std::optional<twincraft::Model> model;
  {
    const nb::gil_scoped_release others_go_on;
    model = twincraft::Model::loads(text, set, name);
  }
  return CompiledModel(std::move(*model));
}

twincraft::Run fly(const CompiledModel& model, const std::string& engine, bool timing) {
  twincraft::RunOptions options;
  options.engines = engines_named(engine);
  options.trials = timing ? 5 : 0;
  return watched(options, [&](const twincraft::RunOptions& how) { return model.model.run(how); });
}

twincraft::Run prove(const CompiledModel& model) {
  return watched(twincraft::RunOptions{},
                 [&](const twincraft::RunOptions& how) { return model.model.prove(how); });
}

twincraft::Run attribute(const CompiledModel& model) {
  return watched(twincraft::RunOptions{},
                 [&](const twincraft::RunOptions& how) { return model.model.attribute(how); });
}

nb::tuple mass_properties(const CompiledModel& model) {
  const twincraft::MassProperties all = model.model.mass_properties();
  const auto copied = [](const double* from) {
    return [from](double* to, std::size_t count) { std::copy(from, from + count, to); };
  };
  return nb::make_tuple(all.mass, read_only_array({3}, copied(all.center_of_mass)),
                        read_only_array({3, 3}, copied(all.inertia)));
}

CompiledModel member(const CompiledModel& model, std::size_t index) {
  std::optional<twincraft::Model> drawn;
  {
    const nb::gil_scoped_release others_go_on;
    drawn = model.model.member(index);
  }
  return CompiledModel(std::move(*drawn));
}

nb::object samples(const twincraft::Run& run, const std::string& engine, std::size_t width) {
  const twincraft::Engine which = engine_named(engine);
  return read_only_array({run.samples(which), width},
                         [&](double* rows, std::size_t count) { run.read(which, rows, count); });
}

void save(const twincraft::Run& run, const std::string& folder) {
  const nb::gil_scoped_release others_go_on;
  run.save(folder);
}

}  // namespace

void bind_model(nb::module_& module) {
  module.def("load", load, "path"_a, "set"_a, "Compile a file.");
  module.def("loads", loads, "text"_a, "set"_a, "name"_a, "Compile a text.");

  nb::class_<CompiledModel>(module, "CompiledModel", "The compiled spec behind a Model.")
      .def_prop_ro("name", [](const CompiledModel& self) { return self.model.name(); })
      .def_prop_ro("digest", [](const CompiledModel& self) { return self.model.digest(); })
      .def_prop_ro("mjcf", [](const CompiledModel& self) { return self.model.mjcf(); })
      .def_prop_ro("resolved", [](const CompiledModel& self) { return self.model.resolved(); })
      .def_prop_ro("diagnostics",
                   [](const CompiledModel& self) { return self.model.diagnostics(); })
      .def_prop_ro("step", [](const CompiledModel& self) { return self.model.step(); })
      .def_prop_ro("duration", [](const CompiledModel& self) { return self.model.duration(); })
      .def_prop_ro("degrees_of_freedom",
                   [](const CompiledModel& self) { return self.model.degrees_of_freedom(); })
      .def_prop_ro(
          "inputs", [](const CompiledModel& self) { return self.inputs.described(); },
          nb::sig("def inputs(self) -> list[tuple[str, str, str]]"))
      .def_prop_ro(
          "outputs", [](const CompiledModel& self) { return self.outputs.described(); },
          nb::sig("def outputs(self) -> list[tuple[str, str, str]]"))
      .def_prop_ro(
          "states", [](const CompiledModel& self) { return self.states.described(); },
          nb::sig("def states(self) -> list[tuple[str, str, str]]"))
      .def("mass_properties", mass_properties,
           nb::sig("def mass_properties(self) -> tuple[float, numpy.typing.NDArray[numpy.float64], "
                   "numpy.typing.NDArray[numpy.float64]]"))
      .def("run", fly, "engine"_a, "timing"_a)
      .def("prove", prove)
      .def("attribute", attribute)
      .def("member", member, "index"_a)
      .def_prop_ro("member_cost", &CompiledModel::member_cost)
      .def_prop_ro("campaign_members",
                   [](const CompiledModel& self) { return self.model.campaign_members(); });

  nb::class_<twincraft::Run>(module, "FinishedRun", "What a program of ours would have said.")
      .def_prop_ro("verdict", &twincraft::Run::verdict)
      .def_prop_ro("passes", &twincraft::Run::passes)
      .def_prop_ro("text", [](const twincraft::Run& self) { return std::string(self.text()); })
      .def_prop_ro("json", [](const twincraft::Run& self) { return std::string(self.json()); })
      .def("samples", samples, "engine"_a, "width"_a,
           nb::sig("def samples(self, engine: str, width: int) -> "
                   "numpy.typing.NDArray[numpy.float64]"))
      .def("save", save, "folder"_a);
}

}  // namespace twincraft::python
