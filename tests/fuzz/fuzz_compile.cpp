// Any text compiles into both targets or is refused with words. An InternalError, by which the
// compiler contradicts itself, ends the process as a crash does. Text that names another file is
// left out: what it does would depend on the folder the harness runs in.
#include <cstddef>
#include <cstdint>
#include <string>

#include "compiler/diag/print.h"
#include "compiler/pipeline.h"
#include "tests/fuzz/claim.h"

using namespace twincraft;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  if (text.find("extends") != std::string::npos) return 0;
  // Ten thousand members are ten thousand times the same code.
  if (text.find("sweep") != std::string::npos) return 0;
  Sources sources;
  Diagnostics diagnostics;
  CompileRequest request;
  request.file = "fuzz.yaml";
  request.text = std::move(text);
  const CompileResult result = compile(request, sources, diagnostics);
  fuzz::claim(result.io_error.empty());
  fuzz::claim(result.bundle.has_value() != diagnostics.has_errors());
  to_text(diagnostics, {});
  if (!result.bundle) return 0;
  fuzz::claim(!result.bundle->assembly_json.empty() && !result.bundle->resolved_yaml.empty());
  fuzz::claim(result.bundle->mjcf.empty() != result.bundle->model.mujoco_refusal.empty());
  return 0;
}
