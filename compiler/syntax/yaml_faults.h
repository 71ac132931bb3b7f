// What yaml-cpp throws, in plain words and at the place where the mistake is rather than where it
// was noticed. Tested by tests/compiler/load_test.cpp.
#pragma once

#include <yaml-cpp/exceptions.h>

#include "compiler/syntax/tree_builder.h"

namespace twincraft {

void report_yaml_fault(const YAML::Exception& fault, const TreeBuilder& builder,
                       const Source& source, Diagnostics& diagnostics);

}  // namespace twincraft
