// What all kinds share while they read: where they are, the faults every one can meet, and the
// fragments of JSON Schema and reference text they are put together from.
// Tested by tests/compiler/kind_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/syntax/node.h"
#include "compiler/units/units.h"

namespace twincraft {

using Json = nlohmann::ordered_json;

struct TableInfo;

/// Where a value is read: what to call it in messages and where faults go.
struct ReadContext {
  Diagnostics& diagnostics;
  std::string where;       // "`mass` of wheel `rw_x`"; empty for the document itself
  std::string owner = {};  // "wheel `rw_x`": what nested maps belong to
};

/// What numbers a value is made of, as it is written resolved: for those who compute with values of
/// any key.
struct Numbers {
  enum class Form {
    kNone,       // something else: a count, a word, a name, a map
    kScalar,     // a number, or a list of them
    kVector,     // three numbers along axes
    kDirection,  // the same, of length one
    kInertia     // three moments, or three rows of three
  };
  Form form = Form::kNone;
  std::string unit = {};  // SI
};

/// What numbers are allowed beyond being finite.
enum class Range { kAny, kNotNegative, kPositive };

inline constexpr std::size_t kAnyCount = std::numeric_limits<std::size_t>::max();

/// Report that `node` is not `expected` ("a list of numbers"), or has no value at all.
void report_wrong_type(const Node& node, ReadContext& context, const std::string& expected,
                       const std::string& hint);

/// The text of a scalar; anything else is reported.
const std::string* scalar_text(const Node& node, ReadContext& context, const std::string& expected,
                               const std::string& hint);

/// Whether `node` is a list of an allowed length; if not, that is reported.
/// @param form  how to write one instead of a map; empty: as a list of maps
bool check_list(const Node& node, ReadContext& context, std::size_t minimum, std::size_t maximum,
                const std::string& expected, const std::string& form = {});

/// The context of a part: "`axis` of wheel `x`" and "item 2" give "item 2 of `axis` of wheel `x`".
ReadContext part_of(const ReadContext& whole, std::string_view part);
/// The same for an item of a list, counted from 1 in messages.
ReadContext item_of(const ReadContext& list, std::size_t index);

/// " > 0", " >= 0" or nothing, for the reference.
std::string range_text(Range range);
/// The bounds of `range` as keywords of a JSON Schema number.
Json number_schema(Range range);
/// Whether `value`, written as `node`, lies in `range`; if not, that is reported.
bool check_range(double value, Range range, const Node& node, ReadContext& context);

/// The least magnitude of a quantity that must be positive and is no time, and the largest of any,
/// in SI units. The engines form products of up to ten of them, such as m^2 r^4 Omega^4, and a
/// double holds 1e-308 to 1e308.
inline constexpr double kLeastMagnitude = 1.0e-30;
inline constexpr double kLargestMagnitude = 1.0e30;

/// Whether the engines can compute with `value` [SI], written as `node`; if not, that is reported.
bool check_magnitude(double value, Range range, const Node& node, ReadContext& context);

/// A plain number, or a quantity in `si`. With a `unit` the node is a plain number in that unit.
std::optional<double> read_number(const Node& node, ReadContext& context);
std::optional<double> read_quantity(const Node& node, SiUnit si, std::string_view unit,
                                    ReadContext& context);

/// The list of `[..]`, or the list and unit of `{value: [..], unit: mm}`.
struct Listing {
  const Node* list = nullptr;
  std::string unit;  // empty: each entry brings its own, or is SI
};
/// Faults of the map are reported; that the list is one is left to its reader.
std::optional<Listing> read_listing(const Node& node, SiUnit si, ReadContext& context);
/// JSON Schema of a listing whose list alone is described by `list`.
Json listing_schema(const Json& list, SiUnit si);

/// Index of the word that `node` is; anything else is reported with the nearest word.
std::optional<std::size_t> read_word(const Node& node, ReadContext& context,
                                     const std::vector<std::string>& words);

/// "`a`, `b` or `c`"
std::string words_text(const std::vector<std::string>& words, std::string_view conjunction);

Json list_schema(const Json& item, std::size_t minimum, std::size_t maximum);
Json any_of(Json first, Json second);

std::vector<const TableInfo*> joined(std::vector<const TableInfo*> first,
                                     const std::vector<const TableInfo*>& second);

}  // namespace twincraft
