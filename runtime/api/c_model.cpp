// The C interface: models. See include/twincraft.h.
#include <fmt/format.h>

#include <cstring>

#include "compiler/diag/print.h"
#include "runtime/api/handles.h"

namespace twincraft::api {
namespace {

/// @param compile  makes the model; it runs where an exception is caught
template <class Compile>
tc_status make(tc_model** out, const Compile& compile) noexcept {
  if (out == nullptr) return TC_USAGE;
  *out = new (std::nothrow) tc_model;
  if (*out == nullptr) return TC_MEMORY;
  tc_model& handle = **out;
  return attempt(handle.parts.error, [&] {
    Diagnostics diagnostics;
    try {
      handle.model = compile(diagnostics);
    } catch (...) {
      handle.diagnostics = to_json(diagnostics);
      throw;
    }
    handle.diagnostics = to_json(diagnostics);
  });
}

template <class Request>
tc_status load(const tc_load_options* options, tc_model** out, const Request& request) noexcept {
  return make(out, [&](Diagnostics& diagnostics) {
    check_struct(options);
    CompileRequest wanted = request();
    if (options != nullptr && options->set_count > 0)
      wanted.overrides.assign(options->set, options->set + options->set_count);
    return CompiledModel::load(wanted, diagnostics);
  });
}

std::shared_ptr<const CompiledModel> member_of(const CompiledModel& model, std::size_t member,
                                               Diagnostics& diagnostics) {
  const CampaignPlan& plan = campaign_of(model);
  if (member >= plan.members)
    refuse(fmt::format("there is no member {}: {} of them count from 0", member, plan.members));
  return model.member(member, diagnostics);
}

const SignalList& list_of(const tc_model& handle, tc_signals which) {
  switch (which) {
    case TC_INPUTS:
      return handle.model->inputs();
    case TC_OUTPUTS:
      return handle.model->outputs();
    default:
      return handle.model->states();
  }
}

}  // namespace
}  // namespace twincraft::api

using namespace twincraft;
using namespace twincraft::api;

extern "C" {

int tc_abi_version(void) { return TC_ABI_VERSION; }

const char* tc_version(void) { return TWINCRAFT_VERSION; }

const char* tc_engine_name(tc_engine engine) {
  return name_of(engine == TC_MUJOCO ? EngineKind::kMujoco : EngineKind::kBsm).key.data();
}

tc_status tc_model_load(const char* path, const tc_load_options* options, tc_model** model) {
  if (path == nullptr) return TC_USAGE;
  return load(options, model, [path] { return CompileRequest{path, {}}; });
}

tc_status tc_model_loads(const char* text, size_t length, const tc_load_options* options,
                         tc_model** model) {
  if (text == nullptr) return TC_USAGE;
  return load(options, model, [&] {
    const char* name = options != nullptr && options->name != nullptr ? options->name : "<string>";
    return CompileRequest{name, {}, std::string(text, length)};
  });
}

size_t tc_model_campaign_members(const tc_model* model) {
  const bool is_whole = model != nullptr && model->is_whole();
  const CampaignPlan* plan = is_whole ? model->model->spec().campaign() : nullptr;
  return plan == nullptr ? 0 : plan->members;
}

tc_status tc_model_member(const tc_model* model, size_t member, tc_model** drawn) {
  if (model == nullptr || !model->is_whole()) return TC_USAGE;
  return make(drawn, [&](Diagnostics& diagnostics) {
    return member_of(*model->model, member, diagnostics);
  });
}

void tc_model_free(tc_model* model) { delete model; }

const char* tc_model_error(const tc_model* model) {
  return model == nullptr ? "out of memory" : model->parts.error.c_str();
}

const char* tc_model_diagnostics(const tc_model* model) {
  return model == nullptr ? "" : model->diagnostics.c_str();
}

const char* tc_model_text(const tc_model* model, tc_text which, size_t* length) {
  static const std::string kNothing;
  const std::string* text = &kNothing;
  if (model != nullptr && model->is_whole()) {
    const Bundle& bundle = model->model->bundle();
    switch (which) {
      case TC_NAME:
        text = &bundle.model.name;
        break;
      case TC_DIGEST:
        text = &model->model->digest();
        break;
      case TC_MJCF:
        text = &bundle.text(kMjcf);
        break;
      case TC_ASSEMBLY:
        text = &bundle.text(kAssemblyJson);
        break;
      case TC_RESOLVED:
        text = &bundle.text(kResolved);
        break;
    }
  }
  if (length != nullptr) *length = text->size();
  return text->c_str();
}

size_t tc_model_count(const tc_model* model, tc_signals which) {
  return model == nullptr || !model->is_whole() ? 0 : list_of(*model, which).size();
}

const char* tc_model_signal_name(const tc_model* model, tc_signals which, size_t index) {
  if (index >= tc_model_count(model, which)) return nullptr;
  return list_of(*model, which).name(index).c_str();
}

const char* tc_model_signal_unit(const tc_model* model, tc_signals which, size_t index) {
  if (index >= tc_model_count(model, which)) return nullptr;
  return list_of(*model, which).unit(index).c_str();
}

const char* tc_model_signal_meaning(const tc_model* model, tc_signals which, size_t index) {
  if (index >= tc_model_count(model, which)) return nullptr;
  return list_of(*model, which).meaning(index).c_str();
}

tc_status tc_model_find(tc_model* model, tc_signals which, const char* name, size_t* index,
                        size_t* count) {
  return inside(model, Use::kAsks, [&] {
    const SignalList::Range range = list_of(*model, which).find(name == nullptr ? "" : name);
    if (index != nullptr) *index = range.first;
    if (count != nullptr) *count = range.count;
  });
}

tc_status tc_model_read_input(tc_model* model, size_t input, const char* text, double* value) {
  return inside(model, Use::kAsks, [&] {
    check_input(*model->model, input, 1);
    const double number = read_input(*model->model, input, text);
    if (value != nullptr) *value = number;
  });
}

int tc_model_degrees_of_freedom(const tc_model* model) {
  return model == nullptr || !model->is_whole() ? 0 : model->model->model().degrees_of_freedom();
}

double tc_model_step(const tc_model* model) {
  return model == nullptr || !model->is_whole() ? 0.0 : model->model->model().simulation.step;
}

double tc_model_duration(const tc_model* model) {
  return model == nullptr || !model->is_whole() ? 0.0 : model->model->model().simulation.duration;
}

tc_status tc_model_mass_properties(tc_model* model, double* mass, double center_of_mass[3],
                                   double inertia[9]) {
  return inside(model, Use::kAsks, [&] {
    const MassProperties all = model->model->mass_properties();
    if (mass != nullptr) *mass = all.mass;
    if (center_of_mass != nullptr) Vector3d::Map(center_of_mass) = all.r_CL_L;
    if (inertia != nullptr) Matrix3d::Map(inertia) = all.I_PntC_L;
  });
}

}  // extern "C"
