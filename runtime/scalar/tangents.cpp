#include "runtime/scalar/tangents.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace twincraft {

/// Decides which rows there are, then where they are kept. Until the end every row has a slot of
/// its own: slot 0 is of zeros, then one per column, which is one there and zero elsewhere.
class Tangents::Builder {
 public:
  explicit Builder(Tangents& to) : to_(to), lines_(to.tape_.lines()), rows_of_(lines_.size()) {}

  void build(std::span<const std::size_t> with_respect_to) {
    next_ = static_cast<Slot>(1 + with_respect_to.size());
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i].operation == Operation::kInput)
        begin_column(i, with_respect_to);
      else
        add_line(static_cast<Tape::Place>(i));
    }
    const std::span<const Tape::Place> outputs = to_.tape_.outputs();
    for (std::size_t k = 0; k < outputs.size(); ++k)
      for (const auto& [block, slot] : rows_of_[outputs[k]])
        to_.results_.push_back({k, block, slot});
    keep_rows(static_cast<Slot>(with_respect_to.size()));
    find_turns();
    find_runs();
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Operation operation = lines_[i].operation;
      if (operation == Operation::kConstant) to_.values_[i] = lines_[i].constant;
      if (operation == Operation::kAdd) to_.slopes_[i] = {1.0, 1.0};
      if (operation == Operation::kSubtract) to_.slopes_[i] = {1.0, -1.0};
      if (operation == Operation::kNegate) to_.slopes_[i] = {-1.0, 0.0};
    }
  }

 private:
  static constexpr std::size_t kForGood = std::numeric_limits<std::size_t>::max();

  void begin_column(std::size_t line, std::span<const std::size_t> with_respect_to) {
    const auto found = std::ranges::find(with_respect_to, std::size_t{lines_[line].of[0]});
    if (found == with_respect_to.end()) return;
    const auto column = static_cast<std::size_t>(found - with_respect_to.begin());
    rows_of_[line][column / kWidth] = static_cast<Slot>(1 + column);
  }

  void add_line(Tape::Place place) {
    const auto& [operation, of, constant] = lines_[place];
    const std::size_t count = operands_of(operation);
    if (count == 0 || operation == Operation::kIsGreater) return;
    const bool chooses = operation == Operation::kChoose;
    static const std::map<std::size_t, Slot> none;
    const auto& a = rows_of_[of[chooses ? 1 : 0]];
    const auto& b = count == 1 ? none : rows_of_[of[chooses ? 2 : 1]];
    const auto slot_of = [](const std::map<std::size_t, Slot>& rows, std::size_t block) {
      const auto found = rows.find(block);
      return found == rows.end() ? Slot{0} : found->second;
    };
    std::map<std::size_t, Slot>& rows = rows_of_[place];
    for (const auto* operand : {&a, &b})
      for (const auto& [block, slot] : *operand) {
        const Slot of_a = slot_of(a, block), of_b = slot_of(b, block);
        const bool is_as_a =
            of_b == 0 && (operation == Operation::kAdd || operation == Operation::kSubtract);
        const bool is_as_b = of_a == 0 && operation == Operation::kAdd;
        const auto [row, is_new] = rows.try_emplace(block, is_as_a ? of_a : is_as_b ? of_b : next_);
        if (!is_new || is_as_a || is_as_b) continue;
        to_.steps_.push_back({place, next_++, of_a, of_b});
      }
  }

  /// Let a row take the place of one that nobody reads any more.
  void keep_rows(Slot columns) {
    std::vector<std::size_t> last_read(next_, 0);
    for (std::size_t i = 0; i < to_.steps_.size(); ++i)
      last_read[to_.steps_[i].a] = last_read[to_.steps_[i].b] = i;
    for (Slot slot = 0; slot <= columns; ++slot) last_read[slot] = kForGood;
    for (const Result& result : to_.results_) last_read[result.row] = kForGood;
    std::vector<Slot> kept(next_), free;
    for (Slot slot = 0; slot <= columns; ++slot) kept[slot] = slot;
    Slot count = columns + 1;
    for (std::size_t i = 0; i < to_.steps_.size(); ++i) {
      Step& step = to_.steps_[i];
      const Slot a = step.a, b = step.b;
      step.a = kept[a];
      step.b = kept[b];
      if (last_read[a] == i) free.push_back(step.a);
      if (last_read[b] == i && b != a) free.push_back(step.b);
      if (free.empty()) free.push_back(count++);
      kept[step.row] = free.back();
      step.row = free.back();
      free.pop_back();
    }
    for (Result& result : to_.results_) result.row = kept[result.row];
    to_.rows_.assign(count, {});
    for (Slot column = 0; column < columns; ++column) to_.rows_[1 + column][column % kWidth] = 1.0;
  }

  void find_turns() {
    std::map<Tape::Place, Tape::Place> sines, cosines;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i].operation == Operation::kSine)
        sines[lines_[i].of[0]] = static_cast<Tape::Place>(i);
      if (lines_[i].operation == Operation::kCosine)
        cosines[lines_[i].of[0]] = static_cast<Tape::Place>(i);
    }
    for (const auto& [angle, sine] : sines) {
      const auto cosine = cosines.find(angle);
      if (cosine == cosines.end()) continue;
      to_.turns_.push_back({sine, cosine->second, 1.0});
      to_.turns_.push_back({cosine->second, sine, -1.0});
    }
  }

  /// Again and again, of the lines whose operands are known, those of the most frequent operation.
  void find_runs() {
    std::vector<std::vector<Tape::Place>> users(lines_.size());
    std::vector<std::size_t> unknown(lines_.size());
    std::map<Operation, std::vector<Tape::Place>> ready;
    for (Tape::Place i = 0; i < lines_.size(); ++i) {
      const auto& [operation, of, constant] = lines_[i];
      for (std::size_t k = 0; k < operands_of(operation); ++k) {
        if (operands_of(lines_[of[k]].operation) == 0) continue;
        users[of[k]].push_back(i);
        ++unknown[i];
      }
      if (operands_of(operation) > 0 && unknown[i] == 0) ready[operation].push_back(i);
    }
    while (true) {
      const auto most = std::ranges::max_element(
          ready, {}, [](const auto& lines) { return lines.second.size(); });
      if (most == ready.end() || most->second.empty()) return;
      to_.runs_.push_back({most->first, std::exchange(most->second, {})});
      for (const Tape::Place line : to_.runs_.back().lines)
        for (const Tape::Place user : users[line])
          if (--unknown[user] == 0) ready[lines_[user].operation].push_back(user);
    }
  }

  Tangents& to_;
  std::span<const Tape::Line> lines_;
  std::vector<std::map<std::size_t, Slot>> rows_of_;  // of every line, by block
  Slot next_ = 0;
};

