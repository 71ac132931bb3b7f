// See agreement.h. Tested by tests/compiler/engines_test.cpp.
#include "compiler/components/agreement.h"

#include "compiler/ir/truth.h"

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
  std::vector<std::pair<std::string, ReferenceKind>> words;
  for (const ReferenceKind kind :
       {ReferenceKind::kKepler, ReferenceKind::kSpinUp, ReferenceKind::kTorqueFree,
        ReferenceKind::kTsiolkovsky, ReferenceKind::kStored})
    words.emplace_back(reference_name(kind), kind);
  return one_of<ReferenceKind>(words);
}

}  // namespace twincraft
