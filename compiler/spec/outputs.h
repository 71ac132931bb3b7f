// Numbers made of signals: what a campaign or a sweep asks of every member's flight, and what stops
// one early. Units follow from the signal, so bounds are kept as written until the model is there.
// Tested by tests/compiler/campaign_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/ir/campaign.h"
#include "compiler/ir/model.h"
#include "compiler/schema/table.h"

namespace twincraft {

/// What a number must be.
struct RequireSpec : Written {
  std::optional<Node> below, above;
};

struct OutputSpec : Written {
  std::string name;
  std::string of;  // a signal
  Reduce reduce = Reduce::kFinal;
  std::optional<Node> within;  // of kSettlingTime
  std::optional<Node> level;   // of kFirstCrossing
  std::optional<RequireSpec> require;
};

struct StopSpec : Written {
  std::string of;  // a signal
  std::optional<Node> below, above;
};

const Table<OutputSpec>& output_table();
const Table<StopSpec>& stop_table();

/// Report unknown signals, reductions that do not fit them, bounds of other dimensions, and names
/// that are taken twice; the plans are complete when there was no error.
std::vector<OutputPlan> plan_of(const std::vector<OutputSpec>& outputs, const Model& model,
                                Diagnostics& diagnostics);
/// The same for what stops a member.
std::vector<StopPlan> plan_of(const std::vector<StopSpec>& stops, const Model& model,
                              Diagnostics& diagnostics);

}  // namespace twincraft
