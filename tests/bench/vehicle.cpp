#include "tests/bench/vehicle.h"

#include "compiler/diag/print.h"
#include "compiler/pipeline.h"

namespace twincraft::bench {

Bundle compiled(const std::string& spec, const std::vector<std::string>& settings) {
  Diagnostics diagnostics;
  const LoadResult loaded = load_spec({spec, settings}, diagnostics);
  if (!loaded.io_error.empty()) throw BadSpec(loaded.io_error);
  std::optional<Bundle> bundle;
  if (loaded.spec) bundle = loaded.spec->compile({kMjcf}, diagnostics);
  if (!bundle) throw BadSpec(to_text(diagnostics, {}));
  bundle->model.simulation.method = Method::kRk4;
  return *std::move(bundle);
}

void set_steps(Model& model, long steps) {
  model.simulation.duration = static_cast<double>(steps) * model.simulation.step;
}

}  // namespace twincraft::bench
