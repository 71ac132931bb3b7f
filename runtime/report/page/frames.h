// Poses for the replay, evenly over the run, chosen while its samples come.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compiler/ir/model.h"
#include "runtime/engine/observation.h"

namespace twincraft {

/// A row per frame: time, hub position, system CoM, quaternion, joints, wheel angles.
class Frames {
 public:
  explicit Frames(const Model& model);

  void take(const Observation& sample);

  std::size_t count() const;  // of the frames that are shown
  /// Rows one after another, base64 of little-endian doubles.
  std::string text() const;

 private:
  void turn_wheels(const Observation& sample);
  void halve();
  std::size_t kept() const { return rows_.size() / width_; }

  std::size_t width_, most_;  // numbers in a row; frames that may be shown
  std::size_t stride_ = 1;    // every so manyeth sample is kept
  std::size_t samples_ = 0;
  std::vector<double> rows_;  // kept, from the first on
  std::vector<double> last_;  // the row of the latest sample
  double last_time_ = 0.0;    // [s]
  std::vector<double> wheel_angle_, wheel_rate_;
};

}  // namespace twincraft
