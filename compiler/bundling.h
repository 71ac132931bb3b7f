// A model and what it was made of become a bundle: the wanted targets, what they say in
// diagnostics, and what changed the spec.
#pragma once

#include <string>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/ir/bundle.h"
#include "compiler/pipeline.h"
#include "compiler/spec/spec.h"
#include "compiler/syntax/overrides.h"

namespace twincraft {

/// A spec as bundles name it.
struct Origin {
  std::string file;
  std::string sha256;  // of all files it is made of
};

/// @param changes  that made the spec what it is
/// @pre every name in `wanted` is a target's
Bundle emit(Model model, const Spec& spec, const Origin& origin,
            const std::vector<Override>& changes, const Wanted& wanted, Diagnostics& diagnostics);

}  // namespace twincraft
