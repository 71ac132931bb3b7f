// The assembly as JSON (NAME.bsm.json, format `twincraft-assembly/1`): everything the analytic
// engine starts from, without loss. Knows no component. Tested by tests/compiler/emit_test.cpp.
#pragma once

#include <string>

#include "compiler/ir/model.h"

namespace twincraft {

/// Keys carry units as in reports; axes are named by the suffix (`_L`: the link's own, `_P`: its
/// parent's). A schedule is `[[time, value], ...]`; time null: the value always held.
std::string emit_bsm(const Model& model);

}  // namespace twincraft
