// What both halves of a script share: its head, its run and what acts, as data.
// Tested by tests/compiler/basilisk_test.cpp, and flown by tests/basilisk.
#include "compiler/emit/basilisk.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "compiler/emit/basilisk_code.h"
#include "compiler/emit/basilisk_half.h"
#include "compiler/emit/python_text.h"
#include "compiler/emit/resolved.h"
#include "compiler/ir/digest.h"
#include "compiler/ir/inputs.h"
#include "compiler/ir/number.h"
#include "compiler/ir/signals.h"
#include "compiler/ir/vector_json.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

std::string_view method_of(Method method) {
  switch (method) {
    case Method::kEuler:
      return "svIntegratorEuler";
    case Method::kRk2:
      return "svIntegratorRK2";
    case Method::kRk4:
      return "svIntegratorRK4";
    case Method::kRkf45:
      return "svIntegratorRKF45";
    case Method::kRkf78:
      return "svIntegratorRKF78";
  }
  return {};
}

/// The tightest of all blocks: Basilisk's are for every state alike.
Tolerance tightest(const BlockTolerances& blocks) {
  Tolerance least = blocks.position;
  for (const Tolerance& each : {blocks.velocity, blocks.attitude, blocks.rate, blocks.joint,
                                blocks.joint_rate, blocks.wheel}) {
    least.absolute = std::min(least.absolute, each.absolute);
    least.relative = std::min(least.relative, each.relative);
  }
  return least;
}

/// An input of the script: a number, or the components of a vector.
struct Input {
  std::string name;
  std::vector<const Schedule*> schedules;

  Json at(double time) const {
    Json values = Json::array();
    for (const Schedule* each : schedules) values.push_back(each->at(time));
    return values.size() == 1 ? values.front() : values;
  }
  bool is_zero() const {
    return std::ranges::all_of(schedules, [](const Schedule* each) { return each->is_zero(); });
  }
};

std::vector<const Schedule*> pointers(const std::array<Schedule, 3>& schedules) {
  return {&schedules[0], &schedules[1], &schedules[2]};
}

/// Those that ever act.
std::vector<Input> acting_inputs(const Model& model) {
  std::vector<Input> inputs;
  for (const Rotor& rotor : model.assembly.rotors)
    inputs.push_back({rotor.name + ".torque", {&rotor.torque}});
  for (const Link& link : model.assembly.links)
    inputs.push_back({link.name + (link.joint.kind == JointKind::kHinge ? ".torque" : ".force"),
                      {&link.joint.effort}});
  for (const Load& load : model.loads) {
    inputs.push_back({load.name + ".force", pointers(load.force_L)});
    inputs.push_back({load.name + ".torque", pointers(load.torque_L)});
  }
  for (const Tank& tank : model.tanks) inputs.push_back({tank.name + ".flow", {&tank.mass_flow}});
  for (const Nozzle& nozzle : model.nozzles)
    inputs.push_back({nozzle.name + ".flow", {&nozzle.mass_flow}});
  std::erase_if(inputs, &Input::is_zero);
  return inputs;
}

/// What acts, by the time from which it does: all at t = 0, then what changes. A time at which
/// nothing does stays: a step ends there.
std::string inputs_of_script(const Model& model) {
  const std::vector<Input> inputs = acting_inputs(model);
  std::vector<double> times = input_events(model, std::numeric_limits<double>::infinity());
  times.insert(times.begin(), 0.0);
  Json all = Json::array();
  std::vector<Json> last(inputs.size());
  for (const double time : times) {
    Json changes = Json::object();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      Json value = inputs[i].at(time);
      if (value != last[i]) changes[inputs[i].name] = value;
      last[i] = std::move(value);
    }
    all.push_back(Json::array({time, std::move(changes)}));
  }
  return assignment("INPUTS", all, "from when on [s, N, N m, kg/s]");
}

/// The header of our CSV.
std::string columns(const Model& model) {
  Json all = {"t [s]"};
  for (const OutputSignal& output : outputs_of(model))
    for (std::size_t i = 0; i < output.size(); ++i)
      all.push_back(fmt::format("{} [{}]", output.component(i), output.unit));
  return assignment("COLUMNS", all);
}

