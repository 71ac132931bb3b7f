// Are the two targets of a spec one machine? What `sccompile SPEC --check` does but read flags and
// print.  Tested by tests/runtime/delivery_test.cpp.
#pragma once

#include <string>

#include "compiler/ir/bundle.h"
#include "runtime/compare/proof.h"

namespace twincraft {

/// A proof that has been made or refused.
class SpecProof {
 public:
  explicit SpecProof(ProofReport report, std::string name)
      : report_(std::move(report)), name_(std::move(name)) {}

  const ProofReport& report() const { return report_; }
  bool holds() const { return report_.pass(); }
  int exit_code() const;

  /// What sccompile prints.
  std::string text() const { return to_text(report_); }
  /// The same for programs, format `twincraft-proof/1`.
  std::string json() const;

 private:
  ProofReport report_;
  std::string name_;  // of the spec
};

/// @param bundle  of at least kMjcf
SpecProof prove_spec(const Bundle& bundle, const ProofProgress& progress = {});

}  // namespace twincraft
