// What a target makes of a model: the text of its file, and what is to be said in diagnostics.
#pragma once

#include <string>
#include <vector>

namespace twincraft {

struct Remark {
  std::string component;    // by its name; empty: the vehicle as a whole
  std::string text;         // lower case, no full stop
  bool is_refusal = false;  // a part of the target cannot have it; else it is written otherwise

  bool operator==(const Remark&) const = default;
};

struct Printed {
  std::string text = {};             // empty where the model cannot be written so
  std::string refusal = {};          // why it cannot; empty: it can
  std::vector<Remark> remarks = {};  // at its components
};

}  // namespace twincraft
