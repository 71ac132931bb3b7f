// See flight.h. What is integrated is the engine alone, or the engine and its books.
#include "runtime/simulate/flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <type_traits>

#include "runtime/integrate/engine_ode.h"

namespace twincraft {
namespace {

// The books are quadratures appended behind the state: nothing reads them back. Their rates lie
// there as in BookRates, and where the stepper's loads begin, or these would wait for two stores.
constexpr std::size_t kBooks = 8;
static_assert(sizeof(BookRates) == kBooks * sizeof(double) && std::is_standard_layout_v<BookRates>);

std::size_t books_behind(std::size_t state_size) {
  constexpr std::size_t kLanes = WeightedSum::kLanes;
  return (state_size + kLanes - 1) / kLanes * kLanes;
}

bool is_adaptive(const Model& model) { return tableau_of(model.simulation.method).adaptive; }

/// A name for every entry of the state and the books behind it.
std::vector<std::string> entry_names(const Model& model, AttitudeChart chart) {
  std::vector<std::string> names = component_names(states_of(model, chart));
  names.resize(books_behind(names.size()));
  const std::vector<Signal> books{{"work", "", "J", ""},
                                  {"impulse_N", "xyz", "N s", ""},
                                  {"angular_impulse_N", "xyz", "N m s", ""},
                                  {"own_work", "", "J", ""}};
  std::ranges::copy(component_names(books), std::back_inserter(names));
  return names;
}

/// Inputs change there, or a stored state waits: a run has to meet what it is held against.
std::vector<double> events_of(const Model& model, bool has_end) {
  if (!has_end) return input_events(model, std::numeric_limits<double>::infinity());
  std::vector<double> times = input_events(model);
  for (const StoredState& state : model.stored.states)
    if (state.time > 0.0 && state.time < model.simulation.duration) times.push_back(state.time);
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// A link whose mass is all of this tank's: slosh that drains with it. -1: there is none.
int link_of(const Model& model, int tank) {
  for (std::size_t i = 1; i < model.assembly.links.size(); ++i) {
    const std::vector<MassElement>& elements = model.assembly.links[i].elements;
    const auto is_of_tank = [tank](const MassElement& e) { return e.tank == tank; };
    const auto weighs = [](const MassElement& e) { return e.mass > 0.0; };
    if (std::ranges::any_of(elements, is_of_tank) &&
        std::ranges::none_of(elements,
                             [&](const MassElement& e) { return weighs(e) && !is_of_tank(e); }))
      return static_cast<int>(i);
  }
  return -1;
}

/// Of a tank that must not run empty: what would have no mass left.
std::vector<std::string> emptied_slosh(const Model& model) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < model.tanks.size(); ++k) {
    const int link = link_of(model, static_cast<int>(k));
    names.push_back(link < 0 ? "" : joint_name(model, static_cast<std::size_t>(link) - 1));
  }
  return names;
}

}  // namespace

class Flight::BookkeepingOde final : public Ode {
 public:
  explicit BookkeepingOde(Engine& engine)
      : engine_(engine), size_(static_cast<std::size_t>(engine.layout().size())) {}
  int size() const override { return static_cast<int>(books_behind(size_) + kBooks); }
  int read_size() const override { return static_cast<int>(size_); }
  void derivative(double time, std::span<const double> state, std::span<double> rate) override {
    // Where they belong: a copy would be read while it is on its way to memory.
    auto* books = reinterpret_cast<BookRates*>(rate.last(kBooks).data());
    engine_.derivative_to_book(time, state.first(size_), rate.first(size_), *books);
  }
  void finish_rates() override { engine_.settle_books(); }
  void finish_step(std::span<double> state) override { engine_.finish_step(state.first(size_)); }
  StageAccess access() const override { return {engine_.may_use_avx2()}; }

 private:
  Engine& engine_;
  std::size_t size_;
};

/// The trial step of an adaptive method may be far too long and end in a state that no engine can
/// evaluate: that is no failure, but a step to be rejected, as for any other non-finite rate.
class Flight::ExcusingOde final : public Ode {
 public:
  explicit ExcusingOde(Ode& ode) : ode_(ode) {}
  int size() const override { return ode_.size(); }
  int read_size() const override { return ode_.read_size(); }
  void derivative(double time, std::span<const double> state, std::span<double> rate) override {
    try {
      ode_.derivative(time, state, rate);
    } catch (const NumericalFailure& failure) {
      // Of what is read, so that nothing behind it stays so.
      std::ranges::fill(rate.first(static_cast<std::size_t>(ode_.read_size())),
                        std::numeric_limits<double>::quiet_NaN());
      excuse_ = failure.what();
    }
  }
  void finish_rates() override { ode_.finish_rates(); }
  void finish_step(std::span<double> state) override { ode_.finish_step(state); }
  StageAccess access() const override { return ode_.access(); }

  /// The engine's own words, for when no step is short enough; empty before it failed.
  const std::string& excuse() const { return excuse_; }
  void forgive() { excuse_.clear(); }

 private:
  Ode& ode_;
  std::string excuse_;
};

