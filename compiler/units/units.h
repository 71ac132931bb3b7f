// Quantities: "12 deg", "0.08 kg m2", "15 min". UDUNITS-2 converts; this room decides what is a
// quantity at all, because UDUNITS accepts much that is none (offsets, reciprocals, logarithms,
// products of numbers). Tested by tests/compiler/units_test.cpp.
#pragma once

#include <string>
#include <string_view>

namespace twincraft {

/// The SI unit a field is stored in, spelled as in the reference: "kg m2", "N m/rad", "1". One that
/// is no unit is a bug and throws std::logic_error; an unreadable unit database throws
/// std::runtime_error.
using SiUnit = std::string_view;

struct Quantity {
  double value = 0.0;  // in the SI unit asked for; never negative zero
  std::string error;   // empty: fine
  std::string hint;
  std::string unit = {};  // as written; empty: a plain number
  double factor = 1.0;    // of that unit to the SI unit
};

/// A plain number (already SI) or a number and a unit of the same dimension as `si`. Angles are a
/// dimension of their own, so "12 deg" is no pure number and "5 Hz" no angular rate; but "1 N m"
/// may stand for N m/rad. Decimal multiples ("20 mm") are rounded once, as if written in SI.
/// Finite, decimal notation only: no `0x10`, `010`, `1_000`, `.nan`, `.inf`, and nothing that a
/// double cannot hold.
Quantity parse_quantity(std::string_view text, SiUnit si);

/// A plain decimal number.
Quantity parse_number(std::string_view text);

/// Factor from `unit` to `si`; used by `{value: [...], unit: mm}`.
Quantity unit_factor(std::string_view unit, SiUnit si);

}  // namespace twincraft
