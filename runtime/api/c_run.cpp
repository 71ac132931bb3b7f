// The C interface: runs, proofs and attributions. See include/twincraft.h.
#include <algorithm>
#include <thread>

#include "runtime/api/run_handle.h"
#include "runtime/compare/verdict.h"
#include "runtime/delivery/attribution_run.h"
#include "runtime/delivery/spec_proof.h"
#include "runtime/report/printed_time.h"

namespace twincraft::api {
namespace {

constexpr tc_run_options kDefaults{sizeof(tc_run_options), TC_BOTH, 0, 0, nullptr, nullptr};

void fly_into(tc_run& handle, const tc_run_options& wanted) {
  attend(wanted, [&](const std::atomic<bool>& stop) {
    RunRequest request;
    request.options.bsm = wanted.engines != TC_MUJOCO_ALONE;
    request.options.mujoco = wanted.engines != TC_BSM_ALONE;
    request.options.trials = wanted.trials;
    request.options.stop = &stop;
    request.jobs = jobs_of(wanted.jobs);
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
    request.jobs = jobs_of(wanted.jobs);
    const AttributionRun run = attribute({handle.model->spec(), handle.model->bundle()}, request);
    if (stop) end_interrupted();
    handle.text = run.text() + run.complaint();
    handle.json = run.json();
    handle.passes = run.exit_code() == 0;
    handle.verdict = run.complete() ? "explained" : "unexplained";
  });
}

}  // namespace

int jobs_of(int wanted) {
  return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace twincraft::api

using namespace twincraft;
using namespace twincraft::api;

extern "C" {

tc_status tc_model_run(const tc_model* model, const tc_run_options* options, tc_run** run) {
  return make_run(model, run,
                  [options](tc_run& h) { fly_into(h, options ? *options : kDefaults); });
}

tc_status tc_model_prove(const tc_model* model, const tc_run_options* options, tc_run** proof) {
  return make_run(model, proof,
                  [options](tc_run& h) { prove_into(h, options ? *options : kDefaults); });
}

tc_status tc_model_attribute(const tc_model* model, const tc_run_options* options,
                             tc_run** attribution) {
  return make_run(model, attribution,
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
    if (!run->run && !run->campaign) refuse("a proof or an attribution has no files");
    if (folder == nullptr || *folder == '\0') refuse("a folder must have a name");
    const std::string error =
        run->run ? run->run->save(folder) : save_campaign(*run->campaign, folder);
    if (!error.empty()) throw Fault(TC_FILE, error);
  });
}

}  // extern "C"
