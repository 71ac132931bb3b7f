// The kinds with a unit or three components: quantities, vectors, directions, tensors.
// Tested by tests/compiler/kind_test.cpp.
#include <fmt/format.h>

#include <cmath>

#include "compiler/ir/vector_json.h"
#include "compiler/schema/own_kind.h"
#include "compiler/schema/table_info.h"

namespace twincraft {
namespace {

// Relative to the largest entry; what rounding in a CAD export may leave, and no more.
constexpr double kSymmetryTolerance = 1e-9;

// What normalising a vector leaves in its squared length.
constexpr double kUnitTolerance = 8 * std::numeric_limits<double>::epsilon();

constexpr std::string_view kDecimal = "([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?";
constexpr std::string_view kUnitTail = "( *[^-+*/0-9 .,_:%].*)?$";

/// `12 kg`: how a quantity may be written; for a unit of 1 just the number.
std::string quantity_example(SiUnit si) { return si == "1" ? "`0.5`" : fmt::format("`12 {}`", si); }

Json quantity_schema(const std::string& si, Range range) {
  const std::string_view sign = range == Range::kAny ? "^[-+]?" : "^[+]?";
  Json schema =
      any_of(number_schema(range),
             {{"type", "string"}, {"pattern", fmt::format("{}{}{}", sign, kDecimal, kUnitTail)}});
  schema["x-unit"] = si;
  return schema;
}

Json with_description(Json schema, std::string_view text) {
  schema["description"] = text;
  return schema;
}

/// The keys of `{value: [..], unit: mm}`.
const TableInfo& listing_table() {
  static const TableInfo table{
      .name = "vector",
      .doc = "A list of plain numbers and the unit of all of them.",
      .fields = {required_field("value", "plain numbers", "list of numbers", {}, {}),
                 required_field("unit", "unit of every number", "unit, such as mm", {}, {})},
      .groups = {}};
  return table;
}

using ReadEntry = std::function<std::optional<double>(const Node&, ReadContext&)>;

/// A component: of any sign, and as small as may be.
std::optional<double> read_component(const Node& node, SiUnit si, std::string_view unit,
                                     ReadContext& context) {
  const std::optional<double> value = read_quantity(node, si, unit, context);
  if (!value || !check_magnitude(*value, Range::kAny, node, context)) return std::nullopt;
  return value;
}

std::optional<Vector3d> read_three(const Node& list, ReadContext& context,
                                   const std::string& expected, const ReadEntry& read_entry) {
  if (!check_list(list, context, 3, 3, expected)) return std::nullopt;
  Vector3d vector;
  bool complete = true;
  for (std::size_t i = 0; i < 3; ++i) {
    ReadContext at_item = item_of(context, i);
    const std::optional<double> entry = read_entry(list.items[i], at_item);
    if (entry) vector[static_cast<Eigen::Index>(i)] = *entry;
    complete = complete && entry;
  }
  if (!complete) return std::nullopt;
  return vector;
}

std::optional<Matrix3d> read_rows(const Node& list, ReadContext& context,
                                  const ReadEntry& read_entry) {
  if (!check_list(list, context, 3, 3, "a list of three rows")) return std::nullopt;
  Matrix3d matrix;
  bool complete = true;
  for (std::size_t i = 0; i < 3; ++i) {
    ReadContext at_row = part_of(context, fmt::format("row {}", i + 1));
    const auto row = read_three(list.items[i], at_row, "a row of three numbers", read_entry);
    if (row) matrix.row(static_cast<Eigen::Index>(i)) = row->transpose();
    complete = complete && row;
  }
  if (!complete) return std::nullopt;
  return matrix;
}

std::optional<Vector3d> read_direction(const Node& node, ReadContext& context) {
  const std::optional<Vector3d> vector =
      read_three(node, context, "a direction such as `[0, 0, 1]`", read_number);
  if (!vector) return std::nullopt;
  const double largest = vector->cwiseAbs().maxCoeff();
  if (largest == 0.0) {
    context.diagnostics.error(Code::kZeroDirection, node.span, context.where + " has length zero")
        .with_hint("write a direction such as `[0, 0, 1]`; its length does not matter");
    return std::nullopt;
  }
  // A unit vector stays what it is, so that a resolved spec reads back unchanged.
  if (std::abs(vector->squaredNorm() - 1.0) <= kUnitTolerance) return vector;
  // Scaled first, so that no square overflows or vanishes.
  return (*vector / largest).normalized();
}

/// The mean of the tensor and its mirror image, when they are one but for rounding.
std::optional<Matrix3d> symmetric(const Matrix3d& tensor, const Node& list, ReadContext& context) {
  const double allowed = kSymmetryTolerance * tensor.cwiseAbs().maxCoeff();
  bool complete = true;
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
    if (std::abs(tensor(i, j) - tensor(j, i)) <= allowed) continue;
    complete = false;
    const auto row = static_cast<std::size_t>(i);
    const auto column = static_cast<std::size_t>(j);
    const Node& upper = list.items[row].items[column];
    const Node& lower = list.items[column].items[row];
    context.diagnostics
        .error(Code::kNotSymmetric, lower.span,
               fmt::format("{} is not symmetric: row {} column {} is {}", context.where, column + 1,
                           row + 1, describe(lower)))
        .with_note(upper.span,
                   fmt::format("row {} column {} is {}", row + 1, column + 1, describe(upper)));
  }
  if (!complete) return std::nullopt;
  return Matrix3d(0.5 * (tensor + tensor.transpose()));
}

std::optional<Matrix3d> read_inertia(const Node& node, ReadContext& context) {
  constexpr SiUnit si = "kg m2";
  const std::optional<Listing> listing = read_listing(node, si, context);
  if (!listing) return std::nullopt;
  const ReadEntry read_entry = [si, &listing](const Node& entry, ReadContext& at_entry) {
    return read_component(entry, si, listing->unit, at_entry);
  };
  const Node& list = *listing->list;
  const bool has_rows = std::any_of(list.items.begin(), list.items.end(),
                                    [](const Node& item) { return item.is_list(); });
  if (!list.is_list() || !has_rows) {
    const std::optional<Vector3d> moments =
        read_three(list, context, "`[Ixx, Iyy, Izz]` or a symmetric 3x3 list", read_entry);
    if (!moments) return std::nullopt;
    return Matrix3d(moments->asDiagonal());
  }
  const std::optional<Matrix3d> tensor = read_rows(list, context, read_entry);
  if (!tensor) return std::nullopt;
  return symmetric(*tensor, list, context);
}

/// A quantity of which nobody has asked yet whether it is usual.
Kind<double> unjudged_quantity(SiUnit si, Range range) {
  return own_kind<double>({
      .text = fmt::format("quantity [{}]{}", si, range_text(range)),
      .schema = quantity_schema(std::string(si), range),
      .read = [unit = std::string(si), range](const Node& node,
                                              ReadContext& context) -> std::optional<double> {
        const std::optional<double> value = read_quantity(node, unit, {}, context);
        if (!value || !check_range(*value, range, node, context)) return std::nullopt;
        // A time only multiplies rates: as short as it may be, nothing divides by its square.
        const Range least = unit == "s" ? Range::kAny : range;
        if (!check_magnitude(*value, least, node, context)) return std::nullopt;
        return value;
      },
      .write = [](const double& value) -> Json { return value; },
      .numbers = {Numbers::Form::kScalar, std::string(si)},
  });
}

/// Those of a list of quantities where the kind itself knows of none.
Numbers numbers_of(const AnyKind& kind, const std::string& unit) {
  const bool is_plain_list = kind.numbers().form == Numbers::Form::kNone;
  return is_plain_list ? Numbers{Numbers::Form::kScalar, unit} : kind.numbers();
}

class JudgedKind : public KindBody {
 public:
  JudgedKind(const AnyKind& kind, std::string unit, const Usual& usual)
      : KindBody(kind.text(), kind.schema(), kind.tables(), numbers_of(kind, unit)),
        kind_(kind),
        unit_(std::move(unit)),
        usual_(usual) {}

