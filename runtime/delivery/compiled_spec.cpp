// See compiled_spec.h.
#include "runtime/delivery/compiled_spec.h"

#include <utility>

#include "runtime/linear/resolution.h"

namespace twincraft {

int Compilation::exit_code(const Diagnostics& diagnostics) const {
  if (!io_error.empty()) return kExitInputOutput;
  if (bad_override) return kExitUsage;
  return compiled && !diagnostics.has_errors() ? kExitDone : kExitFindings;
}

Compilation compile_spec(const CompileRequest& request, const Wanted& wanted,
                         Diagnostics& diagnostics, const MemberProgress& progress) {
  LoadResult loaded = load_spec(request, diagnostics);
  Compilation made{{}, std::move(loaded.io_error), loaded.bad_override};
  if (!made.io_error.empty() || !loaded.spec) return made;
  std::optional<Bundle> bundle = loaded.spec->compile(wanted, diagnostics);
  if (!bundle) return made;
  loaded.spec->check_members(diagnostics, progress);
  if (!diagnostics.has_errors())
    made.compiled = CompiledSpec{*std::move(loaded.spec), *std::move(bundle)};
  return made;
}

Wanted wanted_by_run(bool reports) {
  if (!reports) return {kMjcf};
  return {kMjcf, kAssemblyJson, kResolved};
}

MemberSpec compile_member(
    const std::function<std::optional<Bundle>(Diagnostics& diagnostics)>& compile) {
  Diagnostics diagnostics;
  MemberSpec spec{compile(diagnostics), {}};
  for (const Diagnostic& fault : diagnostics.all())
    if (!spec.bundle && fault.severity == Severity::kError && spec.refusal.empty())
      spec.refusal = fault.message;
  return spec;
}

void foresee_step(const CompiledSpec& compiled, Diagnostics& diagnostics) {
  const Resolution foreseen = foresee_resolution(compiled.bundle.model);
  if (foreseen.resolved) return;
  diagnostics.warning(Code::kUnresolvedStep, compiled.spec.simulation_span("step"),
                      foreseen.reasons.front());
}

}  // namespace twincraft
