// What a run shows, keeps and takes: every output, state and input by name, unit and meaning. CSV,
// netCDF, report.json, the page and messages take them from here. Where an output is in a sample is
// in runtime/engine/observation; where an input is in Inputs::u, in inputs.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/ir/model.h"

namespace twincraft {

/// A number or a vector of numbers.
struct Signal {
  std::string name;       // `omega_BN_B`, `wing_p.1.position`
  std::string_view axes;  // of a vector: a letter per component; empty: one number
  std::string unit;       // SI: `rad/s`; `1` where there is none
  std::string meaning;

  std::size_t size() const { return axes.empty() ? 1 : axes.size(); }
  /// Name of one number: `omega_BN_B.x`, `wing_p.1.position`.
  std::string component(std::size_t i) const;
};

/// A signal that a sample shows.
struct OutputSignal : Signal {
  enum class Of {
    kHubPosition,
    kHubVelocity,
    kAttitude,
    kHubRate,
    kComPosition,
    kComVelocity,
    kCoordinate,
    kCoordinateRate,
    kMass
  };
  Of of = Of::kMass;
  std::optional<Coordinate> coordinate = {};  // whose it is; none: the hub's or the vehicle's
};

/// One number of an input: what it follows until it is driven, and what it acts as.
struct Port {
  /// Inputs::u[input] gets (value * part) * turn.
  struct Share {
    int input = 0;
    double part = 1.0, turn = 1.0;
  };
  const Schedule* schedule = nullptr;  // of the model
  std::vector<Share> shares;
  int tank = -1;  // Model::tanks entry that it draws from, and stops with; -1: none
};

/// A signal that a run may be driven by.
struct InputSignal : Signal {
  std::vector<Port> ports;  // one per component
};

/// In the order of the CSV's columns, time apart.
std::vector<OutputSignal> outputs_of(const Model& model);
/// Those of outputs_of() that say where everything is and how it moves, whatever an engine's state
/// vector looks like: positions, then rates, then wheels.
std::vector<OutputSignal> motion_of(const Model& model);
/// In the order of the state vector of an engine with this chart.
std::vector<Signal> states_of(const Model& model, AttitudeChart chart);
/// What may act by schedule: wheels and joints of bodies in the order of the spec, then thrusters
/// and loads. All of them, whether or not the spec gives them a schedule. It refers to `model`.
std::vector<InputSignal> inputs_of(const Model& model);
/// Their numbers, in the same order.
std::vector<Port> ports_of(const Model& model);

/// The name of every number of `signals`.
template <class OneSignal>
std::vector<std::string> component_names(const std::vector<OneSignal>& signals) {
  std::vector<std::string> names;
  for (const Signal& signal : signals)
    for (std::size_t i = 0; i < signal.size(); ++i) names.push_back(signal.component(i));
  return names;
}

/// Name of the coordinate that is an entry of the joint vector; `joint 3` where none is named.
std::string joint_name(const Model& model, std::size_t joint);
/// The same of the vector of wheels.
std::string wheel_name(const Model& model, std::size_t wheel);

}  // namespace twincraft