double initial_of(const Model& model, const OutputSignal& output) {
  const Coordinate& coordinate = output.coordinate.value();
  const VehicleState& initial = model.initial;
  const std::vector<double>& values = coordinate.is_wheel() ? initial.wheel_rate
                                      : output.of == OutputSignal::Of::kCoordinateRate
                                          ? initial.joint_rate
                                          : initial.joint_position;
  return values[coordinate.entry()];
}

/// Attitude as a quaternion for one half, as MRPs for the other.
std::string initial_state(const Model& model) {
  const VehicleState& initial = model.initial;
  Json state = {{"r_BN_N", vector_json(initial.r_BN_N)}, {"v_BN_N", vector_json(initial.v_BN_N)}};
  if (model.simulation.translation) {
    state["r_CN_N"] = vector_json(initial.r_BN_N + hub_of(model).r_CL_L);
  } else {
    const double sign = initial.q_BN.w() < 0.0 ? -1.0 : 1.0;
    const double w = sign * initial.q_BN.w();
    const Vector3d part = sign * initial.q_BN.vec();
    state["q_BN"] = {w, part.x(), part.y(), part.z()};
    state["sigma_BN"] = vector_json(part / (1.0 + w));
    state["omega_BN_B"] = vector_json(initial.omega_BN_B);
  }
  for (const OutputSignal& output : outputs_of(model))
    if (output.coordinate && initial_of(model, output) != 0.0)
      state[output.name] = initial_of(model, output);
  return assignment("INITIAL", state, "coordinates that are not here: 0");
}

std::string run_of(const Model& model) {
  const SimulationPlan& plan = model.simulation;
  std::string text = fmt::format(
      "STEP, DURATION, RECORD, INTEGRATOR = {}, {}, {}, svIntegrators.{}  # [s]\n",
      shortest(plan.step), shortest(plan.duration), shortest(plan.record), method_of(plan.method));
  if (is_adaptive(plan.method)) {
    const Tolerance tolerance = tightest(plan.tolerance);
    text += assignment("ABSOLUTE", tolerance.absolute) + assignment("RELATIVE", tolerance.relative);
  }
  if (model.gravity.mu > 0.0) text += assignment("MU", model.gravity.mu);
  return text;
}

/// Remarks as one sentence each, with who they are about.
std::vector<std::string> sentences(const std::vector<Remark>& remarks) {
  std::vector<std::string> all;
  for (const Remark& each : remarks)
    all.push_back(each.component.empty() ? each.text
                                         : fmt::format("{}: {}", each.component, each.text));
  return all;
}

bool is_whole_ns(double seconds) {
  const double ns = seconds * 1.0e9;
  return std::abs(ns - std::round(ns)) <= 1.0e-6;
}

/// What is said of both halves.
std::vector<Remark> notes_of(const Model& model) {
  std::vector<double> times = input_events(model);
  times.push_back(model.simulation.step);
  std::vector<Remark> notes;
  if (!std::ranges::all_of(times, is_whole_ns))
    notes.push_back({"",
                     "steps and events are at whole nanoseconds, which these times are not: "
                     "samples differ by up to half a nanosecond of motion"});
  return notes;
}

struct Script {
  std::vector<Remark> notes;
  Half bsm, mjscene;

  explicit Script(const Model& model)
      : notes(notes_of(model)), bsm(bsm_half(model)), mjscene(mjscene_half(model)) {
    const bool fits = model.simulation.step >= 1.0e-9 && model.simulation.duration < 9.0e9;
    if (fits) return;
    for (Half* half : {&bsm, &mjscene})
      half->refusals.push_back({"", "Basilisk counts whole nanoseconds, for 290 years"});
  }
};

