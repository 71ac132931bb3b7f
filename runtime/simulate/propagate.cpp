// What is recorded of a flight, and when.
// Tested by tests/runtime/propagate_test.cpp.
#include "runtime/simulate/propagate.h"

#include <chrono>
#include <limits>
#include <utility>

#include "runtime/simulate/samples.h"

namespace twincraft {
namespace {

class Progress {
 public:
  explicit Progress(const std::function<void(double)>& report) : report_(report) {}
  void at(double time) {
    if (!report_ || Clock::now() - last_ < std::chrono::milliseconds(50)) return;
    report_(time);
    last_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  const std::function<void(double)>& report_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace

/// The flight and what is written down on its way.
class RecordedRun::Recording {
 public:
  Recording(Engine& engine, const Model& model, SampleSink& sink, PropagateOptions options)
      : engine_(engine),
        model_(model),
        sink_(sink),
        options_(std::move(options)),
        flight_(engine, model, {.keeps_books = true}),
        due_(model, flight_.tolerance()),
        progress_(options_.progress),
        last_(std::make_unique<Sample>(engine.layout())) {
    for (std::size_t i = 0; i < engine.summed_at_once(); ++i)
      waiting_.push_back(std::make_unique<Sample>(engine.layout()));
    guarded([this] {
      record();
      capture_instants();
    });
    if (ended_) deliver();
  }

  bool ended() const { return ended_; }
  double time() const { return flight_.time(); }

  void advance_until(double time) {
    if (ended_) return;
    guarded([this, time] { fly(time); });
    if (ended_) deliver();
  }

  Trajectory take_trajectory() {
    trajectory_.counts = flight_.counts();
    trajectory_.accepted = flight_.accepted();
    deliver();
    if (trajectory_.recorded > 0) {
      trajectory_.samples.push_back(std::move(last_->seen));
      trajectory_.books.push_back(last_->books);
    }
    return std::move(trajectory_);
  }

 private:
  struct Sample {
    /// With all the room that it will ever need: a step takes nothing from the heap.
    explicit Sample(const StateLayout& layout) {
      seen.joint_position.resize(static_cast<std::size_t>(layout.joints));
      seen.joint_rate.resize(static_cast<std::size_t>(layout.joints));
      seen.wheel_rate.resize(static_cast<std::size_t>(layout.wheels));
    }
    Observation seen;
    Books books;
  };

  template <class Work>
  void guarded(const Work& work) {
    try {
      work();
    } catch (const NumericalFailure& failure) {
      trajectory_.status = Trajectory::Status::kFailed;
      trajectory_.failure = failure.what();
      ended_ = true;
    }
  }

  bool stopped() const { return options_.stop != nullptr && *options_.stop; }

  void fly(double until) {
    while (flight_.time() < until && !flight_.done() && !stopped()) {
      flight_.advance(options_.stop);
      trajectory_.t_end = flight_.time();
      if (due_.at(flight_.time())) record();
      if (flight_.time() >= next_instant_) capture_instants();
      progress_.at(flight_.time());
    }
    if (flight_.done() || stopped()) end();
  }

  void end() {
    if (recorded_at_ != flight_.time()) record();
    if (flight_.time() < model_.simulation.duration)
      trajectory_.status = Trajectory::Status::kInterrupted;
    ended_ = true;
  }

  void record() {
    Sample& sample = *waiting_[waiting_count_];
    recorded_at_ = flight_.time();
    engine_.note(recorded_at_, flight_.state(), sample.seen);
    refuse_absurd(sample.seen, model_);
    sample.books = flight_.books();
    ++trajectory_.recorded;
    due_.taken(recorded_at_);
    if (++waiting_count_ == waiting_.size()) deliver();
  }

  /// What waits, to the sink. When that is depends on nothing but the number of samples.
  void deliver() {
    engine_.sum_up_noted();
    if (waiting_count_ == 0) return;
    for (std::size_t i = 0; i < waiting_count_; ++i)
      sink_.take(waiting_[i]->seen, waiting_[i]->books);
    std::swap(last_, waiting_[waiting_count_ - 1]);
    waiting_count_ = 0;
  }

  /// All that have come, and when the next one does.
  void capture_instants() {
    const std::vector<double>& instants = options_.instants;
    std::size_t next = trajectory_.instants.size();
    for (; next < instants.size() && flight_.time() >= instants[next] - flight_.tolerance(); ++next)
      trajectory_.instants.push_back(engine_.observe(flight_.time(), flight_.state()));
    next_instant_ = next < instants.size() ? instants[next] - flight_.tolerance() : kNever;
  }

  static constexpr double kNever = std::numeric_limits<double>::infinity();

  Engine& engine_;
  const Model& model_;
  SampleSink& sink_;
  PropagateOptions options_;
  Flight flight_;
  SampleTimes due_;
  Progress progress_;
  Trajectory trajectory_;
  std::vector<std::unique_ptr<Sample>> waiting_;  // as many as the engine sums up at once
  std::size_t waiting_count_ = 0;
  double recorded_at_ = -1.0;     // [s] the last of them
  std::unique_ptr<Sample> last_;  // that the sink has taken
  double next_instant_ = kNever;
  bool ended_ = false;
};

RecordedRun::RecordedRun(Engine& engine, const Model& model, SampleSink& sink,
                         PropagateOptions options)
    : recording_(std::make_unique<Recording>(engine, model, sink, std::move(options))) {}

RecordedRun::~RecordedRun() = default;

void RecordedRun::advance_until(double time) { recording_->advance_until(time); }
bool RecordedRun::ended() const { return recording_->ended(); }
double RecordedRun::time() const { return recording_->time(); }
Trajectory RecordedRun::take_trajectory() { return recording_->take_trajectory(); }

void SampleStore::take(const Observation& sample, const Books& now) {
  samples.push_back(sample);
  books.push_back(now);
}

Trajectory propagate(Engine& engine, const Model& model, const PropagateOptions& options) {
  SampleStore store;
  RecordedRun run(engine, model, store, options);
  run.advance_until(std::numeric_limits<double>::infinity());
  Trajectory trajectory = run.take_trajectory();
  trajectory.samples = std::move(store.samples);
  trajectory.books = std::move(store.books);
  return trajectory;
}

StepCounts propagate_bare(Engine& engine, const Model& model, const std::atomic<bool>* stop) {
  Flight run(engine, model);
  while (!run.done() && !(stop != nullptr && *stop)) run.advance();
  return run.counts();
}

}  // namespace twincraft
