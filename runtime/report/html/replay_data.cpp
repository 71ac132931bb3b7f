// See replay_data.h. Tested by tests/runtime/html_test.cpp.
#include "runtime/report/html/replay_data.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/report/html/base64.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostFrames = 2000;
constexpr std::size_t kMostNumbers = 200'000;  // 2.1 MB

/// A row per frame: time, hub position, system CoM, quaternion, joints, wheel angles.
class Frames {
 public:
  Frames(const Model& model, const Trajectory& trajectory);
  std::string text() const { return base64(values_); }
  std::size_t count() const { return count_; }

 private:
  void add(const Observation& sample, const std::vector<double>& wheel_angle);

  std::size_t count_ = 0;
  std::vector<double> values_;
};

std::size_t width_of(const Model& model) {
  return 11 + model.assembly.links.size() - 1 + model.assembly.rotors.size();
}

Frames::Frames(const Model& model, const Trajectory& trajectory) {
  const std::vector<Observation>& samples = trajectory.samples;
  if (samples.empty()) return;
  const std::size_t most =
      std::clamp<std::size_t>(kMostNumbers / 2 / width_of(model), 50, kMostFrames);
  const std::size_t wanted = std::min(samples.size(), most);
  // No engine integrates the angle of a balanced wheel: between samples its rate is taken to be
  // linear, which is good enough to look at.
  std::vector<double> wheel_angle(samples.front().wheel_rate.size(), 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0)
      for (std::size_t w = 0; w < wheel_angle.size(); ++w)
        wheel_angle[w] += 0.5 * (samples[i].time - samples[i - 1].time) *
                          (samples[i].wheel_rate[w] + samples[i - 1].wheel_rate[w]);
    const std::size_t due = wanted == 1 ? 0 : count_ * (samples.size() - 1) / (wanted - 1);
    if (i == due && count_ < wanted) add(samples[i], wheel_angle);
  }
}

void Frames::add(const Observation& sample, const std::vector<double>& wheel_angle) {
  const auto append = [this](const auto& values) {
    values_.insert(values_.end(), values.begin(), values.end());
  };
  values_.push_back(sample.time);
  append(sample.r_BN_N);
  append(sample.r_CN_N);
  append(std::array{sample.q_BN.w(), sample.q_BN.x(), sample.q_BN.y(), sample.q_BN.z()});
  append(sample.joint_position);
  append(wheel_angle);
  ++count_;
}

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
    forces.push_back(
        {{"site", load.name}, {"is_thruster", load.is_thruster}, {"force", force_json(load)}});
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
  if (member.bundle.mjcf.empty()) return nullptr;
  Json json{{"joints", joint_names(model)},
            {"wheels", wheel_names(model)},
            {"forces", forces_json(model)},
            {"gravity", model.gravity.mu > 0.0 && model.gravity.bsm != GravityLaw::kNone},
            {"point_mass", model.simulation.translation},
            {"frames", Json::object()}};
  for (const EngineRun& run : member.result.engines) {
    const Frames frames(model, run.trajectory);
    if (frames.count() > 0) json["frames"][run.name] = frames.text();
  }
  return json;
}

}  // namespace twincraft
