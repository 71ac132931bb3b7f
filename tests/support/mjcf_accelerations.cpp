// mjcf_accelerations FILE: the accelerations that MuJoCo 2.2 finds for an MJCF at its keyframe and
// at a few states near it, as JSON, for tests/node to hold against MuJoCo 3.
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "runtime/mujoco/handles.h"

namespace twincraft {
namespace {

std::vector<double> numbers(const double* first, int count) { return {first, first + count}; }

nlohmann::json state(const mjModel& m, mjData& d) {
  mj_forward(&m, &d);
  return {{"qpos", numbers(d.qpos, m.nq)},
          {"qvel", numbers(d.qvel, m.nv)},
          {"ctrl", numbers(d.ctrl, m.nu)},
          {"qacc", numbers(d.qacc, m.nv)}};
}

/// Every coordinate displaced and moving, each differently.
void disturb(const mjModel& m, mjData& d, int seed) {
  for (int i = 0; i < m.nv; ++i) d.qvel[i] += 0.3 * std::sin(1.0 + 2.3 * i + 0.7 * seed);
  mj_integratePos(&m, d.qpos, d.qvel, 0.4);
}

int run(const char* file) {
  std::stringstream mjcf;
  mjcf << std::ifstream(file).rdbuf();
  const MujocoModel m = load_mjcf(mjcf.str());
  const MujocoData d = make_data(*m);
  nlohmann::json states = nlohmann::json::array();
  for (int seed = 0; seed < 4; ++seed) {
    mj_resetDataKeyframe(m.get(), d.get(), 0);
    if (seed > 0) disturb(*m, *d, seed);
    states.push_back(state(*m, *d));
  }
  std::cout << states.dump() << "\n";
  return 0;
}

}  // namespace
}  // namespace twincraft

int main(int argc, char** argv) { return argc == 2 ? twincraft::run(argv[1]) : 2; }
