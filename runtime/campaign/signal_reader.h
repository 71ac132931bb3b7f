// One number of every sample of a run, by the name that a campaign gives it.
#pragma once

#include <string>
#include <string_view>

#include "runtime/engine/observation.h"

namespace twincraft {

class SignalReader {
 public:
  /// @param name  a number (`omega_BN_B.x`, `wing_p.1.position`) or a vector (`omega_BN_B`) of
  ///              outputs_of(model)
  /// @throws std::invalid_argument  there is no such output
  SignalReader(const Model& model, std::string_view name);

  /// SI. Of a vector the Euclidean norm.
  double operator()(const Observation& seen) const;
  const std::string& unit() const { return output_.unit; }

 private:
  OutputSignal output_;
  std::size_t first_ = 0, count_ = 1;  // components
};

}  // namespace twincraft
