// A list of operations on doubles without a branch: what a text over a scalar did once, and what it
// would do for any other inputs. recorder.h writes it; it is replayed, simplified and
// differentiated (tangents.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace twincraft {

enum class Operation : std::uint8_t {
  kInput,
  kConstant,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kNegate,
  kRoot,
  kSine,
  kCosine,
  kIsGreater,  // 1 or 0
  kChoose      // its second operand if the first one is not 0, else the third
};

/// How many operands it has.
std::size_t operands_of(Operation operation);
/// @pre not kInput, not kConstant
double result_of(Operation operation, double a, double b, double c);

class Tape {
 public:
  using Place = std::uint32_t;
  struct Line {
    Operation operation = Operation::kConstant;
    std::array<Place, 3> of{};  // earlier lines; of an input: which one; unused ones are 0
    double constant = 0.0;
  };

  /// The next number that replay() takes.
  Place add_input();
  Place add_constant(double constant);
  Place add(Operation operation, const std::array<Place, 3>& of);
  /// The next number that replay() gives.
  void add_output(Place place) { outputs_.push_back(place); }

  std::span<const Line> lines() const { return lines_; }
  std::span<const Place> outputs() const { return outputs_; }
  std::size_t inputs() const { return inputs_; }
  /// Lines that compute something.
  std::size_t operations() const;

  /// Every operation rounds as it did for the text that was recorded: the same bytes.
  /// @param in  inputs() of them  @param out  one per output
  void replay(std::span<const double> in, std::span<double> out) const;

  /// The same numbers from fewer lines: neutral ones and zeros are gone, what is computed twice or
  /// for nothing too. Of finite numbers only the sign of a zero may differ.
  Tape simplified() const;

 private:
  std::vector<Line> lines_;
  std::map<std::uint64_t, Place> constants_;  // by their bytes
  std::vector<Place> outputs_;
  std::size_t inputs_ = 0;
};

}  // namespace twincraft
