// Where a spec path leads in a spec that was read: to which values, of which unit and shape, and
// what they are. Tested by tests/compiler/campaign_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "compiler/spec/spec.h"

namespace twincraft {

/// A value of the spec that is made of numbers.
struct Place {
  enum class Form { kNumber, kList, kVector, kDirection, kInertia, kAttitude };

  std::string path;  // without `*`: `panels.wing_p.stiffness`
  Form form = Form::kNumber;
  std::string unit;            // SI; `rad` of an attitude
  std::vector<double> values;  // SI; of an inertia its nine entries, of an attitude the
                               // scalar-first quaternion from B components to N
};

/// "a direction", for messages.
std::string describe(Place::Form form);

/// All places of `path`. A path that leads nowhere, or to what is not made of numbers, is reported.
/// @param span  of the text of the path. @param resolved  what spec_table() writes of the spec
std::vector<Place> places_of(const Spec& spec, const Json& resolved,
                             const std::vector<std::string>& path, Span span,
                             Diagnostics& diagnostics);

}  // namespace twincraft
