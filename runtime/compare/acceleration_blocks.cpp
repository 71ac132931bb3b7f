// See acceleration_blocks.h.
#include "runtime/compare/acceleration_blocks.h"

#include <cmath>
#include <limits>

namespace twincraft {

double gyration_radius(const Eigen::MatrixXd& M) {
  return std::sqrt(M.block<3, 3>(3, 3).trace() / M(0, 0));
}

std::vector<AccelerationBlock> acceleration_blocks(const Model& model, const Eigen::MatrixXd& M) {
  if (model.simulation.translation) {
    // Nothing turns, so nothing cancels, and any acceleration is worth comparing with.
    constexpr double kAny = std::numeric_limits<double>::min();
    return {{"acceleration", {"x", "y", "z"}, {0, 1, 2}, kAny}};
  }
  const double arm = gyration_radius(M);
  // Rates drawn are about 0.1 rad/s, so this is what turning alone makes of any coordinate.
  constexpr double kCentrifugal = 0.01;  // [rad/s^2]
  AccelerationBlock linear{
      "hub linear acceleration", {"x", "y", "z"}, {0, 1, 2}, kCentrifugal * arm};
  AccelerationBlock angular{"hub angular acceleration", {"x", "y", "z"}, {3, 4, 5}, kCentrifugal};
  AccelerationBlock hinges{"hinge accelerations", {}, {}, kCentrifugal};
  AccelerationBlock slides{"slide accelerations", {}, {}, kCentrifugal * arm};
  AccelerationBlock wheels{"wheel accelerations", {}, {}, kCentrifugal};
  const auto& links = model.assembly.links;
  for (std::size_t i = 1; i < links.size(); ++i) {
    AccelerationBlock& block = links[i].joint.kind == JointKind::kSlide ? slides : hinges;
    block.names.push_back(links[i].name);
    block.entries.push_back(6 + static_cast<int>(i) - 1);
  }
  for (const Rotor& rotor : model.assembly.rotors) {
    wheels.entries.push_back(6 + static_cast<int>(links.size() - 1 + wheels.names.size()));
    wheels.names.push_back(rotor.name);
  }
  std::vector<AccelerationBlock> blocks{linear, angular, hinges, slides, wheels};
  std::erase_if(blocks, [](const AccelerationBlock& block) { return block.entries.empty(); });
  return blocks;
}

}  // namespace twincraft
