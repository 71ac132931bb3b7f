// See initial.h. Tested by tests/compiler/initial_test.cpp.
#include "compiler/spec/initial.h"

#include "compiler/analysis/configuration.h"
#include "compiler/spec/kilometres.h"

namespace twincraft {
namespace {

/// The state of the point that the spec names. @pre an orbit has gravity
PointState start(const InitialSpec& initial, const EnvironmentSpec& environment) {
  if (initial.orbit) return state_of(*initial.orbit, environment.gravity->mu);
  return {initial.position, initial.velocity};
}

/// Without an `initial` section the gravity is what can be pointed at.
void check_place(const InitialSpec& initial, const GravitySpec& gravity, Diagnostics& diagnostics) {
  if (initial.orbit || initial.position.norm() > 0.0) return;
  const Span span = initial.node != nullptr ? initial.span_of("position") : gravity.span();
  diagnostics
      .error(Code::kAtAttractingCenter, span,
             "the vehicle starts at the centre of the attracting body")
      .with_hint("give `initial.orbit`, or `initial.position` and `initial.velocity`");
}

/// Move the state from C to B. @pre attitude, rate and coordinates are set
void move_to_hub(const Assembly& assembly, VehicleState& state) {
  const std::vector<LinkMotion> links =
      configuration(assembly, state.joint_position, state.joint_rate);
  const Vector3d c_B = system_properties(assembly, links).r_CL_L;  // [m] C from B
  const Vector3d cPrime_B = center_of_mass_rate(assembly, links);  // [m/s] seen in B
  const Matrix3d dcm_NB = state.q_BN.toRotationMatrix();
  state.r_BN_N -= dcm_NB * c_B;
  state.v_BN_N -= dcm_NB * (cPrime_B + state.omega_BN_B.cross(c_B));
}

}  // namespace

const Table<InitialSpec>& initial_table() {
  static const Table<InitialSpec> table =
      Table<InitialSpec>{
          "initial",
          "The state at t = 0.",
          {
              optional("orbit", &InitialSpec::orbit, maybe(object(orbit_table())),
                       "Orbital elements; they need `environment.gravity`."),
              optional("position", &InitialSpec::position, vector3("m"), "In N components."),
              optional("velocity", &InitialSpec::velocity, vector3("m/s"), "In N components."),
              optional("point", &InitialSpec::point,
                       one_of<StartPoint>(
                           {{"com", StartPoint::kCenterOfMass}, {"hub", StartPoint::kHub}}),
                       "Whose orbit, or position and velocity, this is: the system centre of mass "
                       "or the hub origin B."),
              optional("attitude", &InitialSpec::attitude, maybe(object(attitude_table())),
                       "How B is turned from N; default not at all."),
              optional("rate", &InitialSpec::rate, vector3("rad/s"),
                       "Angular velocity omega_BN in B components."),
          }}
          .at_most_one_of({"orbit", "position"})
          .at_most_one_of({"orbit", "velocity"});
  return table;
}

void check(const InitialSpec& initial, const EnvironmentSpec& environment,
           Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  const bool deep_space = !environment.gravity;
  if (initial.orbit && deep_space) {
    diagnostics
        .error(Code::kNeedsGravity, initial.span_of("orbit"),
               "an orbit in deep space: there is nothing to orbit")
        .with_hint("add `environment: {gravity: {mu: 3.98600436e14 m3/s2}}`");
  }
  if (initial.orbit) check(*initial.orbit, diagnostics);
  if (!deep_space) check_place(initial, *environment.gravity, diagnostics);
  if (!deep_space && diagnostics.error_count() == errors_before)
    warn_of_kilometres(initial, *environment.gravity, diagnostics);
  // Directions of an orbit that is itself at fault would only repeat the fault.
  if (!initial.attitude || diagnostics.error_count() != errors_before) return;
  const PointState point = start(initial, environment);
  check(*initial.attitude, deep_space ? nullptr : &point, diagnostics);
}

Quaterniond attitude(const InitialSpec& initial, const EnvironmentSpec& environment) {
  return initial.attitude ? orientation(*initial.attitude, start(initial, environment))
                          : Quaterniond::Identity();
}

void lower(const InitialSpec& initial, const EnvironmentSpec& environment, Model& model) {
  const PointState point = start(initial, environment);
  VehicleState& state = model.initial;
  state.q_BN = attitude(initial, environment);
  state.omega_BN_B = initial.rate;
  state.r_BN_N = point.r_N;
  state.v_BN_N = point.v_N;
  if (initial.point == StartPoint::kCenterOfMass) move_to_hub(model.assembly, state);
}

}  // namespace twincraft
