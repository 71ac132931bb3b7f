// See agreement.h. Tested by tests/compiler/engines_test.cpp.
#include "compiler/components/agreement.h"

namespace twincraft {

const Table<AgreementSpec>& agreement_table() {
  const auto tolerance = [](SiUnit unit) { return maybe(quantity(unit, Range::kNotNegative)); };
  static const Table<AgreementSpec> table{
      "agreement",
      "How far the engines may be apart at any recorded sample. What has no tolerance is reported "
      "but not judged.",
      {
          optional("attitude", &AgreementSpec::attitude, tolerance("rad"),
                   "Principal angle between the two attitudes."),
          optional("rate", &AgreementSpec::rate, tolerance("rad/s"), "Body rate."),
          optional("position", &AgreementSpec::position, tolerance("m"),
                   "Of the system centre of mass."),
          optional("velocity", &AgreementSpec::velocity, tolerance("m/s"),
                   "Of the system centre of mass."),
          optional("joint", &AgreementSpec::joint, tolerance("rad"), "Any joint angle."),
          optional("wheel", &AgreementSpec::wheel, tolerance("rad/s"), "Any wheel speed."),
          optional("slosh", &AgreementSpec::slosh, tolerance("m"), "Any slosh displacement."),
          optional("mass", &AgreementSpec::mass, tolerance("kg"), "Of the whole vehicle."),
      }};
  return table;
}

Agreement lower(const AgreementSpec& spec) {
  return {spec.attitude, spec.rate,  spec.position, spec.velocity,
          spec.joint,    spec.wheel, spec.slosh,    spec.mass};
}

Kind<ReferenceKind> reference_kind() {
  return one_of<ReferenceKind>(
      {{"kepler", ReferenceKind::kKepler}, {"spin_up", ReferenceKind::kSpinUp}});
}

void check_reference(ReferenceKind reference, Span span, const EnvironmentSpec& environment,
                     bool is_rigid, Diagnostics& diagnostics) {
  if (reference == ReferenceKind::kKepler && !environment.gravity) {
    diagnostics.error(Code::kReferenceInapplicable, span,
                      "`kepler` describes an orbit, and deep space has none");
  }
  if (reference == ReferenceKind::kSpinUp && !is_rigid) {
    diagnostics.error(Code::kReferenceInapplicable, span,
                      "`spin_up` describes a rigid body, and this vehicle has moving parts");
  }
}

}  // namespace twincraft
