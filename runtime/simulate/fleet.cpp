// See fleet.h.
#include "runtime/simulate/fleet.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "runtime/simulate/engines.h"
#include "runtime/simulate/flight.h"
#include "runtime/simulate/lanes_flight.h"
#include "runtime/simulate/samples.h"
#include "runtime/simulate/waiting_samples.h"

namespace twincraft {
namespace {

bool is_stopped(const FleetOptions& options) { return options.stop != nullptr && *options.stop; }

/// A member and what looks at it. It learns a few samples late that it need not fly on.
class Watched {
 public:
  Watched(const FleetMember& member, bsm::InstructionSet instructions)
      : member_(member),
        engine_(make_engine(EngineKind::kBsm, *member.bundle, instructions)),
        waiting_(*engine_) {}

  const Model& model() const { return member_.bundle->model; }
  Engine& engine() { return *engine_; }
  bool flies() const { return flies_; }
  FleetEnd end() const {
    return {waiting_.last().seen, failure_, is_interrupted_, waiting_.last().beside};
  }

  void sample(double time, std::span<const double> state, const AcceptedErrors& accepted = {}) {
    refuse_absurd(state, engine_->layout(), model());
    waiting_.add(time, state, accepted);
    if (waiting_.is_full()) deliver();
  }
  void fail(std::string what) {
    deliver();
    if (flies_) failure_ = std::move(what);
    flies_ = false;
  }
  /// @param is_whole  it came to the end of its plan
  void finish(bool is_whole) {
    deliver();
    if (flies_) is_interrupted_ = !is_whole;
    flies_ = false;
  }

 private:
  void deliver() {
    waiting_.deliver([this](const Observation& seen, const AcceptedErrors&) {
      flies_ = member_.take(seen);
      return flies_;
    });
  }

  const FleetMember& member_;
  std::unique_ptr<Engine> engine_;
  WaitingSamples<AcceptedErrors> waiting_;
  std::string failure_;
  bool is_interrupted_ = false, flies_ = true;
};

/// A member that the lanes do not serve: its steps or its masses are its own.
void fly_alone(Watched& one, const FleetOptions& options) {
  try {
    Flight flight(one.engine(), one.model());
    SampleTimes due(one.model(), flight.tolerance());
    const auto sample = [&] {
      one.sample(flight.time(), flight.state(), flight.accepted());
      due.taken(flight.time());
    };
    sample();
    while (one.flies() && !flight.done() && !is_stopped(options)) {
      flight.advance(options.stop);
      if (due.at(flight.time()) || flight.done()) sample();
    }
    one.finish(flight.done());
  } catch (const NumericalFailure& failure) {
    one.fail(failure.what());
  }
}

/// Members in lanes, and the plans that they are flown by.
class Formation {
 public:
  bool takes(const Model& model, const bsm::Plan& plan, std::size_t lanes) const {
    return crafts_.empty() ||
           (crafts_.size() < lanes && LanesFlight::fit(crafts_.front(), {&model, &plan}));
  }
  void add(Watched& one, std::unique_ptr<const bsm::Plan> plan) {
    crafts_.push_back({&one.model(), plan.get()});
    plans_.push_back(std::move(plan));
    members_.push_back(&one);
  }

  void fly(const FleetOptions& options) {
    LanesFlight flight(crafts_, {.has_end = true, .instructions = options.instructions});
    SampleTimes due(members_.front()->model(), flight.tolerance());
    sample(flight);
    due.taken(flight.time());
    while (any_flies() && !flight.done() && !is_stopped(options)) {
      flight.advance();
      if (!due.at(flight.time()) && !flight.done()) continue;
      sample(flight);
      due.taken(flight.time());
    }
    for (Watched* one : members_) one->finish(flight.done());
  }

 private:
  bool any_flies() const {
    return std::ranges::any_of(members_, [](const Watched* one) { return one->flies(); });
  }

  void sample(const LanesFlight& flight) {
    for (std::size_t lane = 0; lane < members_.size(); ++lane)
      if (members_[lane]->flies()) sample(flight, lane);
  }
  void sample(const LanesFlight& flight, std::size_t lane) {
    Watched& one = *members_[lane];
    if (!flight.failure(lane).empty()) return one.fail(flight.failure(lane));
    state_.resize(static_cast<std::size_t>(one.engine().layout().size()));
    flight.read_state(lane, state_);
    try {
      one.sample(flight.time(), state_);
    } catch (const NumericalFailure& failure) {
      one.fail(failure.what());
    }
  }

  std::vector<LanesFlight::Craft> crafts_;
  std::vector<std::unique_ptr<const bsm::Plan>> plans_;
  std::vector<Watched*> members_;
  std::vector<double> state_;
};

std::unique_ptr<const bsm::Plan> plan_of(const Model& model) {
  return std::make_unique<const bsm::Plan>(bsm::make_plan(model.assembly, model.engines.attitude,
                                                          model.gravity, model.loads,
                                                          model.engines.chains, model.forces));
}

/// Each to the first formation that takes it. @return those that have to be flown alone
std::vector<Watched*> form(std::vector<Watched>& members, std::size_t lanes,
                           std::vector<Formation>& formations) {
  std::vector<Watched*> alone;
  for (Watched& one : members) {
    if (!LanesFlight::refusal(one.model()).empty()) {
      alone.push_back(&one);
      continue;
    }
    std::unique_ptr<const bsm::Plan> plan = plan_of(one.model());
    auto formation = std::ranges::find_if(
        formations, [&](const Formation& f) { return f.takes(one.model(), *plan, lanes); });
    if (formation == formations.end()) formation = formations.emplace(formations.end());
    formation->add(one, std::move(plan));
  }
  return alone;
}

}  // namespace

std::vector<FleetEnd> fly_fleet(std::span<const FleetMember> members, const FleetOptions& options) {
  std::vector<Watched> watched;
  watched.reserve(members.size());
  for (const FleetMember& member : members) watched.emplace_back(member, options.instructions);
  std::vector<Formation> formations;
  const std::vector<Watched*> alone =
      form(watched, bsm::batch_lanes(options.instructions), formations);
  for (Formation& formation : formations) formation.fly(options);
  for (Watched* one : alone) fly_alone(*one, options);
  std::vector<FleetEnd> ends;
  for (const Watched& one : watched) ends.push_back(one.end());
  return ends;
}

}  // namespace twincraft
