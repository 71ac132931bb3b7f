// See lanes_flight.h.
#include "runtime/simulate/lanes_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "compiler/ir/number.h"
#include "compiler/ir/signals.h"
#include "runtime/integrate/tableau.h"

namespace twincraft {

class LanesFlight::LanesOde final : public Ode {
 public:
  LanesOde(bsm::Kernel& kernel, int size) : kernel_(kernel), size_(size) {}
  int size() const override { return size_; }
  void derivative(double time, std::span<const double> state, std::span<double> rate) override {
    kernel_.derivative(time, state.data(), rate.data());
  }
  void finish_step(std::span<double> state) override { kernel_.finish_step(state.data()); }
  StageAccess access() const override { return {kernel_.lanes() >= 4, kernel_.lanes()}; }

 private:
  bsm::Kernel& kernel_;
  int size_;
};

namespace {

StateLayout layout_of(const Model& model) {
  return {model.engines.attitude, static_cast<int>(model.assembly.links.size()) - 1,
          static_cast<int>(model.assembly.rotors.size())};
}

std::size_t entry(int i) { return static_cast<std::size_t>(i); }

constexpr double kNever = std::numeric_limits<double>::infinity();

Landings landings_of(const Model& model, double end) {
  return {model.simulation.step, end, input_events(model, end)};
}

using Craft = LanesFlight::Craft;

std::vector<Craft> filled(std::span<const Craft> crafts, std::size_t count) {
  std::vector<Craft> all(crafts.begin(), crafts.end());
  all.resize(count, all.back());
  return all;
}

std::vector<InputFeed> feeds_of(const std::vector<Craft>& crafts) {
  std::vector<InputFeed> feeds;
  for (const Craft& craft : crafts) feeds.emplace_back(*craft.model);
  return feeds;
}

std::vector<const bsm::Plan*> plans_of(const std::vector<Craft>& crafts) {
  std::vector<const bsm::Plan*> plans;
  for (const Craft& craft : crafts) plans.push_back(craft.plan);
  return plans;
}

}  // namespace

std::string LanesFlight::refusal(const Model& model) {
  if (model.simulation.translation) return "it is a point mass";
  if (!model.tanks.empty()) return "it has tanks";
  if (tableau_of(model.simulation.method).adaptive) return "its method chooses its steps";
  return {};
}

std::size_t LanesFlight::lanes() {
  return bsm::batch_lanes(bsm::fastest_instruction_set(bsm::Use::kBatch));
}

bool LanesFlight::fit(const Craft& a, const Craft& b) {
  const SimulationPlan &x = a.model->simulation, &y = b.model->simulation;
  return x.method == y.method && x.step == y.step && x.duration == y.duration &&
         x.record == y.record && input_events(*a.model) == input_events(*b.model) &&
         bsm::are_alike(*a.plan, *b.plan);
}

LanesFlight::LanesFlight(std::span<const Craft> crafts, Options options)
    : crafts_(filled(crafts, bsm::batch_lanes(options.instructions))),
      layout_(layout_of(model(0))),
      feeds_(feeds_of(crafts_)),
      held_(crafts_.size(), bsm::HeldInputs::none(model(0).assembly)),
      kernel_(bsm::make_batch_kernel(plans_of(crafts_), options.instructions)),
      ode_(std::make_unique<LanesOde>(*kernel_,
                                      layout_.size() * static_cast<int>(kernel_->lanes()))),
      stepper_(tableau_of(model(0).simulation.method), *ode_),
      landings_(landings_of(model(0), options.has_end ? model(0).simulation.duration : kNever)),
      failures_(crafts_.size()) {
  for (std::size_t lane = 0; lane < crafts_.size(); ++lane) {
    const Eigen::VectorXd start = pack(model(lane).initial, layout_);
    feeds_[lane].begin(0.0);
    set_state(lane, {start.data(), entry(layout_.size())});
  }
  hold();
}

LanesFlight::~LanesFlight() = default;

void LanesFlight::advance() {
  const Landing landing = landings_.next();
  stepper_.step(time_, landing.time - time_);
  time_ = landing.time;
  if (!stepper_.state_is_finite()) find_failures();
  if (!landing.is_event) return;
  for (InputFeed& feed : feeds_) feed.begin(time_);
  hold();
}

void LanesFlight::advance_on_grid() {
  const std::int64_t point = landings_.position().index;
  while (landings_.position().index == point) advance();
}

void LanesFlight::find_failures() {
  std::vector<double> state(entry(layout_.size()));
  for (std::size_t lane = 0; lane < crafts_.size(); ++lane) {
    if (!failures_[lane].empty()) continue;
    read_state(lane, state);
    const auto bad = std::ranges::find_if_not(state, [](double x) { return std::isfinite(x); });
    if (bad == state.end()) continue;
    const auto at = static_cast<std::size_t>(bad - state.begin());
    failures_[lane] =
        fmt::format("`{}` is not finite at t = {} s",
                    component_names(states_of(model(lane), layout_.chart)).at(at), shortest(time_));
    std::ranges::fill(state, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < state.size(); ++i)
      stepper_.state()[i * crafts_.size() + lane] = state[i];
  }
}

void LanesFlight::read_state(std::size_t lane, std::span<double> state) const {
  const Eigen::VectorXd& all = stepper_.solution().value;
  for (std::size_t i = 0; i < state.size(); ++i)
    state[i] = all[static_cast<Eigen::Index>(i * held_.size() + lane)];
}

void LanesFlight::set_state(std::size_t lane, std::span<const double> state) {
  RungeKutta::Solution solution = stepper_.solution();
  for (std::size_t i = 0; i < state.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i * held_.size() + lane);
    solution.value[at] = state[i];
    solution.carry[at] = 0.0;
  }
  stepper_.go_on_from(solution);
  failures_[lane].clear();
}

void LanesFlight::drive(std::size_t lane, std::size_t port, double value) {
  feeds_[lane].drive(port, value, time_);
}

void LanesFlight::release(std::size_t lane, std::size_t port) { feeds_[lane].release(port, time_); }

void LanesFlight::hold() {
  std::vector<const bsm::HeldInputs*> held;
  for (std::size_t lane = 0; lane < held_.size(); ++lane) {
    held_[lane].set(feeds_[lane].inputs(), model(lane).loads);
    held.push_back(&held_[lane]);
  }
  kernel_->hold(held);
}

}  // namespace twincraft
