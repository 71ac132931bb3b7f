// The C interface: twins. See include/twincraft.h.
#include <array>
#include <nlohmann/json.hpp>

#include "runtime/api/handles.h"
#include "runtime/api/twin.h"

struct tc_twin {
  std::unique_ptr<twincraft::api::Twin> twin;
  twincraft::api::HandleParts parts;
  std::array<tc_simulation, 2> views;
  std::string disagreement;

  bool is_whole() const { return twin != nullptr; }
  void show() {
    for (const twincraft::EngineName& engine : twincraft::kEngines) {
      tc_simulation& view = views[static_cast<std::size_t>(engine.kind)];
      view.simulation = &twin->of(engine.kind);
      view.parts.lock = &parts.own;
    }
  }
};

namespace twincraft::api {
namespace {

using Json = nlohmann::ordered_json;

/// A figure that is not finite has no number in JSON.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string disagreement_json(const Twin& twin) {
  Json all = Json::object();
  const Comparison comparison = twin.disagreement();
  for (std::size_t i = 0; i < comparison.metrics.size(); ++i) {
    const Metric& metric = comparison.metrics[i];
    Json& row = all[metric.key];
    row["max"] = number(metric.maximum);
    row["now"] = number(twin.now()[i]);
    row["at_s"] = metric.at;
    row["tolerance"] = metric.tolerance ? number(*metric.tolerance) : Json(nullptr);
    row["pass"] = metric.pass() ? Json(*metric.pass()) : Json(nullptr);
  }
  return all.dump();
}

void run(tc_twin* handle, double time, const Control& how, bool controls) {
  Twin& twin = *handle->twin;
  moving(handle, twin, [&] {
    if (controls)
      run_until(twin, time, how, handle->parts.polled());
    else
      twin.advance_to(time, handle->parts.polled());
  });
}

}  // namespace
}  // namespace twincraft::api

using namespace twincraft;
using namespace twincraft::api;

extern "C" {

tc_status tc_twin_new(const tc_model* model, tc_engine lead, tc_twin** twin) {
  if (model == nullptr || !model->is_whole() || twin == nullptr) return TC_USAGE;
  *twin = new (std::nothrow) tc_twin;
  if (*twin == nullptr) return TC_MEMORY;
  tc_twin& handle = **twin;
  return attempt(handle.parts.error, [&] {
    handle.twin = std::make_unique<Twin>(
        model->model, lead == TC_MUJOCO ? EngineKind::kMujoco : EngineKind::kBsm);
    handle.show();
  });
}

tc_status tc_twin_copy(tc_twin* twin, tc_twin** copy) {
  if (copy == nullptr) return TC_USAGE;
  *copy = new (std::nothrow) tc_twin;
  if (*copy == nullptr) return TC_MEMORY;
  return inside(twin, Use::kAsks, [&] {
    (*copy)->twin = std::make_unique<Twin>(*twin->twin);
    (*copy)->show();
  });
}

void tc_twin_free(tc_twin* twin) { delete twin; }

const char* tc_twin_error(const tc_twin* twin) {
  return twin == nullptr ? "out of memory" : twin->parts.error.c_str();
}

tc_status tc_twin_failure(const tc_twin* twin, double* time, const char** coordinate) {
  if (twin == nullptr) return TC_USAGE;
  if (time != nullptr) *time = twin->parts.failed_at;
  if (coordinate != nullptr) *coordinate = twin->parts.failed_coordinate.c_str();
  return TC_OK;
}

tc_status tc_twin_set_poll(tc_twin* twin, tc_poll poll, void* context) {
  return inside(twin, Use::kAsks, [&] {
    twin->parts.poll = poll;
    twin->parts.poll_context = context;
  });
}

tc_simulation* tc_twin_simulation(tc_twin* twin, tc_engine engine) {
  if (twin == nullptr || !twin->is_whole()) return nullptr;
  return &twin->views[engine == TC_MUJOCO ? 1 : 0];
}

double tc_twin_time(const tc_twin* twin) {
  return number_inside(twin, [&] { return twin->twin->time(); });
}

tc_status tc_twin_drive_many(tc_twin* twin, size_t first, const double* values, size_t count) {
  return inside(twin, Use::kAsks, [&] {
    check_input(twin->twin->model(), first, count);
    twin->twin->drive(first, {values, count});
  });
}

tc_status tc_twin_drive_text(tc_twin* twin, size_t input, const char* value) {
  return inside(twin, Use::kAsks, [&] {
    check_input(twin->twin->model(), input, 1);
    const double number = read_input(twin->twin->model(), input, value);
    twin->twin->drive(input, {&number, 1});
  });
}

tc_status tc_twin_release(tc_twin* twin, size_t input) {
  return inside(twin, Use::kAsks, [&] {
    check_input(twin->twin->model(), input, 1);
    twin->twin->release(input);
  });
}

tc_status tc_twin_step(tc_twin* twin, size_t count) {
  return inside(twin, Use::kMoves, [&] {
    if (count == 0) refuse("a number of steps must be > 0");
    moving(twin, *twin->twin, [&] { twin->twin->step(count, twin->parts.polled()); });
  });
}

tc_status tc_twin_run_until(tc_twin* twin, double time, const tc_control* control,
                            double* reached) {
  const tc_status status = inside(twin, Use::kMoves, [&] {
    Twin& both = *twin->twin;
    const Control how = control_of(control, both.lead(), [&both](std::size_t input, double value) {
      both.drive(input, {&value, 1});
    });
    run(twin, time, how, control != nullptr);
  });
  if (reached != nullptr) *reached = tc_twin_time(twin);
  return status;
}

tc_status tc_twin_run_each_until(tc_twin* twin, double time, const tc_control* bsm,
                                 const tc_control* mujoco, double* reached) {
  const tc_status status = inside(twin, Use::kMoves, [&] {
    if (bsm == nullptr || mujoco == nullptr) refuse("each engine needs its control");
    if (bsm->every != mujoco->every) refuse("both engines tick at one rate");
    const auto alone = [twin](const tc_control* control, EngineKind kind) {
      Simulation& one = twin->twin->of(kind);
      return control_of(control, one, [&one](std::size_t input, double value) {
        one.drive(input, {&value, 1});
      });
    };
    const Control first = alone(bsm, EngineKind::kBsm), second = alone(mujoco, EngineKind::kMujoco);
    Control both{bsm->every};
    if (first.stop || second.stop)
      both.stop = [&](double t) {
        const bool enough = first.stop && first.stop(t);
        return (second.stop && second.stop(t)) || enough;
      };
    both.control = [&](double t) {
      if (first.control) first.control(t);
      if (second.control) second.control(t);
    };
    run(twin, time, both, true);
  });
  if (reached != nullptr) *reached = tc_twin_time(twin);
  return status;
}

tc_status tc_twin_snapshot(tc_twin* twin, void* bytes, size_t capacity, size_t* size) {
  return inside(twin, Use::kAsks,
                [&] { hand_over(twin->twin->snapshot(), bytes, capacity, size); });
}

tc_status tc_twin_restore(tc_twin* twin, const void* bytes, size_t size) {
  return inside(twin, Use::kMoves, [&] {
    twin->twin->restore({static_cast<const char*>(bytes), size});
  });
}

tc_status tc_twin_reset(tc_twin* twin) {
  return inside(twin, Use::kMoves, [&] { twin->twin->reset(); });
}

const char* tc_twin_disagreement(tc_twin* twin) {
  inside(twin, Use::kAsks, [&] { twin->disagreement = disagreement_json(*twin->twin); });
  return twin == nullptr ? "" : twin->disagreement.c_str();
}

}  // extern "C"
