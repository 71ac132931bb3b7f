// Random choices that are the same on every machine: the bits are the standard's, the mapping to
// numbers is ours, because <random>'s distributions differ between libraries.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "compiler/ir/mass.h"

namespace twincraft::random_vehicles {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : bits_(seed) {}

  double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }  // [0, 1)
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Sizes of things: as often between 1 and 10 as between 10 and 100.
  double size(double low, double high) { return low * std::pow(high / low, unit()); }
  /// 0 to `last`, each as often.
  int integer(int last) { return static_cast<int>(unit() * (last + 1)); }
  bool chance(double probability) { return unit() < probability; }
  template <class T>
  T one_of(const std::vector<T>& choices) {
    return choices[static_cast<std::size_t>(integer(static_cast<int>(choices.size()) - 1))];
  }

  Vector3d vector(double half) {
    return {between(-half, half), between(-half, half), between(-half, half)};
  }
  Vector3d direction() {
    while (true) {
      const Vector3d v = vector(1.0);
      if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
    }
  }
  Quaterniond rotation() { return Quaterniond(Eigen::AngleAxisd(between(-3.0, 3.0), direction())); }

 private:
  std::mt19937_64 bits_;
};

}  // namespace twincraft::random_vehicles
