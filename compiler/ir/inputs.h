// Everything that acts on a vehicle by a schedule, one number each, in one order, and the one place
// where schedules are read during a run. Tested by tests/compiler/ir_test.cpp.
#pragma once

#include <vector>

#include "compiler/ir/model.h"
#include "compiler/ir/signals.h"

namespace twincraft {

/// Where the inputs of a model are in Inputs::u. A vector takes three entries.
struct InputLayout {
  int joints = 0, wheels = 0, loads = 0, tanks = 0, nozzles = 0;

  InputLayout() = default;
  explicit InputLayout(const Model& model);

  int effort(int joint) const { return joint; }                 // [N m] or [N], of link joint + 1
  int motor_torque(int wheel) const { return joints + wheel; }  // [N m] on the wheel
  int force(int load) const { return joints + wheels + 6 * load; }         // [N] link axes
  int torque(int load) const { return force(load) + 3; }                   // [N m] link axes
  int tank_flow(int tank) const { return force(loads) + tank; }            // [kg/s] out of it
  int nozzle_flow(int nozzle) const { return tank_flow(tanks) + nozzle; }  // [kg/s]
  int size() const { return nozzle_flow(nozzles); }
};

/// What holds from one instant to the next change: constant inputs, and tanks that run down evenly.
struct Inputs {
  InputLayout layout;
  double since = 0.0;        // [s]
  std::vector<double> u;     // see InputLayout
  std::vector<Drain> tanks;  // one per tank

  double operator[](int i) const { return u[static_cast<std::size_t>(i)]; }
  Vector3d vector(int i) const { return Vector3d::Map(&u[static_cast<std::size_t>(i)]); }
};

/// Follows the schedules of a model, which must outlive it. A port (see signals.h) that is driven
/// holds its value in place of its schedule, and one whose tank has run empty holds zero.
class InputFeed {
 public:
  explicit InputFeed(const Model& model);

  const Inputs& inputs() const { return now_.inputs; }

  /// The inputs from `time` [s] on. Forward in time every change of a flow is added up once; back
  /// in time, where nothing may be driven, all are again. No allocation.
  const Inputs& begin(double time);

  /// From `time` on. Driving a port with the value that it has changes nothing. @pre time is not
  /// before that of the last call
  const Inputs& drive(std::size_t port, double value, double time);
  const Inputs& release(std::size_t port, double time);
  /// Of a port: what acts.
  double value(std::size_t port) const { return value_at(port, now_.inputs.since); }
  bool is_driven(std::size_t port) const { return now_.is_driven[port]; }

  /// When the first tank runs empty at the flows of now [s]; infinite: none does.
  double empty_at() const;
  /// From `time` on: what draws from the tanks that are empty then has stopped for good.
  const Inputs& stop_empty(double time);

  /// How far it is: a value that another feed of the same model goes on from.
  struct Position {
    Inputs inputs;
    std::vector<std::size_t> next;  // of each tank's flow, the entry that comes next
    std::vector<bool> is_driven;    // of each port
    std::vector<double> driven;     // what it is driven with
    std::vector<bool> is_empty;     // of each tank
  };
  const Position& position() const { return now_; }
  void go_on_from(const Position& position) { now_ = position; }

 private:
  /// What a port adds to an input: (value part) turn.
  struct Term {
    std::size_t port = 0;
    double part = 1.0, turn = 1.0;
  };

  void fill_tanks();
  bool is_changed(std::size_t port) const;
  double value_at(std::size_t port, double time) const;
  double input_at(std::size_t input, double time) const;
  /// Set the inputs that a port acts as, and the drains that it feeds, anew.
  void follow(std::size_t port, double time);

  const Model& model_;
  std::vector<const Schedule*> schedules_;  // of every input, in the order of the layout
  std::vector<Port> ports_;
  std::vector<std::vector<Term>> terms_;  // of every input
  Position now_;
};

/// The inputs of a model from `time` [s] on, once.
Inputs inputs_at(const Model& model, double time);

/// The times [s] in (0, end) at which an input changes. Ascending, without repeats.
std::vector<double> input_events(const Model& model, double end);
/// Those inside the run.
std::vector<double> input_events(const Model& model);

}  // namespace twincraft
