// Both runs share one way from landing to landing; they differ in what is integrated (the engine
// alone, or the engine and its books) and in what is done at a landing.
// Tested by tests/runtime/propagate_test.cpp.
#include "runtime/simulate/propagate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "compiler/ir/inputs.h"
#include "compiler/ir/number.h"
#include "runtime/integrate/engine_ode.h"
#include "runtime/integrate/landings.h"
#include "runtime/reference/stored.h"

namespace twincraft {
namespace {

// The books are quadratures appended behind the state: nothing reads them back.
constexpr std::size_t kBooks = 8;

class BookkeepingOde : public Ode {
 public:
  explicit BookkeepingOde(Engine& engine)
      : engine_(engine), size_(static_cast<std::size_t>(engine.layout().size())) {}
  int size() const override { return static_cast<int>(size_ + kBooks); }
  void derivative(double time, std::span<const double> state, std::span<double> rate) override {
    BookRates of_books;
    engine_.derivative(time, state.first(size_), rate.first(size_), &of_books);
    const std::span<double> books = rate.last(kBooks);
    books[0] = of_books.power;
    Vector3d::Map(&books[1]) = of_books.force_N;
    Vector3d::Map(&books[4]) = of_books.torque_PntC_N;
    books[7] = of_books.own_power;
  }
  void finish_step(std::span<double> state) override { engine_.finish_step(state.first(size_)); }

 private:
  Engine& engine_;
  std::size_t size_;
};

/// The trial step of an adaptive method may be far too long and end in a state that no engine can
/// evaluate: that is no failure, but a step to be rejected, as for any other non-finite rate.
class ExcusingOde : public Ode {
 public:
  explicit ExcusingOde(Ode& ode) : ode_(ode) {}
  int size() const override { return ode_.size(); }
  void derivative(double time, std::span<const double> state, std::span<double> rate) override {
    try {
      ode_.derivative(time, state, rate);
    } catch (const NumericalFailure& failure) {
      std::ranges::fill(rate, std::numeric_limits<double>::quiet_NaN());
      excuse_ = failure.what();
    }
  }
  void finish_step(std::span<double> state) override { ode_.finish_step(state); }

  /// The engine's own words, for when no step is short enough; empty before it failed.
  const std::string& excuse() const { return excuse_; }
  void forgive() { excuse_.clear(); }

