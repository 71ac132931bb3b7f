// What the run is judged by: tolerances of the verdict, and references to compare each engine with.
// Tested by tests/compiler/engines_test.cpp.
#pragma once

#include <optional>

#include "compiler/ir/model.h"
#include "compiler/schema/table.h"

namespace twincraft {

/// Absent: reported, not judged.
struct AgreementSpec : Written {
  std::optional<double> attitude;  // [rad] principal angle between the engines
  std::optional<double> rate;      // [rad/s]
  std::optional<double> position;  // [m] system centre of mass
  std::optional<double> velocity;  // [m/s] system centre of mass
  std::optional<double> joint;     // [rad]
  std::optional<double> wheel;     // [rad/s]
  std::optional<double> slosh;     // [m]
  std::optional<double> mass;      // [kg]
};

const Table<AgreementSpec>& agreement_table();

Agreement lower(const AgreementSpec& agreement);

/// The words of `references`.
Kind<ReferenceKind> reference_kind();

}  // namespace twincraft
