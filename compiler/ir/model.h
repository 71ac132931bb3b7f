// The compiled model: one machine, twice, with all that a run of it needs. Immutable after the
// compiler made it; the runtime sees nothing else of the compiler.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compiler/ir/assembly.h"
#include "compiler/ir/body_tree.h"
#include "compiler/ir/coordinate.h"
#include "compiler/ir/forces.h"
#include "compiler/ir/propellant.h"
#include "compiler/ir/stored.h"

namespace twincraft {

/// What makes a load a thruster: something flows out against its force.
struct Thruster {
  Schedule thrust;                          // [N]
  Vector3d direction_M = Vector3d::Zero();  // unit vector of the force, mount axes
  int tank = -1;                            // Model::tanks entry it draws from; -1: none
  int nozzle = -1;                          // Model::nozzles entry; -1: none
  double flow_per_thrust = 0.0;             // [kg/(N s)] out of the tank
};

/// A force and a torque fixed in the axes of a mount, itself fixed on a link. Intervals are already
/// folded into the schedules.
struct Load {
  std::string name;
  int link = 0;
  std::array<Schedule, 3> force_L;   // [N] link axes
  std::array<Schedule, 3> torque_L;  // [N m]
  // Where the force acts: a point from the link's origin [m], or the system centre of mass.
  std::optional<Vector3d> r_FL_L;
  std::optional<Thruster> thruster = {};
  // The same as the spec says it, in mount axes. A thruster says it by itself.
  std::array<Schedule, 3> force_M = {};
  std::array<Schedule, 3> torque_M = {};
  Matrix3d dcm_LM = Matrix3d::Identity();
};

enum class GravityLaw {
  kNone,
  kSystemCom,     // m g(r_C), one uniform field
  kBodyCom,       // m_i g(r_i) at every element's centre of mass
  kBodyGradient,  // kBodyCom and every element's own gravity-gradient torque
};

struct Gravity {
  double mu = 0.0;  // [m^3/s^2]
  GravityLaw bsm = GravityLaw::kNone;
  GravityLaw mujoco = GravityLaw::kNone;
};

/// Where a vehicle is and how it moves, whatever an engine's state vector looks like.
struct VehicleState {
  Vector3d r_BN_N = Vector3d::Zero();          // hub origin [m]
  Vector3d v_BN_N = Vector3d::Zero();          // [m/s]
  Quaterniond q_BN = Quaterniond::Identity();  // B to N components
  Vector3d omega_BN_B = Vector3d::Zero();      // [rad/s]
  std::vector<double> joint_position;          // [rad] or [m], one per link but the hub
  std::vector<double> joint_rate;
  std::vector<double> wheel_rate;  // [rad/s] relative to the mount, one per rotor
};

enum class Method { kEuler, kRk2, kRk4, kRkf45, kRkf78 };

/// absolute + relative * |block|
struct Tolerance {
  double absolute = 0.0;
  double relative = 0.0;
};

/// Error control per block of the state; `mass` and books are never controlled.
struct BlockTolerances {
  Tolerance position, velocity, attitude, rate, joint, joint_rate, wheel;
};

struct SimulationPlan {
  bool translation = false;  // a point mass: the hub alone, its axes along those of N for good
  Method method = Method::kRk4;
  double step = 0.0;      // [s] fixed step, or the interval an adaptive method always lands on
  double duration = 0.0;  // [s]
  double record = 0.0;    // [s]
  bool judges_resolution = true;  // false: what does not resolve the vehicle is said, not judged
  BlockTolerances tolerance;
};

enum class AttitudeChart { kMrp, kQuaternion };
/// How the analytic engine eliminates chains of parallel hinges: in their plane, or as any tree.
enum class ChainPath { kPlanar, kGeneral };
enum class MujocoFrame { kComoving, kInertial };

struct EngineControls {
  AttitudeChart attitude = AttitudeChart::kMrp;
  MujocoFrame frame = MujocoFrame::kComoving;
  double wheel_mass = 1.0e-6;  // [kg] token mass of a massless wheel in the tree
  bool compensate = true;
  // [kg m^2] token inertias of pendulum bobs and particles, in the tree alone
  double bob_inertia = 0.0;
  double particle_inertia = 0.0;
  ChainPath chains = ChainPath::kPlanar;
};

/// Tolerances of one reference, of those metrics that it has; absent: reported, not judged.
struct ReferenceTolerance {
  std::optional<double> position;  // [m]
  std::optional<double> velocity;  // [m/s]
  std::optional<double> attitude;  // [rad]
  std::optional<double> rate;      // [rad/s]
  std::optional<double> delta_v;   // relative
};

/// `stored` brings its own, see StoredTruth.
struct ReferenceTolerances {
  ReferenceTolerance kepler, spin_up, torque_free, tsiolkovsky;
};

/// Tolerances of the verdict; absent: reported, not judged.
struct AgreementTolerances {
  // How far the engines may be apart.
  std::optional<double> attitude;  // [rad]
  std::optional<double> rate;      // [rad/s]
  std::optional<double> position;  // [m] system centre of mass
  std::optional<double> velocity;  // [m/s]
  std::optional<double> joint;     // [rad] joint angles
  std::optional<double> travel;    // [m] prismatic joints
  std::optional<double> wheel;     // [rad/s]
  std::optional<double> slosh;     // [m]
  std::optional<double> mass;      // [kg]
  // What each engine must conserve, relative.
  std::optional<double> energy;
  std::optional<double> momentum;
  std::optional<double> angular_momentum;
};

struct Agreement : AgreementTolerances {
  ReferenceTolerances references;  // how far each engine may be from its references
};

enum class ReferenceKind { kKepler, kSpinUp, kTorqueFree, kTsiolkovsky, kStored };

struct Model {
  std::string name;
  std::string description;
  Assembly assembly;
  BodyTree tree;
  std::vector<Coordinate> coordinates;
  std::vector<Load> loads;
  std::vector<Tank> tanks;
  std::vector<Nozzle> nozzles;  // of the tanks whose propellant leaves as a jet, and only those
  Forces forces;                // that follow the motion of links
  Gravity gravity;
  VehicleState initial;  // at t = 0; both engines start here
  SimulationPlan simulation;
  EngineControls engines;
  Agreement agreement;
  std::vector<ReferenceKind> references;
  StoredTruth stored;  // states only when the references name it
  // Why the tree cannot be loaded by MuJoCo (too deep, or too large); empty when it can.
  std::string mujoco_refusal;

  /// Velocity coordinates: 6 + joints + wheels; 3 of a point mass.
  int degrees_of_freedom() const {
    if (simulation.translation) return 3;
    return 6 + static_cast<int>(assembly.links.size()) - 1 +
           static_cast<int>(assembly.rotors.size());
  }
};

}  // namespace twincraft