Flight::Flight(Engine& engine, const Model& model, FlightOptions options)
    : engine_(engine),
      size_(engine.layout().size()),
      ode_(options.keeps_books ? std::unique_ptr<Ode>(std::make_unique<BookkeepingOde>(engine))
                               : std::make_unique<EngineOde>(engine)),
      excusing_(is_adaptive(model) ? std::make_unique<ExcusingOde>(*ode_) : nullptr),
      stepper_(tableau_of(model.simulation.method), excusing_ ? *excusing_ : *ode_),
      names_(entry_names(model, engine.layout().chart)),
      control_(engine.layout(), model.simulation.tolerance, names_),
      landings_(
          model.simulation.step,
          options.has_end ? model.simulation.duration : std::numeric_limits<double>::infinity(),
          events_of(model, options.has_end)),
      feed_(model),
      emptied_slosh_(emptied_slosh(model)) {
  for (const Tank& tank : model.tanks) tank_names_.push_back(tank.name);
  hold(feed_.begin(0.0));
  std::ranges::copy(engine.initial_state(), stepper_.state().begin());
  if (options.steps_back) last_good_ = stepper_.solution();
  is_careful_ = last_good_ || excusing_;
}

Flight::~Flight() = default;

Books Flight::books() const {
  if (stepper_.size() == size_) return {};
  const double* books = state().data() + books_behind(static_cast<std::size_t>(size_));
  return {books[0], Vector3d::Map(books + 1), Vector3d::Map(books + 4), books[7]};
}

void Flight::advance(const std::atomic<bool>* stop) {
  Landings::Position after = landings_.position();
  const Landing landing = landings_.follow(after);
  if (empty_at_ < landing.time) return fly_until_empty(stop);
  step_to(landing.time, stop);
  landings_.go_on_from(after);
  if (landing.is_event) hold(feed_.begin(landing.time));
}

void Flight::advance_on_grid() {
  const std::int64_t index = landings_.position().index;
  while (!done() && landings_.position().index == index) advance();
}

void Flight::pass_on_grid() {
  const std::int64_t index = landings_.position().index;
  while (!done() && landings_.position().index == index) {
    Landings::Position after = landings_.position();
    const Landing landing = landings_.follow(after);
    if (empty_at_ < landing.time) {
      time_ = std::max(time_, empty_at_);
      hold(feed_.stop_empty(empty_at_));
      continue;
    }
    time_ = landing.time;
    landings_.go_on_from(after);
    if (landing.is_event) hold(feed_.begin(landing.time));
  }
}

void Flight::advance_to(double time) {
  while (!done() && next_landing() < time - tolerance()) advance();
  if (done() || time <= time_ + tolerance()) return;
  while (empty_at_ < time) fly_until_empty(nullptr);
  Landings::Position after = landings_.position();
  const Landing landing = landings_.follow(after);
  step_to(time, nullptr);
  if (landing.time > time + tolerance()) return;
  landings_.go_on_from(after);
  if (landing.is_event) hold(feed_.begin(landing.time));
}

void Flight::fly_until_empty(const std::atomic<bool>* stop) {
  const std::vector<Drain>& tanks = inputs().tanks;
  for (std::size_t k = 0; k < tanks.size(); ++k)
    if (tanks[k].empty_at() <= empty_at_ && !emptied_slosh_[k].empty())
      throw NumericalFailure(
          fmt::format("tank `{}` runs empty at t = {:.6g} s, where its slosh `{}` has no mass left",
                      tank_names_[k], empty_at_, emptied_slosh_[k]),
          emptied_slosh_[k]);
  if (empty_at_ > time_) step_to(empty_at_, stop);
  if (time_ >= empty_at_) hold(feed_.stop_empty(empty_at_));
}

void Flight::hold(const Inputs& inputs) {
  engine_.hold(inputs);
  empty_at_ = feed_.empty_at();
}

void Flight::step_to(double time, const std::atomic<bool>* stop) {
  if (is_careful_) return step_carefully(time, stop);
  step_once(time);
}

void Flight::step_carefully(double time, const std::atomic<bool>* stop) {
  if (last_good_) *last_good_ = stepper_.solution();
  try {
    excusing_ ? step_adaptively(time, stop) : step_once(time);
  } catch (const NumericalFailure&) {
    if (last_good_) stepper_.go_on_from(*last_good_);
    throw;
  }
}

void Flight::step_once(double time) {
  stepper_.step(time_, time - time_);
  counts_.evaluations += stepper_.tableau().stages;
  ++counts_.accepted;
  if (!stepper_.state_is_finite()) fail();
  time_ = time;
}

void Flight::step_adaptively(double to, const std::atomic<bool>* stop) {
  excusing_->forgive();
  try {
    time_ = control_.advance(stepper_, time_, to, counts_, stop, &accepted_);
  } catch (const NumericalFailure& failure) {
    if (excusing_->excuse().empty()) throw;
    throw NumericalFailure(excusing_->excuse() + ", however short the step", failure.coordinate);
  }
}

void Flight::fail() const {
  const auto entry = static_cast<std::size_t>(stepper_.first_non_finite());
  throw NumericalFailure(fmt::format("`{}` is not finite", names_[entry]), names_[entry]);
}

void Flight::drive(std::size_t port, double value) { hold(feed_.drive(port, value, time_)); }

void Flight::release(std::size_t port) { hold(feed_.release(port, time_)); }

Flight::Snapshot Flight::snapshot() const {
  return {time_, stepper_.solution(), landings_.position(), feed_.position(), counts_, accepted_};
}

void Flight::restore(const Snapshot& snapshot) {
  time_ = snapshot.time;
  stepper_.go_on_from(snapshot.solution);
  landings_.go_on_from(snapshot.landing);
  feed_.go_on_from(snapshot.inputs);
  counts_ = snapshot.counts;
  accepted_ = snapshot.accepted;
  hold(feed_.inputs());
}

}  // namespace twincraft
