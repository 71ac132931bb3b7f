// Are the two halves of a compiled model one machine? Mass properties and coordinates first, then
// mass matrices and accelerations of both engines at random states, long before any trajectory: a
// difference found here names a formulation, never an integrator. What `sccompile --check` prints.
// Tested by tests/runtime/proof_test.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compiler/ir/bundle.h"
#include "runtime/engine/engine.h"

namespace twincraft {

/// Relative differences up to this are rounding. Shallow trees come out near 1e-14; a chain of 32
/// segments loses about four digits more in MuJoCo's factorisation alone (4e-11). A difference of
/// formulation is many orders larger. What an engine computes may differ further by the rounding of
/// terms that are larger than their sum (RoundingTerms); the numbers it was built of may not.
inline constexpr double kProofBound = 1.0e-10;

inline constexpr int kProofStates = 100;

/// One thing compared.
struct ProofLine {
  std::string what;         // `hub angular acceleration`
  double difference = 0.0;  // relative; the worst against its bound
  std::string where;        // `state 17, wing_p.2`; empty when it is one comparison
  double bound = kProofBound;
  bool pass() const { return difference <= bound; }
};

struct ProofReport {
  std::vector<ProofLine> lines;
  std::vector<std::string> remarks;  // why the spec itself makes the halves differ
  std::string refusal;               // why no proof could be made; empty when it was made

  bool pass() const;
};

/// Called at every state: how much is done, 0 to 1.
using ProofProgress = std::function<void(double fraction)>;

/// Compare the halves of `bundle` at kProofStates seeded states; the same everywhere.
ProofReport prove(const Bundle& bundle, const ProofProgress& progress = {});

/// The same for two given engines of one model.
ProofReport prove(const Model& model, Engine& a, Engine& b, const ProofProgress& progress = {});

/// The report as a table for people.
std::string to_text(const ProofReport& report);

}  // namespace twincraft
