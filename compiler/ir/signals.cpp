#include "compiler/ir/signals.h"

#include <utility>

namespace twincraft {
namespace {

using Of = OutputSignal::Of;

constexpr std::string_view kAxes = "xyz";

OutputSignal hub_position() {
  return {{"r_BN_N", kAxes, "m", "hub origin, inertial axes"}, Of::kHubPosition};
}
OutputSignal hub_velocity() {
  return {{"v_BN_N", kAxes, "m/s", "velocity of the hub origin, inertial axes"}, Of::kHubVelocity};
}
OutputSignal attitude() {
  return {{"q_BN", "wxyz", "1", "quaternion, scalar first, takes hub components to inertial ones"},
          Of::kAttitude};
}
OutputSignal hub_rate() {
  return {{"omega_BN_B", kAxes, "rad/s", "hub rate relative to inertial axes, hub axes"},
          Of::kHubRate};
}

OutputSignal position_of(const Coordinate& coordinate) {
  const CoordinateQuantity& quantity = coordinate.quantity();
  return {{coordinate.name + ".position", "", std::string(quantity.unit),
           std::string(quantity.position)},
          Of::kCoordinate,
          coordinate};
}
OutputSignal rate_of(const Coordinate& coordinate) {
  const CoordinateQuantity& quantity = coordinate.quantity();
  return {
      {coordinate.name + ".rate", "", std::string(quantity.rate_unit), std::string(quantity.rate)},
      Of::kCoordinateRate,
      coordinate};
}

/// A model that is made by hand may leave some without a name.
Coordinate found(const Model& model, bool is_wheel, int index) {
  for (const Coordinate& coordinate : model.coordinates)
    if (coordinate.is_wheel() == is_wheel && coordinate.index == index) return coordinate;
  const std::string number = std::to_string(index);
  if (is_wheel) return {"wheel " + number, Coordinate::Kind::kWheel, index};
  return {"joint " + number, Coordinate::Kind::kBodyAngle, index};
}

/// In the order of the assembly, which need not be that of the spec.
std::vector<Coordinate> joints_of(const Model& model) {
  std::vector<Coordinate> joints;
  for (int link = 1; link < static_cast<int>(model.assembly.links.size()); ++link)
    joints.push_back(found(model, false, link));
  return joints;
}

std::vector<Coordinate> wheels_of(const Model& model) {
  std::vector<Coordinate> wheels;
  for (int rotor = 0; rotor < static_cast<int>(model.assembly.rotors.size()); ++rotor)
    wheels.push_back(found(model, true, rotor));
  return wheels;
}

/// Nothing for a coordinate that no schedule acts on.
std::optional<Signal> effort_on(const Coordinate& coordinate) {
  switch (coordinate.kind) {
    case Coordinate::Kind::kWheel:
      return Signal{coordinate.name + ".torque", "", "N m", "motor torque on the wheel"};
    case Coordinate::Kind::kBodyAngle:
      return Signal{coordinate.name + ".torque", "", "N m", "torque of the joint"};
    case Coordinate::Kind::kBodyDisplacement:
      return Signal{coordinate.name + ".force", "", "N", "force of the joint"};
    default:
      return std::nullopt;
  }
}

void add_inputs(const Load& load, std::vector<Signal>& inputs) {
  if (load.is_thruster) {
    inputs.push_back({load.name + ".thrust", "", "N", "thrust"});
    return;
  }
  inputs.push_back({load.name + ".force", kAxes, "N", "force, axes of the mount"});
  inputs.push_back({load.name + ".torque", kAxes, "N m", "torque, axes of the mount"});
}

}  // namespace

std::string Signal::component(std::size_t i) const {
  return axes.empty() ? name : name + '.' + axes[i];
}

std::vector<OutputSignal> outputs_of(const Model& model) {
  std::vector<OutputSignal> outputs{
      hub_position(),
      hub_velocity(),
      attitude(),
      hub_rate(),
      {{"r_CN_N", kAxes, "m", "system centre of mass, inertial axes"}, Of::kComPosition},
      {{"v_CN_N", kAxes, "m/s", "velocity of the system centre of mass, inertial axes"},
       Of::kComVelocity}};
  for (const Coordinate& coordinate : model.coordinates) {
    if (!coordinate.is_wheel()) outputs.push_back(position_of(coordinate));
    outputs.push_back(rate_of(coordinate));
  }
  outputs.push_back({{"mass", "", "kg", "mass of the vehicle"}, Of::kMass});
  return outputs;
}

std::vector<Signal> states_of(const Model& model, AttitudeChart chart) {
  std::vector<Signal> states{hub_position(), hub_velocity()};
  if (model.simulation.translation) return states;
  if (chart == AttitudeChart::kMrp)
    states.push_back({"sigma_BN", "123", "1", "modified Rodrigues parameters of the attitude"});
  else
    states.push_back(attitude());
  states.push_back(hub_rate());
  const std::vector<Coordinate> joints = joints_of(model);
  for (const Coordinate& joint : joints) states.push_back(position_of(joint));
  for (const Coordinate& joint : joints) states.push_back(rate_of(joint));
  for (const Coordinate& wheel : wheels_of(model)) states.push_back(rate_of(wheel));
  return states;
}

std::vector<Signal> inputs_of(const Model& model) {
  std::vector<Signal> inputs;
  for (const Coordinate& coordinate : model.coordinates)
    if (std::optional<Signal> effort = effort_on(coordinate)) inputs.push_back(std::move(*effort));
  for (const Load& load : model.loads) add_inputs(load, inputs);
  return inputs;
}

std::vector<std::string> component_names(const std::vector<Signal>& signals) {
  std::vector<std::string> names;
  for (const Signal& signal : signals)
    for (std::size_t i = 0; i < signal.size(); ++i) names.push_back(signal.component(i));
  return names;
}

std::string joint_name(const Model& model, std::size_t joint) {
  return found(model, false, static_cast<int>(joint) + 1).name;
}

std::string wheel_name(const Model& model, std::size_t wheel) {
  return found(model, true, static_cast<int>(wheel)).name;
}

}  // namespace twincraft
