// See inputs.h. Tested by tests/compiler/ir_test.cpp.
#include "compiler/ir/inputs.h"

#include <algorithm>

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

InputFeed::InputFeed(const Model& model) : model_(model), schedules_(schedules_of(model)) {
  now_.inputs.layout = InputLayout(model);
  now_.inputs.u.resize(schedules_.size());
  now_.is_driven.resize(schedules_.size());
  fill_tanks();
  begin(0.0);
}

const Inputs& InputFeed::begin(double time) {
  Inputs& inputs = now_.inputs;
  if (time < inputs.since) fill_tanks();
  inputs.since = time;
  for (std::size_t i = 0; i < schedules_.size(); ++i)
    if (!now_.is_driven[i]) inputs.u[i] = schedules_[i]->at(time);
  for (std::size_t k = 0; k < inputs.tanks.size(); ++k) {
    const auto flow = static_cast<std::size_t>(inputs.layout.tank_flow(static_cast<int>(k)));
    const std::vector<Schedule::Entry>& entries = schedules_[flow]->entries;
    for (std::size_t& next = now_.next[k]; next < entries.size() && entries[next].time <= time;
         ++next)
      if (!now_.is_driven[flow]) inputs.tanks[k].change(entries[next].time, entries[next].value);
  }
  return inputs;
}

const Inputs& InputFeed::drive(int input, double value, double time) {
  now_.is_driven[static_cast<std::size_t>(input)] = true;
  set(input, value, time);
  return now_.inputs;
}

const Inputs& InputFeed::release(int input, double time) {
  const auto i = static_cast<std::size_t>(input);
  now_.is_driven[i] = false;
  set(input, schedules_[i]->at(time), time);
  return now_.inputs;
}

void InputFeed::set(int input, double value, double time) {
  Inputs& inputs = now_.inputs;
  inputs.u[static_cast<std::size_t>(input)] = value;
  const int tank = input - inputs.layout.tank_flow(0);
  if (tank < 0 || tank >= inputs.layout.tanks) return;
  Drain& drain = inputs.tanks[static_cast<std::size_t>(tank)];
  if (drain.flow != value) drain.change(time, value);
}

void InputFeed::fill_tanks() {
  now_.inputs.tanks.clear();
  for (const Tank& tank : model_.tanks) now_.inputs.tanks.push_back({.full = tank.content});
  now_.next.assign(model_.tanks.size(), 0);
}

Inputs inputs_at(const Model& model, double time) { return InputFeed(model).begin(time); }

std::vector<double> input_events(const Model& model) {
  return event_times(schedules_of(model), model.simulation.duration);
}

}  // namespace twincraft
