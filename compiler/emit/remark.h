// What a target has to say of a model, for a diagnostic at the component.
#pragma once

#include <string>

namespace twincraft {

struct Remark {
  std::string component;    // by its name; empty: the vehicle as a whole
  std::string text;         // lower case, no full stop
  bool is_refusal = false;  // a part of the target cannot have it; else it is written otherwise

  bool operator==(const Remark&) const = default;
};

}  // namespace twincraft
