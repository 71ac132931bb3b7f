// See stored.h. Tested by tests/compiler/stored_test.cpp.
#include "compiler/spec/stored.h"

#include <fmt/format.h>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

const Table<StoredStateSpec>& state_table() {
  static const Table<StoredStateSpec> table{
      "stored state",
      "What is known of the vehicle at one time; at least one quantity.",
      {
          required("time", &StoredStateSpec::time, quantity("s", Range::kNotNegative),
                   "From the start of the run. A step lands on it."),
          optional("position", &StoredStateSpec::position, maybe(vector3("m")),
                   "In N components, of `stored.point`."),
          optional("velocity", &StoredStateSpec::velocity, maybe(vector3("m/s")),
                   "In N components, of `stored.point`."),
          optional("attitude", &StoredStateSpec::attitude, maybe(object(attitude_table())),
                   "How B is turned from N."),
          optional("rate", &StoredStateSpec::rate, maybe(vector3("rad/s")),
                   "Angular velocity omega_BN in B components."),
      }};
  return table;
}

const Table<StoredToleranceSpec>& tolerance_table() {
  const auto tolerance = [](SiUnit unit) { return maybe(quantity(unit, Range::kNotNegative)); };
  static const Table<StoredToleranceSpec> table{
      "stored tolerance",
      "How far each engine may be from every stored state. What has no tolerance is reported but "
      "not judged.",
      {
          optional("position", &StoredToleranceSpec::position, tolerance("m"),
                   "Of `stored.point`."),
          optional("velocity", &StoredToleranceSpec::velocity, tolerance("m/s"),
                   "Of `stored.point`."),
          optional("attitude", &StoredToleranceSpec::attitude, tolerance("rad"),
                   "Principal angle to the stored attitude."),
          optional("rate", &StoredToleranceSpec::rate, tolerance("rad/s"), "Body rate."),
      }};
  return table;
}

/// What directions of the orbit are taken from, where there is one.
std::optional<PointState> point_of(const StoredStateSpec& state,
                                   const EnvironmentSpec& environment) {
  if (!environment.gravity || !state.position || !state.velocity) return std::nullopt;
  return PointState{*state.position, *state.velocity};
}

void check_state(const StoredStateSpec& state, const EnvironmentSpec& environment,
                 Diagnostics& diagnostics) {
  if (!state.position && !state.velocity && !state.attitude && !state.rate) {
    diagnostics.error(
        Code::kStoredNothing, state.span(),
        fmt::format("the stored state at {} s holds nothing to compare", shortest(state.time)));
  }
  if (!state.attitude) return;
  const std::optional<PointState> point = point_of(state, environment);
  check(*state.attitude, point ? &*point : nullptr, diagnostics);
}

void check_times(const StoredSpec& stored, Diagnostics& diagnostics) {
  for (std::size_t i = 1; i < stored.states.size(); ++i) {
    const StoredStateSpec& before = stored.states[i - 1];
    const StoredStateSpec& state = stored.states[i];
    if (state.time > before.time) continue;
    diagnostics
        .error(Code::kStoredTime, state.span_of("time"),
               fmt::format("the stored state at {} s does not come after the one at {} s",
                           shortest(state.time), shortest(before.time)))
        .with_note(before.span_of("time"), "the state before it is here");
  }
}

void check_end(const StoredSpec& stored, double duration, Diagnostics& diagnostics) {
  for (const StoredStateSpec& state : stored.states) {
    if (state.time <= duration) continue;
    diagnostics
        .error(Code::kStoredTime, state.span_of("time"),
               fmt::format("the run ends at {} s, before the stored state at {} s",
                           shortest(duration), shortest(state.time)))
        .with_hint("raise `simulation.duration`, or take `stored` out of `references`");
    return;  // all later ones are too
  }
}

StoredState lower(const StoredStateSpec& spec, const EnvironmentSpec& environment) {
  StoredState state;
  state.time = spec.time;
  state.position = spec.position;
  state.velocity = spec.velocity;
  state.omega_BN_B = spec.rate;
  if (spec.attitude)
    state.q_BN = orientation(*spec.attitude, point_of(spec, environment).value_or(PointState{}));
  return state;
}

}  // namespace

const Table<StoredSpec>& stored_table() {
  static const Table<StoredSpec> table{
      "stored",
      "States of this vehicle that somebody else computed, as truth for `references: [stored]`. "
      "Every engine is compared with each of them.",
      {
          required("source", &StoredSpec::source, text(), "Who computed them, and how."),
          optional(
              "point", &StoredSpec::point,
              one_of<StartPoint>({{"com", StartPoint::kCenterOfMass}, {"hub", StartPoint::kHub}}),
              "Whose position and velocity they give: the system centre of mass or the hub "
              "origin B."),
          required("states", &StoredSpec::states, list_of(object(state_table()), 1),
                   "By time, the earliest first."),
          optional("tolerance", &StoredSpec::tolerance, object(tolerance_table()),
                   "Of the verdict."),
      }};
  return table;
}

void check(const StoredSpec& stored, bool is_used, const EnvironmentSpec& environment,
           double duration, Diagnostics& diagnostics) {
  for (const StoredStateSpec& state : stored.states) check_state(state, environment, diagnostics);
  check_times(stored, diagnostics);
  if (is_used) check_end(stored, duration, diagnostics);
}

StoredTruth lower(const StoredSpec& spec, const EnvironmentSpec& environment) {
  StoredTruth truth;
  truth.source = spec.source;
  truth.of_hub = spec.point == StartPoint::kHub;
  for (const StoredStateSpec& state : spec.states)
    truth.states.push_back(lower(state, environment));
  truth.position = spec.tolerance.position;
  truth.velocity = spec.tolerance.velocity;
  truth.attitude = spec.tolerance.attitude;
  truth.rate = spec.tolerance.rate;
  return truth;
}

}  // namespace twincraft
