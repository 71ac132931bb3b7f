// MuJoCo's C objects with owners, and its process-wide hooks tamed: an error throws, a warning is
// kept for whoever asks. Left alone, MuJoCo waits on stdin, exits, and writes MUJOCO_LOG.TXT.
// Tested by tests/runtime/mujoco_test.cpp.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace twincraft {

struct MujocoModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct MujocoDataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using MujocoModel = std::unique_ptr<mjModel, MujocoModelDeleter>;
using MujocoData = std::unique_ptr<mjData, MujocoDataDeleter>;

/// Load a model from text, never from a file. Any thread may call; loads wait for one another,
/// because MuJoCo keeps the last XML in a global.
/// @throws NumericalFailure with MuJoCo's own words
MujocoModel load_mjcf(const std::string& mjcf);

/// Pictures and markers are for `simulate`; here mj_kinematics would only carry them along.
void hide_pictures(mjModel& model);

/// @pre its pictures are not hidden @throws NumericalFailure when there is no memory for it
MujocoModel copy_of(const mjModel& model);

/// @throws NumericalFailure when there is no memory for it
MujocoData make_data(const mjModel& model);

/// The warnings MuJoCo gave on this thread since the last call, joined by "; ".
std::string take_mujoco_warnings();

}  // namespace twincraft
