#include "runtime/report/resolution_json.h"

#include <nlohmann/json.hpp>

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json fastest_json(const std::optional<FastestMotion>& fastest) {
  if (!fastest) return nullptr;
  return {{"coordinate", fastest->coordinate},
          {"rate_rad_s", fastest->rate},
          {"damping_ratio", fastest->damping_ratio},
          {"kind", fastest->kind}};
}

Json worst_json(const Resolution& resolution) {
  const std::string& coordinate = resolution.worst_coordinate;
  return {{"coordinate", coordinate.empty() ? Json(nullptr) : Json(coordinate)},
          {"error_relative", or_null(resolution.worst_error)}};
}

Json energy_json(const Member& member) {
  Json json = Json::object();
  for (const EngineRun& run : member.engines) {
    if (run.trajectory.samples.empty()) continue;
    json[run.name] = {{"exchanged_J", run.own_energy.exchanged},
                      {"drift_J", run.own_energy.drift},
                      {"relative", run.own_energy.relative}};
  }
  return json;
}

}  // namespace

Json resolution_json(const Member& member) {
  const Resolution& resolution = *member.resolution;
  Json json{{"resolved", resolution.resolved},
            {"rule", resolution.rule ? Json(rule_name(*resolution.rule)) : Json(nullptr)},
            {"fastest", fastest_json(resolution.fastest)},
            {"worst", worst_json(resolution)},
            {"attitude_error_deg", or_null(resolution.attitude_error_deg)},
            {"step_s", resolution.step},
            {"largest_stable_step_s", or_null(resolution.largest_stable_step)},
            {"advised_step_s", or_null(resolution.advised_step)}};
  if (resolution.advised_rk4_step) json["advised_rk4_step_s"] = *resolution.advised_rk4_step;
  if (resolution.advised_tolerance) json["advised_tolerance"] = *resolution.advised_tolerance;
  json["energy"] = energy_json(member);
  json["reasons"] = resolution.reasons;
  json["remarks"] = resolution.remarks;
  return json;
}

}  // namespace twincraft
