// See replay_data.h. Tested by tests/runtime/html_test.cpp.
#include "runtime/report/page/replay_data.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/report/page/page_series.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

/// A force as it changes: `[[time, x, y, z], ...]`, each until the next.
Json force_json(const Load& load) {
  std::vector<double> times{0.0};
  for (const Schedule& schedule : load.force_L)
    for (const Schedule::Entry& entry : schedule.entries)
      if (std::isfinite(entry.time) && entry.time > 0.0) times.push_back(entry.time);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  Json rows = Json::array();
  for (const double time : times)
    rows.push_back(
        {time, load.force_L[0].at(time), load.force_L[1].at(time), load.force_L[2].at(time)});
  return rows;
}

/// Forces that act at a point, which the MJCF marks with a site of the same name.
Json forces_json(const Model& model) {
  Json forces = Json::array();
  for (const Load& load : model.loads) {
    const auto is_zero = [](const Schedule& schedule) { return schedule.is_zero(); };
    if (!load.r_FL_L || std::all_of(load.force_L.begin(), load.force_L.end(), is_zero)) continue;
    forces.push_back({{"site", load.name},
                      {"is_thruster", load.thruster.has_value()},
                      {"force", force_json(load)}});
  }
  return forces;
}

/// The joints of a row, by the names they have in the MJCF.
Json joint_names(const Model& model) {
  Json names = Json::array();
  for (std::size_t i = 1; i < model.assembly.links.size(); ++i)
    names.push_back(model.assembly.links[i].name);
  return names;
}

/// In the order of the rotors, not of the tree.
Json wheel_names(const Model& model) {
  std::vector<std::string> names(model.assembly.rotors.size());
  for (const TreeWheel& wheel : model.tree.wheels)
    names[static_cast<std::size_t>(wheel.rotor)] = wheel.joint;
  return names;
}

}  // namespace

Json replay_json(const ReportedMember& member) {
  const Model& model = member.bundle.model;
  if (member.bundle.text(kMjcf).empty()) return nullptr;
  Json json{{"joints", joint_names(model)},
            {"wheels", wheel_names(model)},
            {"forces", forces_json(model)},
            {"gravity", model.gravity.mu > 0.0 && model.gravity.bsm != GravityLaw::kNone},
            {"point_mass", model.simulation.translation},
            {"frames", Json::object()}};
  const std::shared_ptr<const PageSeries> series = series_of(member);
  for (std::size_t engine = 0; engine < member.result.engines.size(); ++engine) {
    const Frames& frames = series->frames(engine);
    if (frames.count() > 0) json["frames"][member.result.engines[engine].name] = frames.text();
  }
  return json;
}

}  // namespace twincraft
