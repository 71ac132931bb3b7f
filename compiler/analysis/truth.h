// Exact motions that a run can be compared with, and which vehicles have one. The compiler refuses
// the others at the word in `references`; the runtime (runtime/reference) computes the motions.
// Tested by tests/runtime/reference_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compiler/ir/model.h"

namespace twincraft {

std::string_view reference_name(ReferenceKind kind);  // as in the spec

/// Why `kind` is not the exact motion of `model` under this gravity law; nothing when it is.
std::optional<std::string> inapplicable(ReferenceKind kind, const Model& model, GravityLaw law);
/// The same under the laws of both engines.
std::optional<std::string> inapplicable(ReferenceKind kind, const Model& model);

/// Every kilogram sits at the vehicle's centre of mass for good, in either half of the model, so
/// that a force on each element is one force at C and has no torque about it.
bool all_mass_at_one_point(const Model& model);

/// Of the hub link at `time` [s], fixed bodies and tanks on it included.
MassProperties hub_properties(const Model& model, double time = 0.0);

/// Force of all loads at `time` [s] when the vehicle is its hub, hub axes [N].
Vector3d load_force(const Model& model, double time);
/// Their torque about C [N m], hub axes.  @param r_CB_B  [m]
Vector3d load_torque(const Model& model, double time, const Vector3d& r_CB_B);

/// 0, the times [s] before the end at which an input changes, and the end.
std::vector<double> phases(const Model& model);

}  // namespace twincraft