 private:
  Ode& ode_;
  std::string excuse_;
};

bool is_adaptive(const Model& model) { return tableau_of(model.simulation.method).adaptive; }

Books books_of(std::span<const double> state) {
  const std::span<const double> books = state.last(kBooks);
  return {books[0], Vector3d::Map(&books[1]), Vector3d::Map(&books[4]), books[7]};
}

std::string coordinate_name(const Model& model, bool is_wheel, int index) {
  for (const Coordinate& coordinate : model.coordinates) {
    const bool names_wheel = coordinate.kind == Coordinate::Kind::kWheel;
    if (names_wheel == is_wheel && coordinate.index == index) return coordinate.name;
  }
  return fmt::format("{} {}", is_wheel ? "wheel" : "joint", index);
}

/// A name for every entry of the state and the books behind it, as in the CSV files.
std::vector<std::string> state_names(const Model& model, const StateLayout& layout) {
  std::vector<std::string> names;
  const auto add = [&names](std::string_view vector, std::string_view components) {
    for (const char component : components)
      names.push_back(fmt::format("{}.{}", vector, component));
  };
  add("r_BN_N", "xyz");
  add("v_BN_N", "xyz");
  if (layout.attitude_size() == 3) add("sigma_BN", "123");
  if (layout.attitude_size() == 4) add("q_BN", "wxyz");
  if (layout.rate_size() > 0) add("omega_BN_B", "xyz");
  for (const char* quantity : {"position", "rate"}) {
    for (int link = 1; link <= layout.joints; ++link)
      names.push_back(coordinate_name(model, false, link) + "." + quantity);
  }
  for (int rotor = 0; rotor < layout.wheels; ++rotor)
    names.push_back(coordinate_name(model, true, rotor) + ".rate");
  names.push_back("work");
  add("impulse_N", "xyz");
  add("angular_impulse_N", "xyz");
  names.push_back("own_work");
  return names;
}

/// Inputs change there, or a stored state waits: a run has to meet what it is held against.
std::vector<double> events_of(const Model& model) {
  std::vector<double> times = input_events(model);
  for (const StoredState& state : model.stored.states)
    if (state.time > 0.0 && state.time < model.simulation.duration) times.push_back(state.time);
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// An engine at t = 0 and its way from landing to landing.
class Run {
 public:
  Run(Engine& engine, Ode& ode, const Model& model)
      : engine_(engine),
        excusing_(ode),
        stepper_(tableau_of(model.simulation.method), is_adaptive(model) ? excusing_ : ode),
        names_(state_names(model, engine.layout())),
        control_(engine.layout(), model.simulation.tolerance, names_),
        landings_(model.simulation.step, model.simulation.duration, events_of(model)),
        feed_(model) {
    engine.hold(feed_.begin(0.0));
    const Eigen::VectorXd initial = engine.initial_state();
    std::copy(initial.begin(), initial.end(), stepper_.state().begin());
  }

  bool done() const { return landings_.done(); }
  double time() const { return time_; }
  double tolerance() const { return landings_.tolerance(); }
  std::span<const double> state() { return stepper_.state(); }
  const StepCounts& counts() const { return counts_; }
  const AcceptedErrors& accepted() const { return accepted_; }

  /// To the next landing, or as far as an adaptive method got when `*stop` became true.
  /// @throws NumericalFailure
  void advance(const std::atomic<bool>* stop = nullptr) {
    const Landing landing = landings_.next();
    if (stepper_.tableau().adaptive) {
      advance_adaptively(landing.time, stop);
    } else {
      stepper_.step(time_, landing.time - time_);
      counts_.evaluations += stepper_.tableau().stages;
      ++counts_.accepted;
      if (!stepper_.state_is_finite()) fail();
      time_ = landing.time;
    }
    if (landing.is_event) engine_.hold(feed_.begin(landing.time));
  }

 private:
  void advance_adaptively(double to, const std::atomic<bool>* stop) {
    excusing_.forgive();
    try {
      time_ = control_.advance(stepper_, time_, to, counts_, stop, &accepted_);
    } catch (const NumericalFailure&) {
      if (excusing_.excuse().empty()) throw;
      throw NumericalFailure(excusing_.excuse() + ", however short the step");
    }
  }

  [[noreturn]] void fail() const {
    const auto entry = static_cast<std::size_t>(stepper_.first_non_finite());
    throw NumericalFailure(fmt::format("`{}` is not finite", names_[entry]));
  }

  Engine& engine_;
  ExcusingOde excusing_;
  RungeKutta stepper_;
  std::vector<std::string> names_;
  StepControl control_;
  Landings landings_;
  InputFeed feed_;
  double time_ = 0.0;
  StepCounts counts_;
  AcceptedErrors accepted_;
};

// No wheel, hinge or hub turns a hundred million radians a second, nothing outruns light, and no
// slide is longer than a thousand kilometres: such a state is finite and still no motion.
constexpr double kAbsurdRate = 1.0e8;          // [rad/s]
constexpr double kAbsurdSpeed = 2.998e8;       // [m/s]
constexpr double kAbsurdDisplacement = 1.0e6;  // [m]

void refuse_absurd(const Observation& seen, const Model& model) {
  const auto refuse = [](const std::string& name, double value, std::string_view unit) {
    throw NumericalFailure(fmt::format("`{}` is absurd: {:.3g} {}", name, value, unit));
  };
  if (!(seen.omega_BN_B.norm() < kAbsurdRate))
    refuse("omega_BN_B", seen.omega_BN_B.norm(), "rad/s");
  if (!(seen.v_BN_N.norm() < kAbsurdSpeed)) refuse("v_BN_N", seen.v_BN_N.norm(), "m/s");
  for (const Coordinate& coordinate : model.coordinates) {
    const auto index = static_cast<std::size_t>(coordinate.index);
    const bool is_wheel = coordinate.kind == Coordinate::Kind::kWheel;
    const bool slides = coordinate.is_length();
    const double rate = is_wheel ? seen.wheel_rate[index] : seen.joint_rate[index - 1];
    if (!(std::abs(rate) < (slides ? kAbsurdSpeed : kAbsurdRate)))
      refuse(coordinate.name + ".rate", rate, slides ? "m/s" : "rad/s");
    if (slides && !(std::abs(seen.joint_position[index - 1]) < kAbsurdDisplacement))
      refuse(coordinate.name + ".position", seen.joint_position[index - 1], "m");
  }
}

/// Which landings are recorded.
class Recorder {
 public:
  Recorder(double interval, double tolerance) : interval_(interval), tolerance_(tolerance) {}
  bool is_due(double time) const { return time >= next_ - tolerance_; }
  void recorded(double time) {
    next_ = (std::floor((time + tolerance_) / interval_) + 1.0) * interval_;
  }

 private:
  double interval_;
  double tolerance_;
  double next_ = 0.0;
};

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

/// The run and what is written down on its way.
class RecordedRun::Flight {
 public:
  Flight(Engine& engine, const Model& model, SampleSink& sink, PropagateOptions options)
      : engine_(engine),
        model_(model),
        sink_(sink),
        options_(std::move(options)),
        ode_(engine),
        run_(engine, ode_, model),
        recorder_(model.simulation.record, run_.tolerance()),
        progress_(options_.progress) {
    guarded([this] {
      record();
      capture_instants();
    });
  }

  bool ended() const { return ended_; }
  double time() const { return run_.time(); }

  void advance_until(double time) {
    if (!ended_) guarded([this, time] { fly(time); });
  }

  Trajectory take_trajectory() {
    trajectory_.counts = run_.counts();
    trajectory_.accepted = run_.accepted();
    if (trajectory_.recorded > 0) {
      trajectory_.samples.push_back(std::move(last_));
      trajectory_.books.push_back(last_books_);
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
    while (run_.time() < until && !run_.done() && !stopped()) {
      run_.advance(options_.stop);
      trajectory_.t_end = run_.time();
      if (recorder_.is_due(run_.time()) || is_stored_time(model_.stored, run_.time())) record();
      if (run_.time() >= next_instant_) capture_instants();
      progress_.at(run_.time());
    }
    if (run_.done() || stopped()) end();
  }

  void end() {
    if (last_.time != run_.time()) record();
    if (run_.time() < model_.simulation.duration)
      trajectory_.status = Trajectory::Status::kInterrupted;
    ended_ = true;
  }

  std::span<const double> state() {
    return run_.state().first(static_cast<std::size_t>(engine_.layout().size()));
  }

  void record() {
    engine_.observe(run_.time(), state(), last_);
    refuse_absurd(last_, model_);
    last_books_ = books_of(run_.state());
    ++trajectory_.recorded;
    recorder_.recorded(run_.time());
    sink_.take(last_, last_books_);
  }

  /// All that have come, and when the next one does.
  void capture_instants() {
    const std::vector<double>& instants = options_.instants;
    std::size_t next = trajectory_.instants.size();
    for (; next < instants.size() && run_.time() >= instants[next] - run_.tolerance(); ++next)
      trajectory_.instants.push_back(engine_.observe(run_.time(), state()));
    next_instant_ = next < instants.size() ? instants[next] - run_.tolerance() : kNever;
  }

  static constexpr double kNever = std::numeric_limits<double>::infinity();

  Engine& engine_;
  const Model& model_;
  SampleSink& sink_;
  PropagateOptions options_;
  BookkeepingOde ode_;
  Run run_;
  Recorder recorder_;
  Progress progress_;
  Trajectory trajectory_;
  Observation last_;  // taken
  Books last_books_;
  double next_instant_ = kNever;
  bool ended_ = false;
};

RecordedRun::RecordedRun(Engine& engine, const Model& model, SampleSink& sink,
                         PropagateOptions options)
    : flight_(std::make_unique<Flight>(engine, model, sink, std::move(options))) {}

RecordedRun::~RecordedRun() = default;

void RecordedRun::advance_until(double time) { flight_->advance_until(time); }
bool RecordedRun::ended() const { return flight_->ended(); }
double RecordedRun::time() const { return flight_->time(); }
Trajectory RecordedRun::take_trajectory() { return flight_->take_trajectory(); }

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
  EngineOde ode(engine);
  Run run(engine, ode, model);
  while (!run.done() && !(stop != nullptr && *stop)) run.advance();
  return run.counts();
}

}  // namespace twincraft
