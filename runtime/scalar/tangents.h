// Forward differentiation along a tape: each line is a dual number, a value and its partial
// derivatives. Which of these can ever differ from zero is a property of the tape, so only they are
// computed, a few columns at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/scalar/tape.h"

namespace twincraft {

class Tangents {
 public:
  /// @param with_respect_to  inputs of the tape, one per column of the Jacobian
  Tangents(Tape tape, std::span<const std::size_t> with_respect_to);

  std::size_t rows() const { return tape_.outputs().size(); }
  std::size_t columns() const { return columns_; }
  /// Lines of the tape, and sums of products that the partial derivatives of all of them take.
  std::size_t operations() const { return tape_.operations(); }
  std::size_t products() const { return steps_.size(); }

  /// Exact to rounding; where a `chosen` bends, of the side that it takes. No allocation.
  /// @return the Jacobian by columns, good until the next call
  std::span<const double> at(std::span<const double> in);

 private:
  static constexpr std::size_t kWidth = 4;  // columns at once
  using Row = std::array<double, kWidth>;   // partial derivatives, of one block of columns
  using Slot = std::uint32_t;

  /// row = slope[line][0] a + slope[line][1] b
  struct Step {
    Tape::Place line = 0;
    Slot row = 0, a = 0, b = 0;
  };
  /// One that is not zero for good.
  struct Result {
    std::size_t output = 0, block = 0;
    Slot row = 0;
  };
  /// The slope of a sine is a cosine that the tape has, or the other way round.
  struct Turn {
    Tape::Place line = 0, slope = 0;
    double sign = 1.0;
  };
  /// Lines of one operation that do not need one another, so that one branch serves them all.
  struct Run {
    Operation operation = Operation::kConstant;
    std::vector<Tape::Place> lines;
  };
  class Builder;

  void evaluate(std::span<const double> in);
  void evaluate(const Run& run);

  Tape tape_;
  std::size_t columns_;
  std::vector<Run> runs_;
  std::vector<Step> steps_;
  std::vector<Result> results_;
  std::vector<Turn> turns_;
  std::vector<double> values_;
  std::vector<std::array<double, 2>> slopes_;
  std::vector<Row> rows_;
  std::vector<double> jacobian_;
};

}  // namespace twincraft
