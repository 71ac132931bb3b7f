// What one compilation hands on: the model and the very bytes it is written as.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compiler/ir/model.h"
#include "compiler/ir/study.h"

namespace twincraft {

struct Bundle {
  Model model;
  std::string mjcf;               // NAME.xml: what the MuJoCo engine loads; empty when refused
  std::string assembly_json;      // NAME.bsm.json
  std::string resolved_yaml;      // NAME.resolved.yaml: every default filled in, SI units
  std::string resolved_json;      // the same for reports
  std::string spec_file;          // as given
  std::string spec_sha256;        // of the bytes of the spec and of all it extends
  std::vector<Setting> settings;  // what the command line and a study changed, in that order
  std::map<std::string, std::string> emitted_sha256;  // of mjcf, bsm and resolved, as written
};

}  // namespace twincraft
