// See room.h.
#include "runtime/delivery/room.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "compiler/ir/number.h"
#include "runtime/delivery/estimate.h"
#include "runtime/study/in_order.h"

namespace twincraft {
namespace {

/// Trajectories that a study has in memory at a time, of both engines.
double compared_trajectories(const StudyPlan& plan, int jobs) {
  if (!plan.compare) return 0.0;
  // Of a grid there is a baseline for each combination of the paths that change faster.
  double baselines = 1.0;
  for (std::size_t path = *plan.compare + 1; plan.is_grid && path < plan.lengths.size(); ++path)
    baselines *= static_cast<double>(plan.lengths[path]);
  return 2.0 * (baselines + (1.0 + kEarlyResults) * jobs);
}

/// Where the files go while it is flown; empty: there are none.
std::string folder_of(const RunRequest& request, bool is_study) {
  if (!request.keeps_results || !is_study) return request.folder;
  std::error_code ignored;
  return std::filesystem::temp_directory_path(ignored).string();
}

}  // namespace

bool check_memory(const CompiledSpec& compiled, const RunRequest& request,
                  Diagnostics& diagnostics) {
  double trajectories = request.keeps_results ? 2.0 : 0.0;
  if (const StudyPlan* const study = compiled.spec.study())
    trajectories += compared_trajectories(*study, request.options.trials > 0 ? 1 : request.jobs);
  return check_memory(compiled, trajectories, diagnostics);
}

bool check_memory(const CompiledSpec& compiled, double trajectories, Diagnostics& diagnostics) {
  const Model& model = compiled.bundle.model;
  const double needed = trajectories * trajectory_bytes(model);
  if (needed <= kMostMemory) return true;
  diagnostics
      .error(
          Code::kTooManySteps, compiled.spec.simulation_span("record"),
          fmt::format("{:.3g} samples of {} trajectories, which this analysis keeps, take {}, "
                      "more than {}",
                      samples_of(model), trajectories, size_words(needed), size_words(kMostMemory)))
      .with_hint(fmt::format("raise `simulation.record` to {} s or more",
                             shortest(record_that_fits(model, trajectories))));
  return false;
}

std::string check_disk(const CompiledSpec& compiled, const RunRequest& request) {
  const Model& model = compiled.bundle.model;
  const StudyPlan* const study = compiled.spec.study();
  const std::string folder = folder_of(request, study != nullptr);
  if (folder.empty()) return {};
  const double members = study != nullptr ? static_cast<double>(study->members) : 1.0;
  const bool both = request.options.bsm && request.options.mujoco && model.mujoco_refusal.empty();
  const double bytes = members * (both ? 2.0 : 1.0) * file_bytes(model, request.netcdf);
  return check_room(folder, bytes, free_bytes(folder),
                    std::max(model.simulation.record, model.simulation.step));
}

}  // namespace twincraft
