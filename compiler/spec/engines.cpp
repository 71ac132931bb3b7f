// See engines.h. Tested by tests/compiler/engines_test.cpp.
#include "compiler/spec/engines.h"

#include "compiler/components/physical.h"
#include "compiler/ir/engine_kind.h"

namespace twincraft {
namespace {

const Table<BsmSpec>& bsm_table() {
  static const Table<BsmSpec> table{
      kBsmKey,
      "The analytic back-substitution engine.",
      {
          optional(
              "attitude", &BsmSpec::attitude,
              one_of<AttitudeChart>(
                  {{"mrp", AttitudeChart::kMrp}, {"quaternion", AttitudeChart::kQuaternion}}),
              "Attitude coordinates that the engine integrates. `mrp`: three modified Rodrigues "
              "parameters, switched to their shadow set beyond half a turn. `quaternion`: "
              "four numbers, usually more accurate at the same step when the vehicle spins. "
              "The engine integrates the motion of B, so an attitude error also moves the "
              "system centre of mass, in proportion to its distance from B. Prefer "
              "`quaternion` for a spinning vehicle whose centre of mass is far from B: at "
              "10 rpm and 3 h the difference can be a metre against a millimetre."),
          optional(
              "chains", &BsmSpec::chains,
              one_of<ChainPath>({{"planar", ChainPath::kPlanar}, {"general", ChainPath::kGeneral}}),
              "`planar`: chains of parallel hinges are eliminated in their plane, which is "
              "faster. `general`: as any other tree; the same motion to rounding."),
          optional("gravity", &BsmSpec::gravity, maybe(gravity_law()),
                   "Overrides `environment.gravity.application` for this engine."),
      }};
  return table;
}

const Table<MujocoSpec>& mujoco_table() {
  static const Table<MujocoSpec> table{
      kMujocoKey,
      "The MuJoCo engine.",
      {
          optional("frame", &MujocoSpec::frame,
                   one_of<MujocoFrame>({{"comoving", MujocoFrame::kComoving},
                                        {"inertial", MujocoFrame::kInertial}}),
                   "`comoving`: evaluated in the frame that moves with the hub. `inertial`: MuJoCo "
                   "gets the raw state, with the rounding of its large velocity."),
          optional(
              "wheel_mass", &MujocoSpec::wheel_mass, quantity("kg", Range::kPositive),
              "Token mass of a wheel's body, which MuJoCo cannot do without. The mount carries "
              "the rest of the wheel's mass. A token is never more than a wheel's own mass."),
          optional("bob_inertia", &MujocoSpec::bob_inertia, quantity("kg m2", Range::kNotNegative),
                   "Token inertia of pendulum bobs, in MuJoCo alone and in proportion to their "
                   "mass. 0: the least that loads, and exactly zero in a run."),
          optional("particle_inertia", &MujocoSpec::particle_inertia,
                   quantity("kg m2", Range::kNotNegative),
                   "Token inertia of slosh particles, likewise."),
          optional(
              "compensate", &MujocoSpec::compensate, boolean(),
              "Take the token masses back out of what carries the wheels, so that the tree is "
              "exactly the spec's vehicle. The wheels' bodies then sit at the centres of mass of "
              "their mounts, where taking them out moves nothing. `false` adds the tokens of "
              "massless wheels on top, at the wheels' positions."),
          optional("gravity", &MujocoSpec::gravity, maybe(gravity_law()),
                   "Overrides `environment.gravity.application` for this engine."),
      }};
  return table;
}

template <class Engine>
void check_override(const Engine& engine, bool deep_space, Diagnostics& diagnostics) {
  if (!engine.gravity || !deep_space) return;
  diagnostics
      .error(Code::kNeedsGravity, engine.span_of("gravity"),
             "a law of gravity, but the spec has no gravity")
      .with_hint("add `environment: {gravity: {mu: 3.98600436e14 m3/s2}}`");
}

}  // namespace

const Table<EnginesSpec>& engines_table() {
  static const Table<EnginesSpec> table{
      "engines",
      "Controls of the comparison; the defaults make both engines the same machine to rounding.",
      {
          optional(kBsmKey, &EnginesSpec::bsm, object(bsm_table()), "The analytic engine."),
          optional(kMujocoKey, &EnginesSpec::mujoco, object(mujoco_table()), "MuJoCo."),
      }};
  return table;
}

void check(const EnginesSpec& engines, const EnvironmentSpec& environment,
           Diagnostics& diagnostics) {
  const bool deep_space = !environment.gravity;
  check_override(engines.bsm, deep_space, diagnostics);
  check_override(engines.mujoco, deep_space, diagnostics);
  check_mass(engines.mujoco.wheel_mass, engines.mujoco.span_of("wheel_mass"), "a massless wheel",
             diagnostics);
}

EngineControls lower(const EnginesSpec& engines) {
  return {engines.bsm.attitude,      engines.mujoco.frame,       engines.mujoco.wheel_mass,
          engines.mujoco.compensate, engines.mujoco.bob_inertia, engines.mujoco.particle_inertia,
          engines.bsm.chains};
}

Gravity lower_gravity(const EnvironmentSpec& environment, const EnginesSpec& engines) {
  if (!environment.gravity) return {};
  const GravityLaw law = environment.gravity->application;
  return {environment.gravity->mu, engines.bsm.gravity.value_or(law),
          engines.mujoco.gravity.value_or(law)};
}

}  // namespace twincraft
