// See batch.h.
#include "runtime/api/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "runtime/api/faults.h"
#include "runtime/simulate/engines.h"

namespace twincraft::api {

/// Signals of members, each into a row.
class Batch::Reading {
 public:
  Reading(const std::vector<OutputSignal>& signals, WaitingRows& waiting)
      : signals_(signals), waiting_(waiting) {}

  void see(const Observation& seen, std::span<double> row) const {
    read_signals(signals_, seen, row);
  }
  void note(double time, std::span<const double> state, std::span<double> row) {
    waiting_.add(time, state, row);
    if (waiting_.is_full()) finish();
  }
  void finish() {
    waiting_.deliver([this](const Observation& seen, std::span<double> row) {
      see(seen, row);
      return true;
    });
  }

 private:
  const std::vector<OutputSignal>& signals_;
  WaitingRows& waiting_;
};

class Batch::Group {
 public:
  virtual ~Group() = default;
  virtual double time() const = 0;
  virtual void step(std::size_t count) = 0;
  virtual void read(std::size_t place, Reading& reading, std::span<double> row) = 0;
  virtual void set_state(std::size_t place, std::span<const double> numbers) = 0;
  virtual double input(std::size_t place, std::size_t port) const = 0;
  virtual void drive(std::size_t place, std::span<const double> values) = 0;
  virtual void release(std::size_t place, std::size_t ports) = 0;
  /// After all places were driven or released.
  virtual void hold() {}
  virtual const std::string& failure(std::size_t place) const = 0;
};

class Batch::Together final : public Group {
 public:
  Together(const CompiledModel& model, const bsm::Plan& plan)
      : model_(model),
        layout_{model.model().engines.attitude,
                static_cast<int>(model.model().assembly.links.size()) - 1,
                static_cast<int>(model.model().assembly.rotors.size())},
        flight_(std::vector(LanesFlight::lanes(), LanesFlight::Craft{&model.model(), &plan})),
        state_(static_cast<std::size_t>(layout_.size())) {}

  double time() const override { return flight_.time(); }
  void step(std::size_t count) override {
    for (std::size_t i = 0; i < count; ++i) flight_.advance_on_grid();
  }
  void read(std::size_t place, Reading& reading, std::span<double> row) override {
    flight_.read_state(place, state_);
    reading.note(time(), state_, row);
  }
  void set_state(std::size_t place, std::span<const double> numbers) override {
    const Eigen::VectorXd packed = pack(state_from(model_, numbers), layout_);
    flight_.set_state(place, {packed.data(), static_cast<std::size_t>(packed.size())});
  }
  double input(std::size_t place, std::size_t port) const override {
    return flight_.input(place, port);
  }
  void drive(std::size_t place, std::span<const double> values) override {
    for (std::size_t i = 0; i < values.size(); ++i) flight_.drive(place, i, values[i]);
  }
  void release(std::size_t place, std::size_t ports) override {
    for (std::size_t i = 0; i < ports; ++i) flight_.release(place, i);
  }
  void hold() override { flight_.hold(); }
  const std::string& failure(std::size_t place) const override { return flight_.failure(place); }

 private:
  const CompiledModel& model_;
  StateLayout layout_;
  LanesFlight flight_;
  std::vector<double> state_;  // of one of them
};

/// A member that the lanes do not serve: its steps or its masses are its own.
class Batch::Alone final : public Group {
 public:
  /// @param like  a member of the same model
  explicit Alone(const Simulation& like) : simulation_(like.copy()) {}

  double time() const override { return simulation_->time(); }
  void step(std::size_t count) override {
    for (std::size_t i = 0; i < count; ++i) {
      if (failure_.empty()) try_step();
      if (!failure_.empty()) simulation_->pass();  // it may be given another state later
    }
  }
  void read(std::size_t, Reading& reading, std::span<double> row) override {
    reading.see(simulation_->observe(), row);
  }
  void set_state(std::size_t, std::span<const double> numbers) override {
    simulation_->set_state(numbers);
    failure_.clear();
  }
  double input(std::size_t, std::size_t port) const override { return simulation_->input(port); }
  void drive(std::size_t, std::span<const double> values) override {
    simulation_->drive(0, values);
  }
  void release(std::size_t, std::size_t ports) override {
    for (std::size_t i = 0; i < ports; ++i) simulation_->release(i);
  }
  const std::string& failure(std::size_t) const override { return failure_; }

 private:
  void try_step() {
    try {
      simulation_->step(1);
    } catch (const NumericalFailure& failure) {
      failure_ = failure.what();
    }
  }