  bool read(void* value, const Node& node, ReadContext& context) const override {
    if (!kind_.read_into(value, node, context)) return false;
    judge_bare_numbers(scalars_of(node), unit_, usual_, context);
    return true;
  }
  Json write(const void* value) const override { return kind_.write_from(value); }

 private:
  AnyKind kind_;
  std::string unit_;
  Usual usual_;
};

/// `kind`, whose values have their plain numbers judged together.
template <class V>
Kind<V> judged(const Kind<V>& kind, SiUnit si, const Usual& usual) {
  return Kind<V>(AnyKind(std::make_shared<JudgedKind>(kind, std::string(si), usual)));
}

Json write_inertia(const Matrix3d& tensor) {
  const Vector3d moments = tensor.diagonal();
  if (tensor == Matrix3d(moments.asDiagonal())) return vector_json(moments);
  return matrix_json(tensor);
}

}  // namespace

std::optional<double> read_quantity(const Node& node, SiUnit si, std::string_view unit,
                                    ReadContext& context) {
  // With a unit, "5 mm" as an entry would be a unit too many.
  if (!unit.empty() && !read_number(node, context)) return std::nullopt;
  const std::string* text = scalar_text(node, context, fmt::format("a quantity [{}]", si),
                                        "write for example " + quantity_example(si));
  if (text == nullptr) return std::nullopt;
  // As one text, so that both spellings of a vector give the same doubles.
  const Quantity quantity =
      parse_quantity(unit.empty() ? *text : fmt::format("{} {}", *text, unit), si);
  if (!quantity.error.empty()) {
    context.diagnostics.error(Code::kBadQuantity, node.span, context.where + ": " + quantity.error)
        .with_hint(quantity.hint);
    return std::nullopt;
  }
  return quantity.value;
}

