// UDUNITS knows the names; what a unit is made of we ask by its visitor, because its own conversion
// also accepts reciprocals, offsets and angles for numbers. Its parser has global state, so one
// lock guards all of it. Tested by tests/compiler/units_test.cpp.
#include "compiler/units/unit_system.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/units/unit_database.h"
#include "compiler/units/unit_text.h"

namespace twincraft {
namespace {

using UnitHandle = std::unique_ptr<ut_unit, decltype([](ut_unit* unit) { ut_free(unit); })>;
using SystemHandle =
    std::unique_ptr<ut_system, decltype([](ut_system* system) { ut_free_system(system); })>;

/// Units whose names people write and UDUNITS does not know, or knows to seven digits only.
struct OwnUnit {
  const char* name;
  double factor;
  const char* of;
};

constexpr OwnUnit kOwnUnits[] = {
    {"deg", std::numbers::pi / 180.0, "rad"},
    {"degs", std::numbers::pi / 180.0, "rad"},
    {"rads", 1.0, "rad"},
    {"rev", 2.0 * std::numbers::pi, "rad"},
    {"revs", 2.0 * std::numbers::pi, "rad"},
    {"RPM", std::numbers::pi / 30.0, "rad/s"},
    {"mas", std::numbers::pi / (180.0 * 3600.0e3), "rad"},
    {"Nm", 1.0, "N.m"},
    {"Nms", 1.0, "N.m.s"},
    {"Ns", 1.0, "N.s"},
    {"mins", 60.0, "s"},
    {"hrs", 3600.0, "s"},
    {"AU", 149597870700.0, "m"},
    // UDUNITS rounds these, so that a pound-force would not accelerate a slug by 1 ft/s2.
    {"slug", 1.0, "lbf.s2/ft"},
    {"slugs", 1.0, "lbf.s2/ft"},
    {"avoirdupois_ounce", 1.0 / 16.0, "pound"},
    {"avoirdupois_ounces", 1.0 / 16.0, "pound"},
    {"short_hundredweight", 100.0, "pound"},
    {"short_hundredweights", 100.0, "pound"},
    {"long_hundredweight", 112.0, "pound"},
    {"long_hundredweights", 112.0, "pound"},
};

/// For "did you mean"; the database has thousands of names, most of them no help.
const std::vector<std::string> kCommonUnits{
    "kg",  "g",  "t",  "lb",  "m",  "km", "cm",  "mm",  "um",   "nm",  "ft",     "in",     "AU",
    "s",   "ms", "us", "min", "h",  "hr", "day", "rad", "mrad", "deg", "arcmin", "arcsec", "rev",
    "rpm", "Hz", "N",  "mN",  "kN", "Nm", "mNm", "Nms", "J",    "W",   "Pa",     "K"};

/// Abbreviations that are no units by themselves.
constexpr std::pair<std::string_view, std::string_view> kAbbreviations[] = {
    {"dps", "deg/s"}, {"mps", "m/s"},   {"kmps", "km/s"},   {"kmh", "km/h"},
    {"kph", "km/h"},  {"rps", "rev/s"}, {"radps", "rad/s"}, {"degps", "deg/s"}};

bool is_common(const std::string& name) {
  return std::ranges::find(kCommonUnits, name) != kCommonUnits.end();
}

/// `kgm` as `kg m`: a product whose blanks were left out. Empty when it is none.
/// @param units  at most so many, because there are exponentially many ways to read `mmmm...`
std::string taken_apart(const std::string& name, int units = 4) {
  if (name.ends_with('s') && is_common(name.substr(0, name.size() - 1))) return {};  // a plural
  for (std::size_t length = 1; length < name.size(); ++length) {
    const std::string first = name.substr(0, length);
    const std::string rest = name.substr(length);
    if (!is_common(first)) continue;
    if (is_common(rest)) return fmt::format("{} {}", first, rest);
    if (units == 2) continue;
    if (const std::string parts = taken_apart(rest, units - 1); !parts.empty())
      return fmt::format("{} {}", first, parts);
  }
  return {};
}

/// The whole unit with what is meant in the place of `culprit`; empty when nobody knows.
std::string meant_unit(const std::string& culprit, const std::string& unit) {
  std::string meant = taken_apart(culprit);
  for (const auto& [abbreviation, full] : kAbbreviations)
    if (culprit == abbreviation) meant = full;
  if (meant.empty()) return {};
  return std::string(unit).replace(unit.find(culprit), culprit.size(), meant);
}

/// A power of ten that UDUNITS computed, such as the square of 1e-6, is made the nearest double.
double cleaned(double factor) {
  const double exponent = std::round(std::log10(factor));
  if (!(std::abs(exponent) < 300.0)) return factor;
  const std::string text = fmt::format("1e{}", static_cast<int>(exponent));
  double power = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), power);
  constexpr double kRounding = 1e-14;  // of a few products of prefixes
  return std::abs(factor / power - 1.0) < kRounding ? power : factor;
}

