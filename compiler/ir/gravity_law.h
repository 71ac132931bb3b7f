// The laws of gravity as specs and artefacts write them.
#pragma once

#include <string_view>

#include "compiler/ir/model.h"

namespace twincraft {

constexpr std::string_view word_of(GravityLaw law) {
  switch (law) {
    case GravityLaw::kNone:
      return "none";
    case GravityLaw::kSystemCom:
      return "system_com";
    case GravityLaw::kBodyCom:
      return "body_com";
    case GravityLaw::kBodyGradient:
      return "body_gradient";
  }
  return {};
}

}  // namespace twincraft
