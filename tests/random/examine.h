// All that must hold for any vehicle, on one of them: it compiles, its halves are one machine, its
// engines and a third one accelerate alike, the books balance, MuJoCo reads back what was written,
// and the resolved spec, the spec in two files and the member of a study are the same spec.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace twincraft::random_vehicles {

/// What does not hold. `check` names it in a word or two, `detail` is for people.
struct Finding {
  std::string check;
  std::string detail;
};

/// Of every check the worst number met, and the vehicle that had it.
struct Worst {
  double value = 0.0;
  std::string vehicle;
};
using Record = std::map<std::string, Worst>;

/// The first thing that is wrong with a spec. Any thread may call.
/// @param name  for the record, which is added to
std::optional<Finding> examine(const std::string& text, const std::string& name, Record& record);

}  // namespace twincraft::random_vehicles