std::string docstring(const Model& model, const Script& script, const std::string& digest) {
  std::string text;
  const std::string what = model.description.empty() ? "a spacecraft" : model.description;
  text += wrapped(fmt::format("{}: {}", model.name, what), "\"\"\"", "");
  text += wrapped(
      fmt::format("By sccompile " TWINCRAFT_VERSION " for Basilisk 2.12 and later, from the "
                  "spec whose resolved form has the SHA-256 {}. SI units and radians, names "
                  "as in Basilisk.",
                  digest),
      "\n", "");
  const auto say = [&text](std::string_view half, const std::vector<Remark>& remarks) {
    for (const std::string& each : sentences(remarks))
      text += wrapped(each, fmt::format("- {}: ", half), "  ");
  };
  std::string remarks;
  std::swap(text, remarks);
  for (const std::string& each : sentences(script.notes)) text += wrapped(each, "- ", "  ");
  say(fmt::format("{}, not written", kBsmHalf), script.bsm.refusals);
  say(kBsmHalf, script.bsm.notes);
  say(fmt::format("{}, not written", kMjSceneHalf), script.mjscene.refusals);
  say(kMjSceneHalf, script.mjscene.notes);
  std::swap(text, remarks);
  if (!remarks.empty()) return text + "\nNot as in the spec:\n" + remarks + "\"\"\"";
  text.pop_back();
  return text + "\"\"\"";
}

std::string refused(const Half& half) {
  return fmt::format("{}", fmt::join(sentences(half.refusals), "; "));
}

/// Which halves fly, and why one does not.
std::string halves(const Script& script) {
  Json refusals = Json::object();
  if (!script.bsm.refusals.empty()) refusals[kBsmHalf] = sentences(script.bsm.refusals);
  if (!script.mjscene.refusals.empty()) refusals[kMjSceneHalf] = sentences(script.mjscene.refusals);
  std::string text;
  if (!refusals.empty()) text += assignment("REFUSED", refusals);
  if (script.mjscene.refusals.empty()) {
    text += refusals.empty() ? "REFUSED = {} if " : "REFUSED |= {} if ";
    text +=
        "Basilisk.hasBuildFeature(\"mujoco\") else {\"mjscene\": [\"this Basilisk has no "
        "MuJoCo\"]}\n";
  }
  return text + "HALVES = [name for name in (\"bsm\", \"mjscene\") if name not in REFUSED]\n";
}

std::string text_of(const Model& model, const Script& script, const Json& resolved) {
  std::set<std::string> modules = script.bsm.simulation;
  modules.insert(script.mjscene.simulation.begin(), script.mjscene.simulation.end());
  modules.insert("svIntegrators");
  std::string text = docstring(model, script, sha256(emit_resolved(resolved)));
  text += imports_code(modules);
  text += run_of(model) + columns(model) + initial_state(model);
  text += inputs_of_script(model);
  text += script.bsm.tables + script.mjscene.tables + halves(script) + script.mjscene.models;
  return text + vehicle_code({.is_point = model.simulation.translation,
                              .is_adaptive = is_adaptive(model.simulation.method),
                              .engine = script.bsm.refusals.empty() ? kBsmHalf : kMjSceneHalf},
                             script.bsm.code + script.mjscene.code);
}

std::string refusal_of(const Script& script) {
  if (script.bsm.refusals.empty() || script.mjscene.refusals.empty()) return {};
  return fmt::format("Basilisk's BSM does not express it ({}), nor does its MJScene ({})",
                     refused(script.bsm), refused(script.mjscene));
}

std::vector<Remark> remarks_of(const Script& script) {
  std::vector<Remark> all = script.notes;
  const auto add = [&all](const char* name, const Half& half) {
    for (const Remark& each : half.refusals)
      all.push_back({each.component, fmt::format("not in {}: {}", name, each.text), true});
    for (const Remark& each : half.notes)
      all.push_back({each.component, fmt::format("in {}: {}", name, each.text)});
  };
  add("Basilisk's BSM", script.bsm);
  add("Basilisk's MJScene", script.mjscene);
  return all;
}

}  // namespace

bool is_adaptive(Method method) { return method == Method::kRkf45 || method == Method::kRkf78; }

std::string enumeration(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += "`" + names[i] + "`";
  }
  return text;
}

Printed emit_basilisk(const Model& model, const Json& resolved) {
  const Script script(model);
  Printed printed{.refusal = refusal_of(script), .remarks = remarks_of(script)};
  if (printed.refusal.empty()) printed.text = text_of(model, script, resolved);
  return printed;
}

}  // namespace twincraft
