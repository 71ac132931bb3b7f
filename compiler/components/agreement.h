// What the run is judged by: tolerances of the verdict, and references to compare each engine with.
// Tested by tests/compiler/engines_test.cpp.
#pragma once

#include <optional>

#include "compiler/components/environment.h"

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

/// Report a reference that cannot apply, as far as the spec's sections tell: Kepler's orbit needs
/// gravity, the spin-up of a rigid body nothing that moves on it.
/// @param is_rigid  the vehicle is the hub alone
void check_reference(ReferenceKind reference, Span span, const EnvironmentSpec& environment,
                     bool is_rigid, Diagnostics& diagnostics);

}  // namespace twincraft