std::optional<Listing> read_listing(const Node& node, SiUnit si, ReadContext& context) {
  if (!node.is_map()) return Listing{&node, {}};
  if (!check_keys(listing_table(), node, context)) return std::nullopt;
  const Node& unit = *node.find("unit");
  ReadContext at_unit = field_context(listing_table(), "unit", node, context);
  const std::string* text = scalar_text(unit, at_unit, "a unit", "write for example `mm`");
  if (text == nullptr) return std::nullopt;
  const Quantity factor = unit_factor(*text, si);
  if (!factor.error.empty()) {
    context.diagnostics.error(Code::kBadQuantity, unit.span, context.where + ": " + factor.error)
        .with_hint(factor.hint);
    return std::nullopt;
  }
  return Listing{node.find("value"), *text};
}

Json listing_schema(const Json& list, SiUnit si) {
  const Json map = {{"type", "object"},
                    {"properties",
                     {{"value", with_description(list, "Plain numbers in `unit`.")},
                      {"unit",
                       {{"type", "string"},
                        {"description", fmt::format("Of every number of `value`, such as {}.", si)},
                        {"x-unit", std::string(si)}}}}},
                    {"required", Json::array({"value", "unit"})},
                    {"additionalProperties", false}};
  return any_of(list, map);
}

Kind<double> quantity(SiUnit si, Range range) { return quantity(si, range, usual_of(si)); }

Kind<double> quantity(SiUnit si, Range range, const Usual& usual) {
  return judged(unjudged_quantity(si, range), si, usual);
}

Kind<std::vector<double>> one_or_more_quantities(SiUnit si, Range range) {
  return judged(one_or_list(unjudged_quantity(si, range)), si, usual_of(si));
}

Kind<std::vector<double>> quantities(SiUnit si, std::size_t count) {
  return judged(list_of(unjudged_quantity(si, Range::kAny), count, count), si, usual_of(si));
}

Kind<Vector3d> vector3(SiUnit si) {
  const std::string unit(si);
  const Kind<Vector3d> kind = own_kind<Vector3d>({
      .text = fmt::format("three quantities [{}]", si),
      .schema = listing_schema(list_schema(quantity_schema(unit, Range::kAny), 3, 3), si),
      .read = [unit](const Node& node, ReadContext& context) -> std::optional<Vector3d> {
        const std::optional<Listing> listing = read_listing(node, unit, context);
        if (!listing) return std::nullopt;
        const ReadEntry read_entry = [&](const Node& entry, ReadContext& at_entry) {
          return read_component(entry, unit, listing->unit, at_entry);
        };
        return read_three(*listing->list, context, fmt::format("three quantities [{}]", unit),
                          read_entry);
      },
      .write = vector_json,
      .numbers = {Numbers::Form::kVector, unit},
  });
  return judged(kind, si, usual_of(si));  // of `{value: .., unit: ..}` nothing is bare
}

Kind<Vector3d> direction() {
  return own_kind<Vector3d>({
      .text = "direction [x, y, z]",
      .schema = list_schema(number_schema(Range::kAny), 3, 3),
      .read = read_direction,
      .write = vector_json,
      .numbers = {Numbers::Form::kDirection, "1"},
  });
}

Kind<Matrix3d> inertia() {
  const Json row = list_schema(quantity_schema("kg m2", Range::kAny), 3, 3);
  const Kind<Matrix3d> kind = own_kind<Matrix3d>({
      .text = "[Ixx, Iyy, Izz] or symmetric 3x3 [kg m2]",
      .schema = listing_schema(any_of(row, list_schema(row, 3, 3)), "kg m2"),
      .read = read_inertia,
      .write = write_inertia,
      .numbers = {Numbers::Form::kInertia, "kg m2"},
  });
  return judged(kind, "kg m2", {});
}

Kind<Matrix3d> matrix3() {
  return own_kind<Matrix3d>({
      .text = "three rows of three numbers",
      .schema = list_schema(list_schema(number_schema(Range::kAny), 3, 3), 3, 3),
      .read = [](const Node& node, ReadContext& context) -> std::optional<Matrix3d> {
        return read_rows(node, context, read_number);
      },
      .write = matrix_json,
  });
}

}  // namespace twincraft
