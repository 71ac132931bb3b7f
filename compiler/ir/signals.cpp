#include "compiler/ir/signals.h"

#include <utility>

#include "compiler/ir/inputs.h"

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

/// Collects what may be driven, and where each number of it ends up.
class InputSignals {
 public:
  explicit InputSignals(const Model& model) : model_(model), at_(model) {}

  std::vector<InputSignal> all() && {
    for (const Coordinate& coordinate : model_.coordinates) add(coordinate);
    for (std::size_t i = 0; i < model_.loads.size(); ++i) add(model_.loads[i], static_cast<int>(i));
    return std::move(signals_);
  }

 private:
  /// Nothing for a coordinate that no schedule acts on.
  void add(const Coordinate& coordinate) {
    const int entry = static_cast<int>(coordinate.entry());
    if (coordinate.is_wheel())
      return add_one(
          {coordinate.name + ".torque", "", "N m", "motor torque on the wheel"},
          {&model_.assembly.rotors[coordinate.entry()].torque, {{at_.motor_torque(entry)}}});
    const Port effort{&model_.assembly.links[coordinate.entry() + 1].joint.effort,
                      {{at_.effort(entry)}}};
    if (coordinate.kind == Coordinate::Kind::kBodyAngle)
      add_one({coordinate.name + ".torque", "", "N m", "torque of the joint"}, effort);
    if (coordinate.kind == Coordinate::Kind::kBodyDisplacement)
      add_one({coordinate.name + ".force", "", "N", "force of the joint"}, effort);
  }

  void add(const Load& load, int index) {
    if (load.thruster) return add_thrust(load, *load.thruster, at_.force(index));
    signals_.push_back({{load.name + ".force", kAxes, "N", "force, axes of the mount"},
                        ports(load.force_M, load.dcm_LM, at_.force(index))});
    signals_.push_back({{load.name + ".torque", kAxes, "N m", "torque, axes of the mount"},
                        ports(load.torque_M, load.dcm_LM, at_.torque(index))});
  }

  void add_thrust(const Load& load, const Thruster& thruster, int force) {
    Port port{&thruster.thrust, {}, thruster.tank};
    for (int axis = 0; axis < 3; ++axis)
      if (thruster.direction_M[axis] != 0.0)
        push_along(axis, thruster.direction_M[axis], load.dcm_LM, force, port);
    if (thruster.tank >= 0)
      port.shares.push_back({at_.tank_flow(thruster.tank), thruster.flow_per_thrust});
    if (thruster.nozzle >= 0)
      port.shares.push_back({at_.nozzle_flow(thruster.nozzle), thruster.flow_per_thrust});
    add_one({load.name + ".thrust", "", "N", "thrust"}, std::move(port));
  }

  static std::vector<Port> ports(const std::array<Schedule, 3>& vector, const Matrix3d& dcm_LM,
                                 int first) {
    std::vector<Port> ports;
    for (int axis = 0; axis < 3; ++axis) {
      Port& port = ports.emplace_back(Port{&vector.at(static_cast<std::size_t>(axis)), {}});
      push_along(axis, 1.0, dcm_LM, first, port);
    }
    return ports;
  }

  /// @param axis  of the mount  @param first  input of the link's x axis
  static void push_along(int axis, double part, const Matrix3d& dcm_LM, int first, Port& port) {
    for (int i = 0; i < 3; ++i)
      if (dcm_LM(i, axis) != 0.0) port.shares.push_back({first + i, part, dcm_LM(i, axis)});
  }

  void add_one(Signal signal, Port port) {
    signals_.push_back({std::move(signal), {std::move(port)}});
  }

  const Model& model_;
  InputLayout at_;
  std::vector<InputSignal> signals_;
};

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

std::vector<OutputSignal> motion_of(const Model& model) {
  if (model.simulation.translation) return {hub_position(), hub_velocity()};
  std::vector<OutputSignal> motion{hub_position(), attitude()};
  const auto add = [&](bool wheels, const auto& signal_of) {
    for (const Coordinate& coordinate : model.coordinates)
      if (coordinate.is_wheel() == wheels) motion.push_back(signal_of(coordinate));
  };
  add(false, position_of);
  motion.push_back(hub_velocity());
  motion.push_back(hub_rate());
  add(false, rate_of);
  add(true, rate_of);
  return motion;
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

std::vector<InputSignal> inputs_of(const Model& model) { return InputSignals(model).all(); }

std::vector<Port> ports_of(const Model& model) {
  std::vector<Port> ports;
  for (InputSignal& input : inputs_of(model))
    for (Port& port : input.ports) ports.push_back(std::move(port));
  return ports;
}

std::string joint_name(const Model& model, std::size_t joint) {
  return found(model, false, static_cast<int>(joint) + 1).name;
}

std::string wheel_name(const Model& model, std::size_t wheel) {
  return found(model, true, static_cast<int>(wheel)).name;
}

}  // namespace twincraft
