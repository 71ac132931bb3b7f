// The C interface: runs, proofs and attributions. See include/twincraft.h.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <optional>
#include <thread>

#include "runtime/api/handles.h"
#include "runtime/compare/verdict.h"
#include "runtime/delivery/attribution_run.h"
#include "runtime/delivery/spec_proof.h"
#include "runtime/delivery/spec_run.h"
#include "runtime/report/printed_time.h"

/// One of the three, and the texts that were asked for.
struct tc_run {
  std::shared_ptr<const twincraft::api::CompiledModel> model;
  std::optional<twincraft::SpecRun> run;
  std::string verdict, text, json;
  bool passes = false;
  twincraft::api::HandleParts parts;

  bool is_whole() const { return !verdict.empty(); }
};

namespace twincraft::api {
namespace {

constexpr tc_run_options kDefaults{sizeof(tc_run_options), TC_BOTH, 0, 0, nullptr, nullptr};

int cores() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

/// Do `work(stop)`, which ends early when `stop` becomes true, and meanwhile ask the poll: from
/// this thread, which called the library.
template <class Work>
void attend(const tc_run_options& wanted, const Work& work) {
  check_struct(&wanted);
  std::atomic<bool> stop = false;
  if (wanted.poll == nullptr) return work(stop);
  std::future<void> done = std::async(std::launch::async, [&] { work(stop); });
  while (done.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready)
    if (!stop && wanted.poll(wanted.context) != 0) stop = true;
  done.get();
}

[[noreturn]] void end_interrupted() { throw Fault(TC_INTERRUPTED, "interrupted"); }

int jobs_of(const tc_run_options& wanted) { return wanted.jobs > 0 ? wanted.jobs : cores(); }

void fly_into(tc_run& handle, const tc_run_options& wanted) {
  attend(wanted, [&](const std::atomic<bool>& stop) {
    RunRequest request;
    request.options.bsm = wanted.engines != TC_MUJOCO_ALONE;
    request.options.mujoco = wanted.engines != TC_BSM_ALONE;
    request.options.trials = wanted.trials;
    request.options.stop = &stop;
    request.jobs = jobs_of(wanted);
    request.keeps_results = true;
    handle.run = fly({handle.model->spec(), handle.model->bundle()}, request);
    if (handle.run->empty()) end_interrupted();
    handle.text = handle.run->text();
    handle.json = handle.run->json();
    handle.passes = handle.run->exit_code() == 0;
    handle.verdict = verdict_name(handle.run->verdict());
  });
}

void prove_into(tc_run& handle, const tc_run_options& wanted) {
  attend(wanted, [&](const std::atomic<bool>& stop) {
    const SpecProof proof = prove_spec(handle.model->bundle(), [&stop](double) {
      if (stop) end_interrupted();
    });
    handle.text = proof.text();
    handle.json = proof.json();
    handle.passes = proof.holds();
    handle.verdict = proof.holds() ? "proved" : "refuted";
  });
}

void attribute_into(tc_run& handle, const tc_run_options& wanted) {
  attend(wanted, [&](const std::atomic<bool>& stop) {
    AttributionRequest request;
    request.options.trials = 0;
    request.options.stop = &stop;
    request.jobs = jobs_of(wanted);
    const AttributionRun run = attribute({handle.model->spec(), handle.model->bundle()}, request);
    if (stop) end_interrupted();
    handle.text = run.text() + run.complaint();
    handle.json = run.json();
    handle.passes = run.exit_code() == 0;
    handle.verdict = run.complete() ? "explained" : "unexplained";
  });
}

template <class Body>
tc_status make(const tc_model* model, tc_run** run, const Body& body) noexcept {
  if (model == nullptr || !model->is_whole() || run == nullptr) return TC_USAGE;
  *run = new (std::nothrow) tc_run;
  if (*run == nullptr) return TC_MEMORY;
  tc_run& handle = **run;
  handle.model = model->model;
  return attempt(handle.parts.error, [&] { body(handle); });
}

}  // namespace
}  // namespace twincraft::api

using namespace twincraft;
using namespace twincraft::api;

extern "C" {

tc_status tc_model_run(const tc_model* model, const tc_run_options* options, tc_run** run) {
  return make(model, run, [options](tc_run& h) { fly_into(h, options ? *options : kDefaults); });
}

tc_status tc_model_prove(const tc_model* model, const tc_run_options* options, tc_run** proof) {
  return make(model, proof,
              [options](tc_run& h) { prove_into(h, options ? *options : kDefaults); });
}

tc_status tc_model_attribute(const tc_model* model, const tc_run_options* options,
                             tc_run** attribution) {
  return make(model, attribution,
              [options](tc_run& h) { attribute_into(h, options ? *options : kDefaults); });
}

void tc_run_free(tc_run* run) { delete run; }

const char* tc_run_error(const tc_run* run) {
  return run == nullptr ? "out of memory" : run->parts.error.c_str();
}

const char* tc_run_verdict(const tc_run* run) { return run == nullptr ? "" : run->verdict.c_str(); }

int tc_run_passes(const tc_run* run) { return run != nullptr && run->passes ? 1 : 0; }

const char* tc_run_json(const tc_run* run) { return run == nullptr ? "" : run->json.c_str(); }

const char* tc_run_text(const tc_run* run) { return run == nullptr ? "" : run->text.c_str(); }

size_t tc_run_samples(const tc_run* run, tc_engine engine) {
  if (run == nullptr || !run->run) return 0;
  return run->run->trajectory(engine == TC_MUJOCO ? EngineKind::kMujoco : EngineKind::kBsm)
      .samples.size();
}

tc_status tc_run_read(tc_run* run, tc_engine engine, double* rows, size_t size) {
  return inside(run, Use::kAsks, [&] {
    const std::size_t samples = tc_run_samples(run, engine);
    const std::size_t width = 1 + run->model->outputs().size();
    check_size(size, samples * width, "samples");
    const Trajectory* trajectory =
        samples == 0
            ? nullptr
            : &run->run->trajectory(engine == TC_MUJOCO ? EngineKind::kMujoco : EngineKind::kBsm);
    const PrintedTime printed(run->model->model().simulation.step);  // as in the CSV
    for (std::size_t i = 0; i < samples; ++i) {
      const Observation& seen = trajectory->samples[i];
      rows[i * width] = printed(seen.time);
      read_signals(run->model->output_signals(), seen, {rows + i * width + 1, width - 1});
    }
  });
}

tc_status tc_run_save(tc_run* run, const char* folder) {
  return inside(run, Use::kAsks, [&] {
    if (!run->run) refuse("a proof or an attribution has no files");
    if (folder == nullptr || *folder == '\0') refuse("a folder must have a name");
    if (const std::string error = run->run->save(folder); !error.empty())
      throw Fault(TC_FILE, error);
  });
}

}  // extern "C"
