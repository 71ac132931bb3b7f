// From a spec's text to what is run: loaded, compiled, the members of its study checked.
// Tested by tests/runtime/delivery_test.cpp.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "compiler/pipeline.h"
#include "runtime/delivery/exit_code.h"
#include "runtime/study/run_study.h"

namespace twincraft {

/// A spec, and what it became.
struct CompiledSpec {
  LoadedSpec spec;
  Bundle bundle;
};

struct Compilation {
  std::optional<CompiledSpec> compiled = {};  // nothing when there were errors
  std::string io_error = {};                  // the file could not be read
  bool bad_override = false;                  // an override is no PATH=VALUE

  /// @param diagnostics  of the compilation, and what has been made of its warnings since
  int exit_code(const Diagnostics& diagnostics) const;
};

/// Compiles a spec, and says what is wrong with it and with the members of its study.
Compilation compile_spec(const CompileRequest& request, const Wanted& wanted,
                         Diagnostics& diagnostics, const MemberProgress& progress = {});

/// The targets that a run needs: what MuJoCo loads, and for a report those whose digests it has.
Wanted wanted_by_run(bool reports);

/// A member of a study or a variant as `compile` makes it, or why there is none.
MemberSpec compile_member(
    const std::function<std::optional<Bundle>(Diagnostics& diagnostics)>& compile);

/// Warns, at `simulation.step`, of a step that does not resolve the vehicle's motion.
void foresee_step(const CompiledSpec& compiled, Diagnostics& diagnostics);

}  // namespace twincraft
