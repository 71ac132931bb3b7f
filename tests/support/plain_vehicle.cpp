#include "tests/support/plain_vehicle.h"

namespace twincraft::test {
namespace {

std::vector<std::vector<MassElement>> elements_of(const Assembly& assembly) {
  std::vector<std::vector<MassElement>> elements;
  for (const Link& link : assembly.links) elements.push_back(link.elements);
  return elements;
}

}  // namespace

PlainVehicle::PlainVehicle(const Model& model)
    : layout_{model.engines.attitude, static_cast<int>(model.assembly.links.size()) - 1,
              static_cast<int>(model.assembly.rotors.size())},
      tree_(bsm::prepare(model.assembly)),
      propellant_(model.tanks),
      elements_(elements_of(model.assembly), [](const MassElement&) { return true; }),
      forces_(model, model.gravity.bsm, elements_of(model.assembly), FieldFrame::kFalling),
      motion_(bsm::at_rest(tree_)) {}

void PlainVehicle::hold(const Inputs& inputs) {
  propellant_.hold(inputs);
  forces_.hold(inputs);
}

void PlainVehicle::move_to(double time, const VehicleState& state) {
  const std::span<const double> shares = propellant_.shares(time);
  bsm::set_shares(tree_, shares);
  elements_.set_shares(shares);
  forces_.set_shares(shares);
  bsm::move_links(tree_, state.joint_position, state.joint_rate, state.omega_BN_B, motion_);
}

}  // namespace twincraft::test
