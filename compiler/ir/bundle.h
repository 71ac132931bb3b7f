// What one compilation hands on: the model and the very bytes it is written as.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/ir/model.h"
#include "compiler/ir/study.h"

namespace twincraft {

// Targets that are asked for by name. compiler/emit/target.h has the table of all.
inline constexpr const char* kMjcf = "mjcf";          // what the MuJoCo engine loads
inline constexpr const char* kAssemblyJson = "bsm";   // what the analytic engine starts from
inline constexpr const char* kResolved = "resolved";  // every default filled in, SI units
inline constexpr const char* kBasilisk = "basilisk";  // what flies it in Basilisk

/// The model as one target writes it.
struct Emitted {
  std::string text;
  std::string sha256;
};

struct Bundle {
  Model model;
  // By name, those that were wanted; of one that the model refuses the reason.
  std::map<std::string, Emitted, std::less<>> emitted;
  std::map<std::string, std::string, std::less<>> refused;
  std::string resolved_json;      // what kResolved says, for programs; empty unless it was wanted
  std::string spec_file;          // as given
  std::string spec_sha256;        // of the bytes of the spec and of all it extends
  std::vector<Setting> settings;  // what the command line and a study changed, in that order

  /// Empty when the bundle does not hold it.
  const std::string& text(std::string_view target) const;
};

}  // namespace twincraft
