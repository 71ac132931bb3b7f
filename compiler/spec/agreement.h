// What the run is judged by: tolerances of the verdict, and references to compare each engine with.
// Tested by tests/compiler/engines_test.cpp.
#pragma once

#include <optional>
#include <vector>

#include "compiler/ir/model.h"
#include "compiler/schema/table.h"

namespace twincraft {

/// Absent: reported, not judged.
struct KeplerToleranceSpec : Written {
  std::optional<double> position;  // [m]
  std::optional<double> velocity;  // [m/s]
};

/// The same, of the references about rotation: `spin_up` and `torque_free`.
struct RotationToleranceSpec : Written {
  std::optional<double> attitude;  // [rad] principal angle
  std::optional<double> rate;      // [rad/s]
};

/// The same.
struct TsiolkovskyToleranceSpec : Written {
  std::optional<double> position;  // [m]
  std::optional<double> velocity;  // [m/s]
  std::optional<double> delta_v;   // relative
};

struct ReferenceTolerancesSpec : Written {
  KeplerToleranceSpec kepler;
  RotationToleranceSpec spin_up, torque_free;
  TsiolkovskyToleranceSpec tsiolkovsky;
};

struct AgreementSpec : Written, AgreementTolerances {
  ReferenceTolerancesSpec references;
};

const Table<AgreementSpec>& agreement_table();

/// A tolerance for a reference that the run is not held against is a warning.
void check(const AgreementSpec& agreement, const std::vector<ReferenceKind>& references,
           Diagnostics& diagnostics);

Agreement lower(const AgreementSpec& agreement);

/// The words of `references`.
Kind<ReferenceKind> reference_kind();

}  // namespace twincraft
