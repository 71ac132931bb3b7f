// See shrink.h.
#include "tests/random/shrink.h"

#include <cmath>

namespace twincraft::random_vehicles {
namespace {

constexpr int kTrials = 3000;

/// All places of `value` and below, the deepest last.
void places(const Json& value, const Json::json_pointer& at, std::vector<Json::json_pointer>& all) {
  if (!at.empty()) all.push_back(at);
  if (value.is_object()) {
    for (const auto& [key, item] : value.items()) places(item, at / key, all);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) places(value[i], at / i, all);
  }
}

bool is_in_list(const Json& spec, const Json::json_pointer& place) {
  return spec.at(place.parent_pointer()).is_array();
}

Json without(Json spec, const Json::json_pointer& place) {
  Json& parent = spec.at(place.parent_pointer());
  if (parent.is_array())
    parent.erase(std::stoul(place.back()));
  else
    parent.erase(place.back());
  return spec;
}

std::vector<Json> simpler(const Json& value) {
  if (value.is_string()) return {"hub"};  // a mount
  if (value.is_array() && !value.empty() && value[0].is_array()) {
    const Json& first = value[0];  // a schedule, a full tensor
    if (first.size() == 2) return {first[1]};
    if (first.size() == 3 && value.size() == 3)
      return {Json{value[0][0], value[1][1], value[2][2]}};
  }
  if (!value.is_number()) return {};
  const double x = value.get<double>();
  std::vector<Json> all;
  for (const double y : {0.0, 1.0, std::round(x), std::stod(std::to_string(x).substr(0, 3))})
    if (y != x) all.emplace_back(y);
  return all;
}

class Shrinker {
 public:
  Shrinker(Json spec, const std::function<bool(const Json&)>& still_fails)
      : spec_(std::move(spec)), still_fails_(still_fails) {}

  Json run() {
    // An orbit needs gravity, so neither could go first.
    Json in_deep_space = spec_;
    in_deep_space.erase("environment");
    in_deep_space.erase("initial");
    take(in_deep_space);
    while (trials_ < kTrials && (leave_out() || simplify())) {
    }
    return spec_;
  }

 private:
  bool take(const Json& candidate) {
    if (++trials_ > kTrials || !still_fails_(candidate)) return false;
    spec_ = candidate;
    return true;
  }

  /// One pass over all places; whether anything could go.
  bool leave_out() {
    bool any = false;
    std::vector<Json::json_pointer> all;
    places(spec_, Json::json_pointer(), all);
    for (auto place = all.begin(); place != all.end(); ++place) {
      if (!spec_.contains(*place) || trials_ >= kTrials) continue;
      // Of the entries of vectors each one is needed, and none is worth a trial.
      if (is_in_list(spec_, *place) && !spec_.at(*place).is_object()) continue;
      any = take(without(spec_, *place)) || any;
    }
    return any;
  }

  bool simplify() {
    bool any = false;
    std::vector<Json::json_pointer> all;
    places(spec_, Json::json_pointer(), all);
    for (const Json::json_pointer& place : all) {
      if (!spec_.contains(place)) continue;
      for (const Json& value : simpler(spec_.at(place))) {
        if (value == spec_.at(place) || trials_ >= kTrials) continue;
        Json candidate = spec_;
        candidate[place] = value;
        if (!take(candidate)) continue;
        any = true;
        break;
      }
    }
    return any;
  }

  Json spec_;
  const std::function<bool(const Json&)>& still_fails_;
  int trials_ = 0;
};

}  // namespace

Json shrink(Json spec, const std::function<bool(const Json&)>& still_fails) {
  return Shrinker(std::move(spec), still_fails).run();
}

}  // namespace twincraft::random_vehicles
