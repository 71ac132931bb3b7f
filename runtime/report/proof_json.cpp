// See proof_json.h.
#include "runtime/report/proof_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/compare/random_state.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

/// Of all rows; NaN, which no number exceeds, when one has it.
double worst_difference(const ProofReport& report) {
  double worst = 0.0;
  for (const ProofLine& line : report.lines)
    if (std::isnan(line.difference) || line.difference > worst) worst = line.difference;
  return worst;
}

Json row_json(const ProofLine& line) {
  return {{"what", line.what},
          {"difference", line.difference},
          {"bound", line.bound},
          {"where", line.where},
          {"pass", line.pass()}};
}

}  // namespace

std::string proof_json(const ProofReport& report, std::string_view name) {
  Json json{{"format", "twincraft-proof/1"},
            {"name", name},
            {"holds", report.pass()},
            {"refusal", report.refusal},
            {"states", kProofStates},
            {"seed", kStateSeed},
            {"worst_relative_difference",
             report.lines.empty() ? Json(nullptr) : Json(worst_difference(report))},
            {"rows", Json::array()},
            {"remarks", report.remarks}};
  for (const ProofLine& line : report.lines) json["rows"].push_back(row_json(line));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace twincraft
