#include "tests/bench/vehicle.h"

#include "compiler/diag/print.h"
#include "compiler/pipeline.h"

namespace twincraft::bench {

Bundle compiled(const std::string& spec, const std::vector<std::string>& settings) {
  Sources sources;
  Diagnostics diagnostics;
  CompileResult result = compile({spec, settings}, sources, diagnostics);
  if (!result.io_error.empty()) throw BadSpec(result.io_error);
  if (!result.bundle) throw BadSpec(to_text(diagnostics, {}));
  result.bundle->model.simulation.method = Method::kRk4;
  return std::move(*result.bundle);
}

void set_steps(Model& model, long steps) {
  model.simulation.duration = static_cast<double>(steps) * model.simulation.step;
}

}  // namespace twincraft::bench
