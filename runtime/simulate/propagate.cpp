// What is recorded of a flight, and when.
// Tested by tests/runtime/propagate_test.cpp.
#include "runtime/simulate/propagate.h"

#include <chrono>
#include <limits>
#include <utility>

#include "runtime/simulate/samples.h"
#include "runtime/simulate/waiting_samples.h"

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
        waiting_(engine) {
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
      trajectory_.samples.push_back(waiting_.last().seen);
      trajectory_.books.push_back(waiting_.last().beside);
    }
    return std::move(trajectory_);
  }

 private:
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
    recorded_at_ = flight_.time();
    refuse_absurd(flight_.state(), engine_.layout(), model_);
    waiting_.add(recorded_at_, flight_.state(), flight_.books());
    ++trajectory_.recorded;
    due_.taken(recorded_at_);
    if (waiting_.is_full()) deliver();
  }

  /// What waits, to the sink. When that is depends on nothing but the number of samples.
  void deliver() {
    waiting_.deliver([this](const Observation& seen, const Books& books) {
      sink_.take(seen, books);
      return true;
    });
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
  WaitingSamples<Books> waiting_;
  double recorded_at_ = -1.0;  // [s] the last of them
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
