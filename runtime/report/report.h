// What a run of scsim has to say, before anyone decides how to print it. The printers of this room
// (json, csv, table) return text; the program writes it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compiler/ir/bundle.h"
#include "runtime/report/provenance.h"
#include "runtime/study/run.h"

namespace twincraft {

/// One member of a study and what made it.
struct ReportedMember {
  Bundle bundle;
  std::vector<std::pair<std::string, std::string>> settings;  // spec path, value as written
  Member result;
};

struct Report {
  Provenance provenance;
  std::vector<ReportedMember> members;  // at least one

  bool complete() const;
  /// kDisagree if any member disagrees; kAgree only if every member agrees.
  Verdict verdict() const;
};

}  // namespace twincraft
