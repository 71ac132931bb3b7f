#include "runtime/campaign/reductions.h"

#include <algorithm>
#include <cmath>

namespace twincraft {
namespace {

struct Sample {
  double time = 0.0, value = 0.0;
};

/// When the straight line through two samples has a value. @pre it lies between theirs, which
/// differ
double time_at(double value, const Sample& from, const Sample& to) {
  return from.time + (value - from.value) / (to.value - from.value) * (to.time - from.time);
}

double itself(double value) { return value; }
double negated(double value) { return -value; }
double magnitude(double value) { return std::abs(value); }

/// The sample of which a measure is largest. Each measure, taken twice, is the result.
class Extreme : public Reduction {
 public:
  using Measure = double (*)(double);
  explicit Extreme(Measure measure) : measure_(measure) {}

  void take(double /*time*/, double value) override {
    const double measured = measure_(value);
    largest_ = largest_ ? std::max(*largest_, measured) : measured;
  }
  std::optional<double> result() const override {
    return largest_ ? std::optional(measure_(*largest_)) : std::nullopt;
  }

 private:
  Measure measure_;
  std::optional<double> largest_;
};

class Final : public Reduction {
 public:
  void take(double /*time*/, double value) override { last_ = value; }
  std::optional<double> result() const override { return last_; }

 private:
  std::optional<double> last_;
};

/// The trapezoidal rule. Of a run of no length the value itself.
class Mean : public Reduction {
 public:
  void take(double time, double value) override {
    if (!last_)
      start_ = time;
    else
      integral_ += 0.5 * (last_->value + value) * (time - last_->time);
    last_ = {time, value};
  }
  std::optional<double> result() const override {
    if (!last_) return std::nullopt;
    return last_->time > start_ ? integral_ / (last_->time - start_) : last_->value;
  }

 private:
  double start_ = 0.0, integral_ = 0.0;
  std::optional<Sample> last_;
};

class RootMeanSquare : public Reduction {
 public:
  void take(double time, double value) override { square_.take(time, value * value); }
  std::optional<double> result() const override {
    const std::optional<double> mean = square_.result();
    return mean ? std::optional(std::sqrt(*mean)) : std::nullopt;
  }

 private:
  Mean square_;
};

/// The band is known at the end alone. The last sample above it is above all that follow it, and
/// the last below it is below them: only samples of these two kinds are kept. Of a signal that
/// swings there are few, of one that always falls or rises all.
class SettlingTime : public Reduction {
 public:
  explicit SettlingTime(double within) : within_(within) {}

  void take(double time, double value) override {
    const Sample sample{time, value};
    if (!last_) start_ = time;
    keep(sample, 1.0, highest_);
    keep(sample, -1.0, lowest_);
    last_ = sample;
  }

  std::optional<double> result() const override {
    if (!last_) return std::nullopt;
    return std::max(settled(1.0, highest_), settled(-1.0, lowest_));
  }

 private:
  struct Kept {
    Sample sample, next;
  };

  /// @param sign  1: samples above all that follow, -1: below
  static void keep(const Sample& sample, double sign, std::vector<Kept>& kept) {
    const std::size_t before = kept.size();
    while (!kept.empty() && sign * kept.back().sample.value <= sign * sample.value) kept.pop_back();
    // The sample before this one was kept last, if it still is.
    if (!kept.empty() && kept.size() == before) kept.back().next = sample;
    kept.push_back({sample, sample});
  }

  /// When it last enters the band through one of its ends.
  double settled(double sign, const std::vector<Kept>& kept) const {
    const double end = last_->value + sign * within_;
    // Values of `kept` fall (rise), so those outside come first.
    const auto inside = std::ranges::partition_point(
        kept, [&](const Kept& one) { return sign * one.sample.value > sign * end; });
    if (inside == kept.begin()) return start_;
    const Kept& outside = *std::prev(inside);
    return time_at(end, outside.sample, outside.next);
  }

  double within_, start_ = 0.0;
  std::vector<Kept> highest_, lowest_;
  std::optional<Sample> last_;
};

class FirstCrossing : public Reduction {
 public:
  explicit FirstCrossing(double level) : level_(level) {}

  void take(double time, double value) override {
    if (crossed_) return;
    const Sample sample{time, value};
    if (value == level_)
      crossed_ = time;
    else if (last_ && (last_->value < level_) != (value < level_))
      crossed_ = time_at(level_, *last_, sample);
    last_ = sample;
  }
  std::optional<double> result() const override { return crossed_; }

 private:
  double level_;
  std::optional<Sample> last_;
  std::optional<double> crossed_;
};

}  // namespace

std::unique_ptr<Reduction> Reduction::make(const OutputPlan& plan) {
  switch (plan.reduce) {
    case Reduce::kMax:
    case Reduce::kMaxNorm:  // the signal is the norm
      return std::make_unique<Extreme>(itself);
    case Reduce::kMin:
      return std::make_unique<Extreme>(negated);
    case Reduce::kMaxAbs:
      return std::make_unique<Extreme>(magnitude);
    case Reduce::kFinal:
      return std::make_unique<Final>();
    case Reduce::kMean:
      return std::make_unique<Mean>();
    case Reduce::kRms:
      return std::make_unique<RootMeanSquare>();
    case Reduce::kSettlingTime:
      return std::make_unique<SettlingTime>(plan.within);
    case Reduce::kFirstCrossing:
      break;
  }
  return std::make_unique<FirstCrossing>(plan.level);
}

OutputReducer::OutputReducer(const Model& model, std::span<const OutputPlan> outputs) {
  for (const OutputPlan& plan : outputs)
    outputs_.push_back({SignalReader(model, plan.signal), Reduction::make(plan)});
}

void OutputReducer::take(const Observation& sample) {
  for (Output& output : outputs_) output.reduction->take(sample.time, output.signal(sample));
}

std::vector<std::optional<double>> OutputReducer::results() const {
  std::vector<std::optional<double>> results;
  for (const Output& output : outputs_) {
    std::optional<double> result = output.reduction->result();
    if (result && !std::isfinite(*result)) result.reset();
    results.push_back(result);
  }
  return results;
}

}  // namespace twincraft
