#include "runtime/scalar/tape.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace twincraft {

std::size_t operands_of(Operation operation) {
  switch (operation) {
    case Operation::kInput:
    case Operation::kConstant:
      return 0;
    case Operation::kNegate:
    case Operation::kRoot:
    case Operation::kSine:
    case Operation::kCosine:
      return 1;
    case Operation::kChoose:
      return 3;
    default:
      return 2;
  }
}

double result_of(Operation operation, double a, double b, double c) {
  switch (operation) {
    case Operation::kAdd:
      return a + b;
    case Operation::kSubtract:
      return a - b;
    case Operation::kMultiply:
      return a * b;
    case Operation::kDivide:
      return a / b;
    case Operation::kNegate:
      return -a;
    case Operation::kRoot:
      return std::sqrt(a);
    case Operation::kSine:
      return std::sin(a);
    case Operation::kCosine:
      return std::cos(a);
    case Operation::kIsGreater:
      return a > b ? 1.0 : 0.0;
    case Operation::kChoose:
      return a != 0.0 ? b : c;
    case Operation::kInput:
    case Operation::kConstant:
      break;
  }
  throw std::logic_error("no operation");
}

Tape::Place Tape::add_input() {
  lines_.push_back({Operation::kInput, {static_cast<Place>(inputs_++)}});
  return static_cast<Place>(lines_.size() - 1);
}

Tape::Place Tape::add_constant(double constant) {
  const auto [known, is_new] = constants_.try_emplace(std::bit_cast<std::uint64_t>(constant),
                                                      static_cast<Place>(lines_.size()));
  if (is_new) lines_.push_back({Operation::kConstant, {}, constant});
  return known->second;
}

Tape::Place Tape::add(Operation operation, const std::array<Place, 3>& of) {
  lines_.push_back({operation, of});
  return static_cast<Place>(lines_.size() - 1);
}

std::size_t Tape::operations() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      lines_, [](const Line& line) { return operands_of(line.operation) > 0; }));
}

void Tape::replay(std::span<const double> in, std::span<double> out) const {
  if (in.size() != inputs_ || out.size() != outputs_.size())
    throw std::logic_error("a tape is replayed with as many numbers as it has");
  std::vector<double> values(lines_.size());
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const auto& [operation, of, constant] = lines_[i];
    if (operation == Operation::kInput)
      values[i] = in[of[0]];
    else if (operation == Operation::kConstant)
      values[i] = constant;
    else
      values[i] = result_of(operation, values[of[0]], values[of[1]], values[of[2]]);
  }
  std::ranges::transform(outputs_, out.begin(), [&values](Place place) { return values[place]; });
}

namespace {

/// Writes lines anew, each once, where it can not do without.
class Simplifier {
 public:
  using Place = Tape::Place;

  Place input() { return to_.add_input(); }
  Place constant(double value) { return to_.add_constant(value); }
  Tape& tape() { return to_; }

  Place operation(Operation operation, std::array<Place, 3> of) {
    if (are_constant(operation, of))
      return constant(result_of(operation, value(of[0]), value(of[1]), value(of[2])));
    if (const std::optional<Place> known = without(operation, of)) return *known;
    if ((operation == Operation::kAdd || operation == Operation::kMultiply) && of[0] > of[1])
      std::swap(of[0], of[1]);
    const auto [known, is_new] = written_.try_emplace({operation, of}, Place{});
    if (is_new) known->second = to_.add(operation, of);
    return known->second;
  }

 private:
  bool is_constant(Place place) const {
    return to_.lines()[place].operation == Operation::kConstant;
  }
  double value(Place place) const { return to_.lines()[place].constant; }
  bool is(Place place, double constant) const {
    return is_constant(place) && value(place) == constant;
  }
  bool are_constant(Operation operation, const std::array<Place, 3>& of) const {
    return std::all_of(of.begin(), of.begin() + static_cast<std::ptrdiff_t>(operands_of(operation)),
                       [this](Place place) { return is_constant(place); });
  }
  /// Of what it is the negative.
  std::optional<Place> negated(Place place) const {
    const Tape::Line& line = to_.lines()[place];
    if (line.operation != Operation::kNegate) return {};
    return line.of[0];
  }

  /// The place of the result where no line of this operation is needed.
  std::optional<Place> without(Operation what, const std::array<Place, 3>& of) {
    const auto [a, b, c] = of;
    switch (what) {
      case Operation::kAdd:
        if (is(a, 0.0)) return b;
        if (is(b, 0.0)) return a;
        if (const auto less = negated(b)) return operation(Operation::kSubtract, {a, *less});
        if (const auto less = negated(a)) return operation(Operation::kSubtract, {b, *less});
        return {};
      case Operation::kSubtract:
        if (is(a, 0.0)) return operation(Operation::kNegate, {b});
        if (is(b, 0.0)) return a;
        if (const auto more = negated(b)) return operation(Operation::kAdd, {a, *more});
        return {};
      case Operation::kMultiply:
        if (is(a, 0.0) || is(b, 0.0)) return constant(0.0);
        if (is(a, 1.0)) return b;
        if (is(b, 1.0)) return a;
        if (is(a, -1.0)) return operation(Operation::kNegate, {b});
        if (is(b, -1.0)) return operation(Operation::kNegate, {a});
        return {};
      case Operation::kDivide:
        if (is(a, 0.0)) return constant(0.0);
        if (is(b, 1.0)) return a;
        return {};
      case Operation::kNegate:
        return negated(a);
      case Operation::kChoose:
        if (is_constant(a)) return value(a) != 0.0 ? b : c;
        return {};
      default:
        return {};
    }
  }

  Tape to_;
  std::map<std::pair<Operation, std::array<Place, 3>>, Place> written_;
};

/// Without the lines that no output asks for; inputs stay.
Tape asked_for(const Tape& from) {
  const std::span<const Tape::Line> lines = from.lines();
  std::vector<bool> is_asked(lines.size());
  for (const Tape::Place place : from.outputs()) is_asked[place] = true;
  for (std::size_t i = lines.size(); i-- > 0;)
    for (std::size_t k = 0; is_asked[i] && k < operands_of(lines[i].operation); ++k)
      is_asked[lines[i].of[k]] = true;
  Tape to;
  std::vector<Tape::Place> place_of(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::array<Tape::Place, 3> of{};
    for (std::size_t k = 0; k < operands_of(lines[i].operation); ++k)
      of[k] = place_of[lines[i].of[k]];
    if (lines[i].operation == Operation::kInput)
      place_of[i] = to.add_input();
    else if (is_asked[i])
      place_of[i] = lines[i].operation == Operation::kConstant ? to.add_constant(lines[i].constant)
                                                               : to.add(lines[i].operation, of);
  }
  for (const Tape::Place place : from.outputs()) to.add_output(place_of[place]);
  return to;
}

}  // namespace

Tape Tape::simplified() const {
  Simplifier simplifier;
  std::vector<Place> place_of(lines_.size());
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Line& line = lines_[i];
    std::array<Place, 3> of{};
    for (std::size_t k = 0; k < operands_of(line.operation); ++k) of[k] = place_of[line.of[k]];
    if (line.operation == Operation::kInput)
      place_of[i] = simplifier.input();
    else if (line.operation == Operation::kConstant)
      place_of[i] = simplifier.constant(line.constant);
    else
      place_of[i] = simplifier.operation(line.operation, of);
  }
  for (const Place place : outputs_) simplifier.tape().add_output(place_of[place]);
  return asked_for(simplifier.tape());
}

}  // namespace twincraft
