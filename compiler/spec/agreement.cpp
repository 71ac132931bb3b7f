// See agreement.h. Tested by tests/compiler/engines_test.cpp.
#include "compiler/spec/agreement.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/analysis/truth.h"

namespace twincraft {

namespace {

Kind<std::optional<double>> tolerance(SiUnit unit) {
  return maybe(quantity(unit, Range::kNotNegative, Usual{}));  // a tolerance is of any size
}

Kind<std::optional<double>> relative() { return maybe(number(Range::kNotNegative)); }

const Table<KeplerToleranceSpec>& kepler_table() {
  static const Table<KeplerToleranceSpec> table{
      "kepler tolerance",
      "How far each engine's system centre of mass may be from its Kepler orbit.",
      {
          optional("position", &KeplerToleranceSpec::position, tolerance("m"), "Position error."),
          optional("velocity", &KeplerToleranceSpec::velocity, tolerance("m/s"), "Velocity error."),
      }};
  return table;
}

const Table<RotationToleranceSpec>& rotation_table() {
  static const Table<RotationToleranceSpec> table{
      "rotation tolerance",
      "How far the rotation of each engine may be from the reference.",
      {
          optional("attitude", &RotationToleranceSpec::attitude, tolerance("rad"),
                   "Principal angle to the reference attitude."),
          optional("rate", &RotationToleranceSpec::rate, tolerance("rad/s"),
                   "Error of the body rate."),
      }};
  return table;
}

const Table<TsiolkovskyToleranceSpec>& tsiolkovsky_table() {
  static const Table<TsiolkovskyToleranceSpec> table{
      "tsiolkovsky tolerance",
      "How far each engine may be from the rocket equation.",
      {
          optional("delta_v", &TsiolkovskyToleranceSpec::delta_v, relative(),
                   "Velocity error of the system centre of mass, relative to the delta-v gained "
                   "so far."),
          optional("velocity", &TsiolkovskyToleranceSpec::velocity, tolerance("m/s"),
                   "The same error, absolute."),
          optional("position", &TsiolkovskyToleranceSpec::position, tolerance("m"),
                   "Position error of the hub origin B."),
      }};
  return table;
}

const Table<ReferenceTolerancesSpec>& references_table() {
  static const Table<ReferenceTolerancesSpec> table{
      "reference tolerances",
      "How far each engine may be from the references that the spec lists in `references`, at any "
      "recorded sample. Stored states have theirs in `stored.tolerance`.",
      {
          optional("kepler", &ReferenceTolerancesSpec::kepler, object(kepler_table()),
                   "Tolerances of `kepler`."),
          optional("spin_up", &ReferenceTolerancesSpec::spin_up, object(rotation_table()),
                   "Tolerances of `spin_up`."),
          optional("torque_free", &ReferenceTolerancesSpec::torque_free, object(rotation_table()),
                   "Tolerances of `torque_free`."),
          optional("tsiolkovsky", &ReferenceTolerancesSpec::tsiolkovsky,
                   object(tsiolkovsky_table()), "Tolerances of `tsiolkovsky`."),
      }};
  return table;
}

Field<AgreementSpec> judged(std::string_view key,
                            std::optional<double> AgreementTolerances::*tolerated,
                            const Kind<std::optional<double>>& kind, std::string_view doc) {
  std::optional<double> AgreementSpec::*member = tolerated;
  return optional(key, member, kind, doc);
}

}  // namespace

const Table<AgreementSpec>& agreement_table() {
  static const Table<AgreementSpec> table{
      "agreement",
      "The tolerances that the verdict rests on, at any recorded sample. A quantity without a "
      "tolerance is reported but not judged. A tolerance for something that the vehicle does not "
      "have is ignored.",
      {
          judged("attitude", &AgreementTolerances::attitude, tolerance("rad"),
                 "Principal angle between the attitudes of the two engines."),
          judged("rate", &AgreementTolerances::rate, tolerance("rad/s"),
                 "Difference of the body rates."),
          judged("position", &AgreementTolerances::position, tolerance("m"),
                 "Difference of the positions of the system centre of mass."),
          judged("velocity", &AgreementTolerances::velocity, tolerance("m/s"),
                 "Difference of the velocities of the hub origin B."),
          judged("joint", &AgreementTolerances::joint, tolerance("rad"),
                 "Difference of the joint angles: panels and revolute joints together by their "
                 "Euclidean norm, pendulum angles by the largest. Prismatic joints are judged by "
                 "`travel`."),
          judged("travel", &AgreementTolerances::travel, tolerance("m"),
                 "Difference of the displacements of prismatic joints, by their Euclidean norm."),
          judged("wheel", &AgreementTolerances::wheel, tolerance("rad/s"),
                 "Difference of the wheel speeds, by their Euclidean norm."),
          judged("slosh", &AgreementTolerances::slosh, tolerance("m"),
                 "Difference of the slosh displacements, the largest."),
          judged("mass", &AgreementTolerances::mass, tolerance("kg"),
                 "Difference of the masses of the whole vehicle."),
          judged("energy", &AgreementTolerances::energy, relative(),
                 "Energy balance of each engine: its change less the work of all loads, relative "
                 "to the energy."),
          judged("momentum", &AgreementTolerances::momentum, relative(),
                 "Momentum balance of each engine: its change less the impulse of all loads, "
                 "relative to the momenta in the vehicle."),
          judged("angular_momentum", &AgreementTolerances::angular_momentum, relative(),
                 "The same balance of the angular momentum about the system centre of mass."),
          optional("references", &AgreementSpec::references, object(references_table()),
                   "Tolerances of each engine's deviations from the references."),
      }};
  return table;
}

void check(const AgreementSpec& agreement, const std::vector<ReferenceKind>& references,
           Diagnostics& diagnostics) {
  for (const ReferenceKind kind : {ReferenceKind::kKepler, ReferenceKind::kSpinUp,
                                   ReferenceKind::kTorqueFree, ReferenceKind::kTsiolkovsky}) {
    const std::string name(reference_name(kind));
    const bool is_listed = std::ranges::find(references, kind) != references.end();
    if (is_listed || !agreement.references.has(name)) continue;
    diagnostics
        .warning(
            Code::kReferenceNotListed, agreement.references.span_of(name),
            fmt::format("these tolerances judge nothing: `references` does not list `{}`", name))
        .with_hint("list it in `references`, or delete its tolerances");
  }
}

Agreement lower(const AgreementSpec& spec) {
  Agreement agreement{spec, {}};
  const ReferenceTolerancesSpec& from = spec.references;
  ReferenceTolerances& to = agreement.references;
  to.kepler.position = from.kepler.position;
  to.kepler.velocity = from.kepler.velocity;
  to.spin_up.attitude = from.spin_up.attitude;
  to.spin_up.rate = from.spin_up.rate;
  to.torque_free.attitude = from.torque_free.attitude;
  to.torque_free.rate = from.torque_free.rate;
  to.tsiolkovsky.position = from.tsiolkovsky.position;
  to.tsiolkovsky.velocity = from.tsiolkovsky.velocity;
  to.tsiolkovsky.delta_v = from.tsiolkovsky.delta_v;
  return agreement;
}

Kind<ReferenceKind> reference_kind() {
  std::vector<std::pair<std::string_view, ReferenceKind>> words;
  for (const ReferenceKind kind :
       {ReferenceKind::kKepler, ReferenceKind::kSpinUp, ReferenceKind::kTorqueFree,
        ReferenceKind::kTsiolkovsky, ReferenceKind::kStored})
    words.emplace_back(reference_name(kind), kind);
  return one_of<ReferenceKind>(words);
}

}  // namespace twincraft
