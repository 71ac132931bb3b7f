// See attribution_json.h. NaN, where a variant could not be run, becomes null.
// Tested by tests/runtime/attribution_test.cpp.
#include "runtime/report/attribution_json.h"

#include "runtime/report/attribution_words.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

Json law_json(const AttributedCause& cause) {
  if (!cause.law) return nullptr;
  return {{"variable", cause.law->variable},
          {"exponent", cause.law->exponent},
          {"words", law_words(*cause.law)},
          {"factors", cause.law->factors},
          {"contributions", cause.law->contributions}};
}

std::string_view kind_name(Remainder kind) {
  switch (kind) {
    case Remainder::kRounding:
      return "rounding";
    case Remainder::kIntegrator:
      return "integrator";
    case Remainder::kMujocoRounding:
      return "mujoco_rounding";
    case Remainder::kUnknown:
      return "unknown";
    case Remainder::kUnexplained:
      break;
  }
  return "unexplained";
}

}  // namespace

Json attribution_json(const Attribution& attribution) {
  Json list = Json::array();
  for (const AttributedCause& cause : attribution.causes)
    list.push_back({{"cause", cause.cause.key},
                    {"name", cause.cause.name},
                    {"metric", attribution.subject.metric},
                    {"maximum", attribution.maximum},
                    {"share", cause.share},
                    {"maximum_without", cause.maximum_without},
                    {"law", law_json(cause)},
                    {"no_law", cause.law ? Json(nullptr) : Json(cause.no_law)},
                    {"removed_by", cause.cause.remove},
                    {"maximum_left", cause.maximum_left},
                    {"remainder", attribution.remainder}});
  return list;
}

Json explanation_json(const Attribution& attribution, const Model& model) {
  const std::optional<double>& order = attribution.remainder_order;
  const Subject& subject = attribution.subject;
  return {{"metric", subject.metric},
          {"coordinate", subject.joint ? Json(subject.coordinate) : Json(nullptr)},
          {"maximum", attribution.maximum},
          {"rounding", subject.unit * subject.rounding},
          {"mujoco_rounding", subject.unit * subject.mujoco_rounding},
          {"nothing_to_explain", attribution.is_rounding},
          {"remainder", attribution.remainder},
          {"remainder_is", kind_name(attribution.kind)},
          {"remainder_order", order ? Json(*order) : Json(nullptr)},
          {"conclusion", conclusion(attribution, model)},
          {"method", attribution_method()}};
}

}  // namespace twincraft
