// See twin_flight.h. Each engine makes what it can of its own samples; pairs of both are compared
// as soon as they are there.
#include "runtime/study/twin_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <future>
#include <system_error>
#include <utility>

#include "compiler/ir/number.h"
#include "runtime/compare/pairing.h"
#include "runtime/reference/running.h"
#include "runtime/simulate/engines.h"
#include "runtime/study/resolve.h"

namespace twincraft {
namespace {

using Status = EngineRun::Status;

/// Why an engine is not run at all; empty when it is.
std::string skip_reason(EngineKind engine, const Model& model, const RunOptions& options) {
  if (!(engine == EngineKind::kBsm ? options.bsm : options.mujoco)) return "not asked for";
  if (options.stopped()) return "interrupted";
  return refusal_of(engine, model);
}

/// One engine on its way, and what is made of its samples as they come.
class EngineFlight : public SampleSink {
 public:
  /// @param next  gets every sample too
  EngineFlight(EngineKind engine, const Bundle& bundle, const Inspection& inspection,
               const RunOptions& options, SampleSink& next)
      : model_(bundle.model),
        keeps_samples_(options.keep_samples),
        next_(next),
        motion_(bundle.model, inspection.events) {
    run_.name = name_of(engine).key;
    run_.reason = skip_reason(engine, bundle.model, options);
    if (!run_.reason.empty()) {
      run_.status = Status::kSkipped;
      return;
    }
    for (const ReferenceKind kind : model_.references) references_.emplace_back(kind, model_);
    take_off(bundle, inspection, options);
  }
  EngineFlight(const EngineFlight&) = delete;
  EngineFlight& operator=(const EngineFlight&) = delete;

  bool flies() const { return flight_ != nullptr; }
  bool ended() const { return !flies() || flight_->ended(); }
  double time() const { return flies() ? flight_->time() : 0.0; }
  void advance_until(double time) {
    if (!ended()) flight_->advance_until(time);
  }

  void take(const Observation& sample, const Books& books) override {
    conservation_.take(sample, books);
    motion_.see(sample, books);
    for (RunningDeviations& reference : references_) reference.take(sample);
    if (keeps_samples_) store_.take(sample, books);
    next_.take(sample, books);
  }

  /// Its deviations from each of the model's references, in their order; none without samples.
  std::vector<std::vector<Deviation>> deviations() {
    std::vector<std::vector<Deviation>> all;
    for (RunningDeviations& reference : references_) all.push_back(reference.result());
    return all;
  }

  const MotionRecord& motion() const { return motion_; }

  EngineRun conclude() {
    if (flies()) conclude_flight();
    return std::move(run_);
  }

 private:
  /// An engine may not even be built.
  void take_off(const Bundle& bundle, const Inspection& inspection, const RunOptions& options) {
    try {
      engine_ = make_engine(engine_of(run_.name), bundle, options.instructions.set);
      flight_ = std::make_unique<RecordedRun>(
          *engine_, model_, *this,
          PropagateOptions{.stop = options.stop, .instants = inspection.all()});
    } catch (const NumericalFailure& failure) {
      run_.status = Status::kFailed;
      run_.reason = failure.what();
    }
  }

  void conclude_flight() {
    Trajectory& trajectory = run_.trajectory = flight_->take_trajectory();
    if (keeps_samples_) {
      trajectory.samples = std::move(store_.samples);
      trajectory.books = std::move(store_.books);
    }
    run_.conservation = conservation_.result();
    if (trajectory.status == Trajectory::Status::kFailed) {
      run_.status = Status::kFailed;
      run_.reason = trajectory.failure;
    } else if (trajectory.status == Trajectory::Status::kInterrupted) {
      run_.reason = fmt::format("interrupted at t = {} s", shortest(trajectory.t_end));
    }
  }

  const Model& model_;
  const bool keeps_samples_;
  SampleSink& next_;
  EngineRun run_;
  ConservationMeter conservation_;
  MotionRecord motion_;
  std::vector<RunningDeviations> references_;
  SampleStore store_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<RecordedRun> flight_;
};

/// How far both engines go before the next slice: as far as they come in about 50 ms, so that they
/// stay together, an early end leaves a stretch to compare, and changing over costs nothing. How a
/// run is cut changes nothing in it.
class Slices {
 public:
  explicit Slices(const SimulationPlan& plan)
      : step_(plan.step), longest_(kMostSamples * std::max(plan.record, plan.step)) {}