namespace {

/// A tape in which every angle whose sine is taken has a cosine, too.
Tape with_all_turns(Tape tape) {
  std::map<Tape::Place, int> asked;  // 1: the sine, 2: the cosine, 3: both
  for (const Tape::Line& line : tape.lines()) {
    if (line.operation == Operation::kSine) asked[line.of[0]] |= 1;
    if (line.operation == Operation::kCosine) asked[line.of[0]] |= 2;
  }
  for (const auto& [angle, which] : asked) {
    if (which == 1) tape.add(Operation::kCosine, {angle});
    if (which == 2) tape.add(Operation::kSine, {angle});
  }
  return tape;
}

}  // namespace

Tangents::Tangents(Tape tape, std::span<const std::size_t> with_respect_to)
    : tape_(with_all_turns(std::move(tape))),
      columns_(with_respect_to.size()),
      values_(tape_.lines().size()),
      slopes_(tape_.lines().size()),
      jacobian_(rows() * columns_) {
  Builder(*this).build(with_respect_to);
}

/// Values, and how each line answers to its operands.
void Tangents::evaluate(std::span<const double> in) {
  const std::span<const Tape::Line> lines = tape_.lines();
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].operation == Operation::kInput) values_[i] = in[lines[i].of[0]];
  for (const Run& run : runs_) evaluate(run);
  for (const Turn& turn : turns_) slopes_[turn.line] = {turn.sign * values_[turn.slope], 0.0};
}

void Tangents::evaluate(const Run& run) {
  const Tape::Line* const lines = tape_.lines().data();
  double* const values = values_.data();
  std::array<double, 2>* const slopes = slopes_.data();
  const auto each = [&](const auto& evaluate_one) {
    for (const Tape::Place i : run.lines)
      evaluate_one(values[i], slopes[i], values[lines[i].of[0]], values[lines[i].of[1]],
                   values[lines[i].of[2]]);
  };
  using Slope = std::array<double, 2>;
  switch (run.operation) {  // slopes that never change are there already
    case Operation::kAdd:
      return each([](double& y, Slope&, double a, double b, double) { y = a + b; });
    case Operation::kSubtract:
      return each([](double& y, Slope&, double a, double b, double) { y = a - b; });
    case Operation::kNegate:
      return each([](double& y, Slope&, double a, double, double) { y = -a; });
    case Operation::kMultiply:
      return each([](double& y, Slope& slope, double a, double b, double) {
        y = a * b;
        slope = {b, a};
      });
    case Operation::kDivide:
      return each([](double& y, Slope& slope, double a, double b, double) {
        y = a / b;
        slope = {1.0 / b, -y / b};
      });
    case Operation::kRoot:
      return each([](double& y, Slope& slope, double a, double, double) {
        y = std::sqrt(a);
        slope = {0.5 / y, 0.0};
      });
    case Operation::kChoose:
      return each([](double& y, Slope& slope, double a, double b, double c) {
        y = a != 0.0 ? b : c;
        slope = a != 0.0 ? Slope{1.0, 0.0} : Slope{0.0, 1.0};
      });
    case Operation::kSine:
    case Operation::kCosine:
    case Operation::kIsGreater:
      return each([&run](double& y, Slope&, double a, double b, double c) {
        y = result_of(run.operation, a, b, c);
      });
    case Operation::kInput:
    case Operation::kConstant:
      return;
  }
}

std::span<const double> Tangents::at(std::span<const double> in) {
  if (in.size() != tape_.inputs()) throw std::logic_error("a tape asks for all of its inputs");
  evaluate(in);
  Row* const rows = rows_.data();
  for (const Step& step : steps_) {
    const auto [by_a, by_b] = slopes_[step.line];
    const Row a = rows[step.a], b = rows[step.b];
    Row& row = rows[step.row];
    for (std::size_t k = 0; k < kWidth; ++k) row[k] = by_a * a[k] + by_b * b[k];
  }
  for (const Result& result : results_) {
    const std::size_t first = kWidth * result.block;
    const Row& row = rows[result.row];
    for (std::size_t k = 0; k < kWidth && first + k < columns_; ++k)
      jacobian_[(first + k) * this->rows() + result.output] = row[k];
  }
  return jacobian_;
}

}  // namespace twincraft
