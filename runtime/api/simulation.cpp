// See simulation.h.
#include "runtime/api/simulation.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "compiler/ir/number.h"
#include "runtime/api/faults.h"
#include "runtime/api/snapshot.h"
#include "runtime/simulate/engines.h"

namespace twincraft::api {
namespace {

// Steps between two questions of a poll: rarely enough to cost nothing, often enough for a key.
constexpr std::size_t kStepsPerPoll = 256;

std::unique_ptr<Engine> engine_of(const CompiledModel& model, EngineKind kind) {
  if (const std::string refusal = refusal_of(kind, model.model()); !refusal.empty())
    refuse(fmt::format("{} cannot fly `{}`: {}", name_of(kind).label, model.model().name, refusal));
  return make_engine(kind, model.bundle());
}

}  // namespace

void ask(const Poll& poll) {
  if (poll && poll()) throw Fault(TC_INTERRUPTED, "interrupted");
}

void check_target(double time, double now, double tolerance) {
  if (!std::isfinite(time)) refuse("a time must be finite");
  if (time < now - tolerance)
    refuse(fmt::format("t = {} s is over: it is {} s", shortest(time), shortest(now)));
}

Simulation::Simulation(std::shared_ptr<const CompiledModel> model, EngineKind engine)
    : Simulation(model, engine, engine_of(*model, engine)) {}

Simulation::Simulation(std::shared_ptr<const CompiledModel> model, EngineKind kind,
                       std::unique_ptr<Engine> engine)
    : model_(std::move(model)),
      kind_(kind),
      engine_(std::move(engine)),
      flight_(std::make_unique<Flight>(*engine_, model_->model(),
                                       FlightOptions{.has_end = false, .steps_back = true})),
      start_(flight_->snapshot()) {}

std::unique_ptr<Simulation> Simulation::copy() const {
  std::unique_ptr<Simulation> other(new Simulation(model_, kind_, engine_->another()));
  other->go_on_from(flight_->snapshot());
  return other;
}

const Observation& Simulation::observe() {
  if (!has_seen_) engine_->observe(flight_->time(), flight_->state(), seen_);
  has_seen_ = true;
  return seen_;
}

void Simulation::read_inputs(std::span<double> numbers) const {
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = flight_->input(i);
}

void Simulation::set_state(std::span<const double> numbers) {
  const VehicleState state = state_from(*model_, numbers);
  const Eigen::VectorXd packed = pack(state, engine_->layout());
  flight_->restart({packed.data(), static_cast<std::size_t>(packed.size())});
  has_seen_ = false;
}

void Simulation::drive(std::size_t first, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      refuse(fmt::format("{} for `{}` is not finite", values[i], model_->inputs().name(first + i)));
  for (std::size_t i = 0; i < values.size(); ++i) flight_->drive(first + i, values[i]);
}

void Simulation::release(std::size_t input) { flight_->release(input); }

void Simulation::step(std::size_t count, const Poll& poll) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kStepsPerPoll == kStepsPerPoll - 1) ask(poll);
    has_seen_ = false;
    flight_->advance_on_grid();
  }
}

void Simulation::pass() {
  has_seen_ = false;
  flight_->pass_on_grid();
}

void Simulation::advance_to(double time, const Poll& poll) {
  check_target(time, flight_->time(), flight_->tolerance());
  for (std::size_t i = 0; flight_->time() < time - flight_->tolerance(); ++i) {
    if (i % kStepsPerPoll == kStepsPerPoll - 1) ask(poll);
    has_seen_ = false;
    const double next = flight_->next_landing();
    flight_->advance_to(next < time - flight_->tolerance() ? next : time);
  }
}

std::string Simulation::snapshot() const { return seal(flight_->snapshot(), *model_, kind_); }

void Simulation::restore(std::string_view bytes) {
  go_on_from(unseal(bytes, *model_, kind_, start_));
}

void Simulation::reset() { go_on_from(start_); }

void Simulation::go_on_from(const Flight::Snapshot& snapshot) {
  flight_->restore(snapshot);
  has_seen_ = false;
}

}  // namespace twincraft::api