  double next() {
    const Clock::time_point now = Clock::now();
    const bool is_short = now - begin_ < std::chrono::milliseconds(25);
    if (is_short && steps_ * step_ < longest_) steps_ *= 2.0;
    if (now - begin_ > std::chrono::milliseconds(100)) steps_ = std::max(1.0, steps_ / 2.0);
    begin_ = now;
    return time_ += std::min(steps_ * step_, longest_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kMostSamples = 1000.0;
  double step_, longest_;  // [s]
  double steps_ = 0.5;
  double time_ = 0.0;  // [s] where the slice ends
  Clock::time_point begin_ = Clock::now();
};

/// Both engines side by side, as far as they are flown, compared on their way.
class TwinFlight {
 public:
  TwinFlight(const Bundle& bundle, const RunOptions& options, MemberWatch* watch)
      : model_(bundle.model),
        inspection_(plan_inspection(bundle.model)),
        options_(options),
        watch_(watch),
        bsm_(EngineKind::kBsm, bundle, inspection_, options, samples_[0]),
        mujoco_(EngineKind::kMujoco, bundle, inspection_, options, samples_[1]) {}

  void fly(Member& member) {
    bring_together();  // the initial states
    Slices slices(model_.simulation);
    while (!bsm_.ended() || !mujoco_.ended()) {
      advance_until(slices.next());
      bring_together();
      show_progress();
    }
    conclude(member);
  }

 private:
  /// An engine's samples on their way to who watches, and those of a slice to be compared.
  struct Samples : SampleSink {
    MemberWatch* watch;
    std::size_t engine;
    std::vector<Observation> of_slice = {};
    Samples(MemberWatch* who, std::size_t number) : watch(who), engine(number) {}
    void take(const Observation& sample, const Books& books) override {
      if (watch != nullptr) watch->take(engine, sample, books);
      of_slice.push_back(sample);
    }
  };

  void advance_until(double time) {
    if (options_.side_by_side && !bsm_.ended() && !mujoco_.ended()) {
      try {
        std::future<void> bsm =
            std::async(std::launch::async, [this, time] { bsm_.advance_until(time); });
        mujoco_.advance_until(time);
        bsm.get();
        return;
      } catch (const std::system_error&) {
        // Out of threads: one after the other then.
      }
    }
    bsm_.advance_until(time);
    mujoco_.advance_until(time);
  }

  void bring_together() {
    for (Samples& samples : samples_) {
      for (Observation& sample : samples.of_slice) pairing_.add(samples.engine, std::move(sample));
      samples.of_slice.clear();
    }
    if (bsm_.ended()) pairing_.end(0);
    if (mujoco_.ended()) pairing_.end(1);
  }

  void take_pair(const Observation& bsm, const Observation& mujoco) {
    agreement_.take(bsm, mujoco);
    if (watch_ != nullptr) watch_->take_pair(bsm, mujoco, agreement_.now());
  }

  void conclude(Member& member) {
    member.engines.push_back(bsm_.conclude());
    member.engines.push_back(mujoco_.conclude());
    const std::array<const MotionRecord*, 2> motions{&bsm_.motion(), &mujoco_.motion()};
    judge_member(model_, inspection_, motions, member);
    const Trajectory& bsm = member.engines[0].trajectory;
    const Trajectory& mujoco = member.engines[1].trajectory;
    if (!bsm.samples.empty() && !mujoco.samples.empty())
      member.comparison = agreement_.result(pairing_.same_times());
    const std::array deviations{bsm_.deviations(), mujoco_.deviations()};
    for (std::size_t i = 0; i < model_.references.size(); ++i)
      for (std::size_t engine = 0; engine < deviations.size(); ++engine)
        if (const EngineRun& run = member.engines[engine]; !run.trajectory.samples.empty())
          member.references.push_back(
              {std::string(reference_name(model_.references[i])), run.name, deviations[engine][i]});
  }

  void show_progress() const {
    const bool both = bsm_.flies() && mujoco_.flies();
    const double done = (bsm_.time() + mujoco_.time()) / model_.simulation.duration;
    if (both)
      options_.show("both", 0.5 * done);
    else
      options_.show(bsm_.flies() ? kBsmKey : kMujocoKey, done);
  }

  const Model& model_;
  const Inspection inspection_;
  const RunOptions& options_;
  MemberWatch* watch_;
  AgreementMeter agreement_{metric_laws(model_)};
  Pairing pairing_{[this](const Observation& a, const Observation& b) { take_pair(a, b); }};
  std::array<Samples, 2> samples_{Samples(watch_, 0), Samples(watch_, 1)};
  EngineFlight bsm_, mujoco_;
};

}  // namespace

void fly_both(const Bundle& bundle, const RunOptions& options, MemberWatch* watch, Member& member) {
  TwinFlight(bundle, options, watch).fly(member);
}

}  // namespace twincraft
