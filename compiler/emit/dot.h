// Both halves as one Graphviz drawing: links and rotors left, bodies right, a dotted line between a
// link and the body that stands for it. Knows no component. Tested by tests/compiler/emit_test.cpp.
#pragma once

#include <string>

#include "compiler/ir/model.h"

namespace twincraft {

std::string emit_dot(const Model& model);

}  // namespace twincraft
