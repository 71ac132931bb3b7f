// Kinds of value: how one sort of thing is written in a spec. A kind knows four things about its
// value: how to read it from a syntax node, how to describe it in JSON Schema, how to name it in
// the reference, and how to write it back resolved. Kinds combine: list_of(quantity("m")),
// one_or_list(...), object(table). Field tables are made of kinds, and nothing else states what the
// language accepts. One that is not made of others is an own_kind (own_kind.h).
//
// Templates here only say of which type a value is; reading and writing are compiled once, behind
// AnyKind, or every key of the language would cost a fifth of a second.
// Tested by tests/compiler/kind_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "compiler/ir/mass.h"
#include "compiler/ir/schedule.h"
#include "compiler/schema/bare_numbers.h"
#include "compiler/schema/reading.h"

namespace twincraft {

struct KindBody;  // own_kind.h

/// A kind of which the type of its values is not known. Copies share one body.
class AnyKind {
 public:
  explicit AnyKind(std::shared_ptr<const KindBody> body);
  AnyKind(const AnyKind&);
  AnyKind(AnyKind&&) noexcept;
  AnyKind& operator=(const AnyKind&);
  AnyKind& operator=(AnyKind&&) noexcept;
  ~AnyKind();

  const std::string& text() const;  // for the reference: "quantity [kg]", "`rk4` or `euler`"
  const Json& schema() const;       // JSON Schema draft-07 fragment
  /// The maps a value may hold, for the reference.
  const std::vector<const TableInfo*>& tables() const;
  const Numbers& numbers() const;

  /// Report what is wrong and return false; else `value`, which is of the kind's type, is read.
  bool read_into(void* value, const Node& node, ReadContext& context) const;
  /// The same for a value that was read from `before` without a diagnostic: the parts that `node`
  /// has from there, place and all, stay as they are.
  bool reread_into(void* value, const Node& node, const Node& before, ReadContext& context) const;
  /// SI numbers and canonical words; null leaves the key out. @param value  of the kind's type
  Json write_from(const void* value) const;

 private:
  std::shared_ptr<const KindBody> body_;
};

template <class V>
class Kind : public AnyKind {
 public:
  explicit Kind(AnyKind any) : AnyKind(std::move(any)) {}

  /// Report what is wrong and return nothing, or the value.
  std::optional<V> read(const Node& node, ReadContext& context) const {
    std::optional<V> value(std::in_place);
    if (!read_into(&*value, node, context)) return std::nullopt;
    return value;
  }
  /// A template, so that Json need be complete for callers alone.
  template <class Result = Json>
  Result write(const V& value) const {
    return write_from(&value);
  }
};

Kind<double> quantity(SiUnit si, Range range = Range::kAny);
/// The same for a key whose plain numbers end elsewhere to be likely.
Kind<double> quantity(SiUnit si, Range range, const Usual& usual);
/// A quantity or a list of them; a single one becomes a list of one.
Kind<std::vector<double>> one_or_more_quantities(SiUnit si, Range range = Range::kAny);
/// A list of exactly `count` quantities.
Kind<std::vector<double>> quantities(SiUnit si, std::size_t count);
Kind<double> number(Range range = Range::kAny);
Kind<int> integer(int minimum, int maximum);
Kind<bool> boolean();
Kind<std::string> text();
/// `[A-Za-z][A-Za-z0-9_-]*`, at most 64 characters, none of the reserved words.
Kind<std::string> name();
/// The name of another component, or `hub` where a mount is meant; `what` is a bare noun: "tank".
Kind<std::string> reference_to(std::string what);

/// Three quantities: a list, or `{value: [..], unit: mm}` with plain numbers.
Kind<Vector3d> vector3(SiUnit si);
/// Three plain numbers, normalised; the zero vector is a fault.
Kind<Vector3d> direction();
/// `[Ixx, Iyy, Izz]` or a symmetric 3x3 list of lists [kg m^2], also with `{value, unit}`. An
/// asymmetry up to 1e-9 of the largest entry is averaged away. Physical or not is checked later.
Kind<Matrix3d> inertia();
/// Three rows of three numbers.
Kind<Matrix3d> matrix3();
/// Quantity or `[[t, value], ...]` with increasing times; the range holds for every value.
Kind<Schedule> schedule(SiUnit si, Range range = Range::kAny);
/// Three components, each a schedule; also `{value: [..], unit: mN}`.
Kind<std::array<Schedule, 3>> schedule3(SiUnit si);
/// `[[start, end], ...]`, forward, ordered, not overlapping.
Kind<std::vector<Schedule::Interval>> intervals();

/// One of some words.
Kind<std::string> word(std::vector<std::string> words);

/// The same, each with a meaning: `one_of<Method>({{"rk4", Method::kRk4}, ...})`.
template <class E>
Kind<E> one_of(const std::vector<std::pair<std::string_view, E>>& words);

template <class V>
Kind<std::vector<V>> list_of(const Kind<V>& item, std::size_t minimum = 0,
                             std::size_t maximum = kAnyCount);

/// A value or a list of values; a single value becomes a list of one.
template <class V>
Kind<std::vector<V>> one_or_list(const Kind<V>& item);

/// A kind whose value may be absent.
template <class V>
Kind<std::optional<V>> maybe(const Kind<V>& kind);

bool is_scalar(const Node& node);
/// A map of keys, and not numbers with one unit, `{value: [1, 2], unit: mm}`: for either().
bool is_section(const Node& node);

/// Two spellings told apart by shape: `first` when `suits(node)`, else `second`. For example
/// `either(is_scalar, one_of<Com>({{"com", Com{}}}), vector3("m"))`.
template <class A, class B>
Kind<std::variant<A, B>> either(bool (*suits)(const Node&), const Kind<A>& first,
                                const Kind<B>& second);

}  // namespace twincraft

#include "compiler/schema/kind_inl.h"
