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

InputFeed::InputFeed(const Model& model)
    : model_(model), schedules_(schedules_of(model)) {
  inputs_.layout = InputLayout(model);
  inputs_.u.resize(schedules_.size());
  fill_tanks();
  begin(0.0);
}

const Inputs& InputFeed::begin(double time) {
  if (time < inputs_.since) fill_tanks();
  inputs_.since = time;
  for (std::size_t i = 0; i < schedules_.size(); ++i) inputs_.u[i] = schedules_[i]->at(time);
  for (std::size_t k = 0; k < next_.size(); ++k) {
    const std::vector<Schedule::Entry>& entries = model_.tanks[k].mass_flow.entries;
    for (std::size_t& next = next_[k]; next < entries.size() && entries[next].time <= time; ++next)
      inputs_.tanks[k].change(entries[next].time, entries[next].value);
  }
  return inputs_;
}

void InputFeed::fill_tanks() {
  inputs_.tanks.clear();
  for (const Tank& tank : model_.tanks) inputs_.tanks.push_back({.full = tank.content});
  next_.assign(model_.tanks.size(), 0);
}

Inputs inputs_at(const Model& model, double time) { return InputFeed(model).begin(time); }

std::vector<double> input_events(const Model& model) {
  return event_times(schedules_of(model), model.simulation.duration);
}

}  // namespace twincraft
