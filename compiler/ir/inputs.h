// Everything that acts on a vehicle by a schedule, one number each, in one order, and the one place
// where schedules are read during a run. Tested by tests/compiler/ir_test.cpp.
#pragma once

#include <vector>

#include "compiler/ir/model.h"

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

/// Follows the schedules of a model, which must outlive it; an input that is driven holds its value
/// in place of its schedule.
class InputFeed {
 public:
  explicit InputFeed(const Model& model);

  const Inputs& inputs() const { return now_.inputs; }

  /// The inputs from `time` [s] on. Forward in time every change of a flow is added up once; back
  /// in time, where nothing may be driven, all are again. No allocation.
  const Inputs& begin(double time);

  /// From `time` on. Driving an input with the value that it has changes nothing. @pre time is not
  /// before that of the last call
  const Inputs& drive(int input, double value, double time);
  const Inputs& release(int input, double time);

  /// How far it is: a value that another feed of the same model goes on from.
  struct Position {
    Inputs inputs;
    std::vector<std::size_t> next;  // of each tank's flow, the entry that comes next
    std::vector<bool> is_driven;    // of each input
  };
  const Position& position() const { return now_; }
  void go_on_from(const Position& position) { now_ = position; }

 private:
  void fill_tanks();
  void set(int input, double value, double time);

  const Model& model_;
  std::vector<const Schedule*> schedules_;  // of every input, in the order of the layout
  Position now_;
};

/// The inputs of a model from `time` [s] on, once.
Inputs inputs_at(const Model& model, double time);

/// The times [s] inside the run at which an input changes. Ascending, without repeats.
std::vector<double> input_events(const Model& model);

}  // namespace twincraft