/// Collects factor and base units of a unit of UDUNITS into a Unit.
class Dissection {
 public:
  static Unit of(const ut_unit* unit) {
    Unit result;
    ut_accept_visitor(unit, &visitor(), &result);
    result.factor = cleaned(result.factor);
    return result;
  }

 private:
  static const ut_visitor& visitor() {
    static const ut_visitor functions{visit_basic, visit_product, visit_scaled, visit_time,
                                      visit_logarithm};
    return functions;
  }

  static ut_status visit_basic(const ut_unit* unit, void* result) {
    const int one = 1;
    return visit_product(unit, 1, &unit, &one, result);
  }

  static ut_status visit_product(const ut_unit*, int count, const ut_unit* const* bases,
                                 const int* powers, void* result) {
    for (int i = 0; i < count; ++i) {
      static_cast<Unit*>(result)->dimension[ut_get_symbol(bases[i], UT_ASCII)] = powers[i];
    }
    return UT_SUCCESS;
  }

  static ut_status visit_scaled(const ut_unit*, double scale, const ut_unit* underlying,
                                double offset, void* result) {
    Unit& unit = *static_cast<Unit*>(result);
    unit.factor *= scale;
    if (offset != 0.0) unit.error = "has a shifted zero";
    return ut_accept_visitor(underlying, &visitor(), result);
  }

  static ut_status visit_time(const ut_unit*, const ut_unit*, double, void* result) {
    static_cast<Unit*>(result)->error = "is a date";
    return UT_SUCCESS;
  }

  static ut_status visit_logarithm(const ut_unit*, double, const ut_unit*, void* result) {
    static_cast<Unit*>(result)->error = "is logarithmic";
    return UT_SUCCESS;
  }
};

class UnitSystem {
 public:
  UnitSystem() {
    ut_set_error_message_handler(ut_ignore);
    const std::string database = own_unit_database();
    system_.reset(ut_read_xml(database.empty() ? nullptr : database.c_str()));
    if (!system_) throw std::runtime_error("the unit database of UDUNITS-2 cannot be read");
    for (const OwnUnit& own : kOwnUnits) {
      const UnitHandle base = parsed(own.of);
      const UnitHandle unit(ut_scale(own.factor, base.get()));
      ut_unmap_name_to_unit(system_.get(), own.name, UT_ASCII);  // where it is known, but rounded
      if (ut_map_symbol_to_unit(own.name, UT_ASCII, unit.get()) != UT_SUCCESS) {
        throw std::logic_error(fmt::format("the unit `{}` exists already", own.name));
      }
    }
  }

  Unit find(std::string_view text) {
    const std::scoped_lock lock(mutex_);
    const auto known = known_.find(text);
    if (known != known_.end()) return known->second;
    Unit unit = read(text);
    if (unit.error.empty()) known_.emplace(text, unit);
    return unit;
  }

 private:
  UnitHandle parsed(const std::string& text) const {
    return UnitHandle(ut_parse(system_.get(), text.c_str(), UT_ASCII));
  }

  Unit read(std::string_view text) const {
    const std::optional<UnitText> unit_text = read_unit_text(text);
    if (!unit_text) {
      return failure(fmt::format("{} is not a unit", in_backticks(text)),
                     "units are written like `kg m2`, `N m/rad` or `km^3/s^2`");
    }
    const UnitHandle unit = parsed(unit_text->ascii);
    if (!unit) return unknown(*unit_text);
    Unit result = Dissection::of(unit.get());
    if (!result.error.empty()) {
      return failure(
          fmt::format("{} {}, it is no unit of a quantity", in_backticks(text), result.error), "");
    }
    if (!std::isnormal(result.factor)) {
      return failure(fmt::format("{} is outside the range of numbers", in_backticks(text)), "");
    }
    return result;
  }

  /// Names the part of the text that UDUNITS does not know.
  Unit unknown(const UnitText& text) const {
    std::string culprit = text.ascii;
    for (const std::string& name : text.names) {
      if (parsed(name)) continue;
      culprit = name;
      break;
    }
    const std::string meant = meant_unit(culprit, text.ascii);
    if (!meant.empty())
      return failure(fmt::format("unknown unit {}", in_backticks(culprit)),
                     fmt::format("did you mean `{}`?", meant));
    const std::string near = nearest(culprit, kCommonUnits);
    return failure(fmt::format("unknown unit {}", in_backticks(culprit)),
                   near.empty() ? "units are written like `kg m2`, `N m/rad` or `km^3/s^2`"
                                : fmt::format("did you mean `{}`?", near));
  }

  static Unit failure(std::string error, std::string hint) {
    Unit unit;
    unit.error = std::move(error);
    unit.hint = std::move(hint);
    return unit;
  }

  SystemHandle system_;
  std::mutex mutex_;
  std::map<std::string, Unit, std::less<>> known_;  // what was asked for before
};

}  // namespace

Unit find_unit(std::string_view text) {
  static UnitSystem system;
  return system.find(text);
}

}  // namespace twincraft
