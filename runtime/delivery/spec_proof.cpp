// See spec_proof.h.
#include "runtime/delivery/spec_proof.h"

#include "runtime/delivery/exit_code.h"
#include "runtime/report/proof_json.h"

namespace twincraft {

int SpecProof::exit_code() const { return holds() ? kExitDone : kExitFindings; }

std::string SpecProof::json() const { return proof_json(report_, name_); }

SpecProof prove_spec(const Bundle& bundle, const ProofProgress& progress) {
  return SpecProof(prove(bundle, progress), bundle.model.name);
}

}  // namespace twincraft
