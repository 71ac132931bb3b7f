// For tests that start from a spec without faults.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "compiler/diag/print.h"
#include "compiler/pipeline.h"

namespace twincraft::test {

/// @throws std::runtime_error with the diagnostics, when there are errors
inline Bundle compiled(const CompileRequest& request,
                       const Wanted& wanted = {kMjcf, kAssemblyJson, kResolved}) {
  Diagnostics diagnostics;
  const LoadResult loaded = load_spec(request, diagnostics);
  std::optional<Bundle> bundle;
  if (loaded.spec) bundle = loaded.spec->compile(wanted, diagnostics);
  if (!bundle) throw std::runtime_error(loaded.io_error + to_text(diagnostics, {}));
  return *std::move(bundle);
}

/// @param file  from the root of the repository
inline Bundle compiled_file(const std::string& file, std::vector<std::string> overrides = {}) {
  return compiled({std::string(TWINCRAFT_ROOT) + "/" + file, std::move(overrides)});
}

}  // namespace twincraft::test
