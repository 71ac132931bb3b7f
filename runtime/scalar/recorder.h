// Arithmetic that writes itself down: a text over this scalar, run once, leaves a tape.
//
// Constants are folded, nothing else is: each operation rounds as a double's does. A recorded
// number is no condition: a text that asks one for its way (`if (x > y)`) does not compile, and
// `chosen` is an operation like any other, with both of its sides on the tape.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>

#include "runtime/scalar/scalar.h"
#include "runtime/scalar/tape.h"

namespace twincraft::TWINCRAFT_KERNEL {

/// A constant, or a place on a tape, which must outlive it.
class Recorded {
 public:
  Recorded() = default;
  Recorded(double constant) : constant_(constant) {}

  static Recorded input(Tape& tape) { return {&tape, tape.add_input()}; }
  void output(Tape& tape) const { tape.add_output(place_on(tape)); }

  bool is_constant() const { return tape_ == nullptr; }
  double constant() const { return constant_; }

  /// On the tape of its operands; where all are constants, the result.
  static Recorded of(Operation operation, std::initializer_list<Recorded> operands) {
    Tape* tape = nullptr;
    for (const Recorded& x : operands)
      if (!x.is_constant()) tape = x.tape_;
    if (tape == nullptr) {
      std::array<double, 3> values{};
      std::ranges::transform(operands, values.begin(), &Recorded::constant_);
      return result_of(operation, values[0], values[1], values[2]);
    }
    std::array<Tape::Place, 3> places{};
    std::ranges::transform(operands, places.begin(),
                           [tape](const Recorded& x) { return x.place_on(*tape); });
    return {tape, tape->add(operation, places)};
  }

 private:
  Recorded(Tape* tape, Tape::Place place) : tape_(tape), place_(place) {}

  Tape::Place place_on(Tape& tape) const {
    if (is_constant()) return tape.add_constant(constant_);
    if (tape_ != &tape) throw std::logic_error("numbers of two tapes do not mix");
    return place_;
  }

  Tape* tape_ = nullptr;
  Tape::Place place_ = 0;
  double constant_ = 0.0;
};

/// Whether one is greater than another: of use to `chosen` alone.
struct RecordedTruth {
  Recorded one_or_zero;
};

inline Recorded operator+(const Recorded& a, const Recorded& b) {
  return Recorded::of(Operation::kAdd, {a, b});
}
inline Recorded operator-(const Recorded& a, const Recorded& b) {
  return Recorded::of(Operation::kSubtract, {a, b});
}
inline Recorded operator*(const Recorded& a, const Recorded& b) {
  return Recorded::of(Operation::kMultiply, {a, b});
}
inline Recorded operator/(const Recorded& a, const Recorded& b) {
  return Recorded::of(Operation::kDivide, {a, b});
}
inline Recorded operator-(const Recorded& a) { return Recorded::of(Operation::kNegate, {a}); }
inline Recorded& operator+=(Recorded& a, const Recorded& b) { return a = a + b; }
inline Recorded& operator-=(Recorded& a, const Recorded& b) { return a = a - b; }

inline RecordedTruth operator>(const Recorded& a, const Recorded& b) {
  return {Recorded::of(Operation::kIsGreater, {a, b})};
}
inline Recorded chosen(const RecordedTruth& first, const Recorded& a, const Recorded& b) {
  return Recorded::of(Operation::kChoose, {first.one_or_zero, a, b});
}
inline Recorded root(const Recorded& x) { return Recorded::of(Operation::kRoot, {x}); }
inline SineCosine<Recorded> sine_cosine(const Recorded& angle) {
  return {Recorded::of(Operation::kSine, {angle}), Recorded::of(Operation::kCosine, {angle})};
}

inline Recorded lane(const Recorded& value, std::size_t) { return value; }
inline void set_lane(Recorded& value, std::size_t, const Recorded& to) { value = to; }
/// What is on a tape may be any number when it is replayed.
inline bool vanishes(const Recorded& x) { return x.is_constant() && x.constant() == 0.0; }

static_assert(KernelScalar<Recorded> && KernelScalars<Recorded, Recorded>);

}  // namespace twincraft::TWINCRAFT_KERNEL
