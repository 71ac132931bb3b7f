// See inputs.h. Tested by tests/compiler/ir_test.cpp.
#include "compiler/ir/inputs.h"

#include <algorithm>
#include <limits>

namespace twincraft {
namespace {

int count(const auto& list) { return static_cast<int>(list.size()); }

std::vector<const Schedule*> schedules_of(const Model& model) {
  std::vector<const Schedule*> schedules;
  for (std::size_t i = 1; i < model.assembly.links.size(); ++i)
    schedules.push_back(&model.assembly.links[i].joint.effort);
  for (const Rotor& rotor : model.assembly.rotors) schedules.push_back(&rotor.torque);
  for (const Load& load : model.loads) {
    for (const Schedule& force : load.force_L) schedules.push_back(&force);
    for (const Schedule& torque : load.torque_L) schedules.push_back(&torque);
  }
  for (const Tank& tank : model.tanks) schedules.push_back(&tank.mass_flow);
  for (const Nozzle& nozzle : model.nozzles) schedules.push_back(&nozzle.mass_flow);
  return schedules;
}

}  // namespace

InputLayout::InputLayout(const Model& model)
    : joints(std::max(0, count(model.assembly.links) - 1)),
      wheels(count(model.assembly.rotors)),
      loads(count(model.loads)),
      tanks(count(model.tanks)),
      nozzles(count(model.nozzles)) {}

InputFeed::InputFeed(const Model& model)
    : model_(model),
      schedules_(schedules_of(model)),
      ports_(ports_of(model)),
      terms_(schedules_.size()) {
  for (std::size_t port = 0; port < ports_.size(); ++port)
    for (const Port::Share& share : ports_[port].shares)
      terms_[static_cast<std::size_t>(share.input)].push_back({port, share.part, share.turn});
  now_.inputs.layout = InputLayout(model);
  now_.inputs.u.resize(schedules_.size());
  now_.is_driven.resize(ports_.size());
  now_.driven.resize(ports_.size());
  now_.is_empty.resize(model.tanks.size());
  fill_tanks();
  begin(0.0);
}

const Inputs& InputFeed::begin(double time) {
  Inputs& inputs = now_.inputs;
  if (time < inputs.since) fill_tanks();
  inputs.since = time;
  for (std::size_t i = 0; i < schedules_.size(); ++i) inputs.u[i] = input_at(i, time);
  for (std::size_t k = 0; k < inputs.tanks.size(); ++k) {
    const auto flow = static_cast<std::size_t>(inputs.layout.tank_flow(static_cast<int>(k)));
    const std::vector<Schedule::Entry>& entries = schedules_[flow]->entries;
    for (std::size_t& next = now_.next[k]; next < entries.size() && entries[next].time <= time;
         ++next)
      inputs.tanks[k].change(entries[next].time, input_at(flow, entries[next].time));
  }
  return inputs;
}

const Inputs& InputFeed::drive(std::size_t port, double value, double time) {
  now_.is_driven[port] = true;
  now_.driven[port] = value;
  follow(port, time);
  return now_.inputs;
}

const Inputs& InputFeed::release(std::size_t port, double time) {
  now_.is_driven[port] = false;
  follow(port, time);
  return now_.inputs;
}

double InputFeed::empty_at() const {
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < now_.inputs.tanks.size(); ++k)
    if (!now_.is_empty[k]) first = std::min(first, now_.inputs.tanks[k].empty_at());
  return first;
}

const Inputs& InputFeed::stop_empty(double time) {
  for (std::size_t k = 0; k < now_.inputs.tanks.size(); ++k) {
    Drain& tank = now_.inputs.tanks[k];
    if (tank.empty_at() > time) continue;
    now_.is_empty[k] = true;
    for (std::size_t port = 0; port < ports_.size(); ++port)
      if (ports_[port].tank == static_cast<int>(k)) follow(port, time);
    tank.spent = tank.full;
  }
  return now_.inputs;
}

bool InputFeed::is_changed(std::size_t port) const {
  const int tank = ports_[port].tank;
  return now_.is_driven[port] || (tank >= 0 && now_.is_empty[static_cast<std::size_t>(tank)]);
}

double InputFeed::value_at(std::size_t port, double time) const {
  const int tank = ports_[port].tank;
  if (tank >= 0 && now_.is_empty[static_cast<std::size_t>(tank)]) return 0.0;
  return now_.is_driven[port] ? now_.driven[port] : ports_[port].schedule->at(time);
}

/// The schedule of an input is the sum of its ports' schedules, in this order.
double InputFeed::input_at(std::size_t input, double time) const {
  const std::vector<Term>& terms = terms_[input];
  if (std::ranges::none_of(terms, [this](const Term& term) { return is_changed(term.port); }))
    return schedules_[input]->at(time);
  double sum = 0.0;
  for (const Term& term : terms) sum += value_at(term.port, time) * term.part * term.turn;
  return sum;
}

void InputFeed::follow(std::size_t port, double time) {
  Inputs& inputs = now_.inputs;
  for (const Port::Share& share : ports_[port].shares) {
    const auto input = static_cast<std::size_t>(share.input);
    inputs.u[input] = input_at(input, time);
    const int tank = share.input - inputs.layout.tank_flow(0);
    if (tank < 0 || tank >= inputs.layout.tanks) continue;
    Drain& drain = inputs.tanks[static_cast<std::size_t>(tank)];
    if (drain.flow != inputs.u[input]) drain.change(time, inputs.u[input]);
  }
}

void InputFeed::fill_tanks() {
  now_.inputs.tanks.clear();
  for (const Tank& tank : model_.tanks) now_.inputs.tanks.push_back({.full = tank.content});
  now_.next.assign(model_.tanks.size(), 0);
}

Inputs inputs_at(const Model& model, double time) { return InputFeed(model).begin(time); }

std::vector<double> input_events(const Model& model, double end) {
  return event_times(schedules_of(model), end);
}
std::vector<double> input_events(const Model& model) {
  return input_events(model, model.simulation.duration);
}

}  // namespace twincraft