  std::unique_ptr<Simulation> simulation_;
  std::string failure_;
};

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// A round of steps after which a poll is asked takes about this long.
constexpr double kRound = 0.05;  // [s]

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Batch::Batch(std::shared_ptr<const CompiledModel> model, std::size_t count, std::size_t threads)
    : model_(std::move(model)),
      count_(count),
      threads_(threads != 0 ? threads : std::max(1u, std::thread::hardware_concurrency())),
      observer_(make_engine(EngineKind::kBsm, model_->bundle())),
      waiting_(*observer_) {
  if (count == 0) refuse("a batch has at least one member");
  const Model& m = model_->model();
  if (LanesFlight::refusal(m).empty()) {
    per_group_ = LanesFlight::lanes();
    plan_ = std::make_unique<bsm::Plan>(bsm::make_plan(m.assembly, m.engines.attitude, m.gravity,
                                                       m.loads, m.engines.chains, m.forces));
  }
  const std::size_t groups = (count + per_group_ - 1) / per_group_;
  if (plan_) {
    for (std::size_t i = 0; i < groups; ++i)
      groups_.push_back(std::make_unique<Together>(*model_, *plan_));
  } else {
    const Simulation first(model_, EngineKind::kBsm);
    for (std::size_t i = 0; i < groups; ++i) groups_.push_back(std::make_unique<Alone>(first));
  }
}

Batch::~Batch() = default;

double Batch::time() const { return groups_.front()->time(); }

std::size_t Batch::rows_of(std::span<const double> rows, std::size_t width,
                           const char* what) const {
  if (rows.size() != width && rows.size() != width * count_)
    refuse(fmt::format("{} of {} members are {} rows of {} numbers, or one, not {} numbers", what,
                       count_, count_, width, rows.size()));
  return rows.size() == width ? 1 : count_;
}

void Batch::read_states(std::span<double> rows) { observe_all(model_->state_signals(), rows); }

void Batch::read_outputs(std::span<double> rows) { observe_all(model_->output_signals(), rows); }

void Batch::observe_all(const std::vector<OutputSignal>& signals, std::span<double> rows) {
  const std::size_t width = rows.size() / count_;
  Reading reading(signals, waiting_);
  for (std::size_t member = 0; member < count_; ++member) {
    const std::span<double> row = rows.subspan(member * width, width);
    if (!failure(member).empty()) {
      std::ranges::fill(row, kNaN);
      continue;
    }
    groups_[group_of(member)]->read(member % per_group_, reading, row);
  }
  reading.finish();
}

void Batch::read_inputs(std::span<double> rows) const {
  const std::size_t width = model_->inputs().size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t member = i / width;
    rows[i] = groups_[group_of(member)]->input(member % per_group_, i % width);
  }
}

void Batch::set_states(std::span<const double> rows) {
  const std::size_t width = model_->states().size();
  const std::size_t given = rows_of(rows, width, "states");
  for (std::size_t row = 0; row < given; ++row)
    (void)state_from(*model_, rows.subspan(row * width, width));
  for (std::size_t member = 0; member < count_; ++member)
    groups_[group_of(member)]->set_state(member % per_group_,
                                         rows.subspan(given == 1 ? 0 : member * width, width));
}

void Batch::drive(std::span<const double> rows) {
  const std::size_t width = model_->inputs().size();
  const std::size_t given = rows_of(rows, width, "inputs");
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!std::isfinite(rows[i]))
      refuse(fmt::format("{} for `{}` is not finite", rows[i], model_->inputs().name(i % width)));
  for (std::size_t member = 0; member < count_; ++member)
    groups_[group_of(member)]->drive(member % per_group_,
                                     rows.subspan(given == 1 ? 0 : member * width, width));
  for (const auto& group : groups_) group->hold();
}

void Batch::release() {
  for (std::size_t member = 0; member < count_; ++member)
    groups_[group_of(member)]->release(member % per_group_, model_->inputs().size());
  for (const auto& group : groups_) group->hold();
}

const std::string& Batch::failure(std::size_t member) const {
  return groups_[group_of(member)]->failure(member % per_group_);
}

void Batch::step(std::size_t count, const Poll& poll) {
  std::size_t round = poll ? std::min<std::size_t>(count, 8) : count;
  while (count > 0) {
    const double start = now();
    step_all(round);
    count -= round;
    if (count > 0 && poll && poll()) throw Fault(TC_INTERRUPTED, "interrupted");
    const double rounds = kRound / std::max(now() - start, 1e-9);
    round = std::min(
        count, std::clamp<std::size_t>(
                   static_cast<std::size_t>(static_cast<double>(round) * rounds), 1, 4 * round));
  }
}

void Batch::step_all(std::size_t count) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr fault;
  std::mutex of_fault;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < groups_.size(); i = next++) groups_[i]->step(count);
    } catch (...) {
      const std::lock_guard lock(of_fault);
      fault = std::current_exception();
    }
  };
  std::vector<std::jthread> helpers;
  try {
    for (std::size_t i = 1; i < std::min(threads_, groups_.size()); ++i) helpers.emplace_back(work);
  } catch (const std::system_error&) {
    // Out of threads: those there are do it all.
  }
  work();
  helpers.clear();
  if (fault) std::rethrow_exception(fault);
}

}  // namespace twincraft::api
