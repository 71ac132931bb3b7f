#include "compiler/ir/events.h"

namespace twincraft {

std::vector<double> input_events(const Model& model) {
  std::vector<const Schedule*> schedules;
  for (const Link& link : model.assembly.links) schedules.push_back(&link.joint.effort);
  for (const Rotor& rotor : model.assembly.rotors) schedules.push_back(&rotor.torque);
  for (const Load& load : model.loads) {
    for (const Schedule& force : load.force_L) schedules.push_back(&force);
    for (const Schedule& torque : load.torque_L) schedules.push_back(&torque);
  }
  return event_times(schedules, model.simulation.duration);
}

}  // namespace twincraft
