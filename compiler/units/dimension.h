// Dimensions as powers of base units, and their names in messages. The radian is a base unit here:
// UDUNITS converts angles to pure numbers, which hides a forgotten `deg`.
// Tested by tests/compiler/units_test.cpp.
#pragma once

#include <map>
#include <string>

namespace twincraft {

/// Base unit ("kg", "m", "s", "rad", ...) to its power, none of them 0; empty for a pure number.
using Dimension = std::map<std::string, int>;

/// Whether a quantity of dimension `given` may be used where `expected` is asked for. "per radian"
/// may be left away, because torsional stiffness is often written in N m.
bool fits(const Dimension& given, const Dimension& expected);

/// "a mass", "an angular rate"; "a quantity in A m2" for a dimension without a name.
std::string describe(const Dimension& dimension);

}  // namespace twincraft
