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
  Diagnostics diagnostics;
  CompileRequest request;
  request.file = "fuzz.yaml";
  request.text = std::move(text);
  const LoadResult loaded = load_spec(request, diagnostics);
  fuzz::claim(loaded.io_error.empty());
  std::optional<Bundle> bundle;
  if (loaded.spec) bundle = loaded.spec->compile({kMjcf, kAssemblyJson, kResolved}, diagnostics);
  fuzz::claim(bundle.has_value() != diagnostics.has_errors());
  to_text(diagnostics, {});
  if (!bundle) return 0;
  fuzz::claim(!bundle->text(kAssemblyJson).empty() && !bundle->text(kResolved).empty());
  fuzz::claim(bundle->text(kMjcf).empty() != bundle->model.mujoco_refusal.empty());
  return 0;
}
