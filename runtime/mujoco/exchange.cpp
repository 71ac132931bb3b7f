// See exchange.h.
#include "runtime/mujoco/exchange.h"

#include <fmt/format.h>

namespace twincraft {

Exchange::Exchange(const Assembly& assembly, const TreeMap& map)
    : layout_{.chart = AttitudeChart::kQuaternion,
              .joints = static_cast<int>(assembly.links.size()) - 1,
              .wheels = static_cast<int>(assembly.rotors.size())},
      map_(map) {
  for (std::size_t i = 1; i < assembly.links.size(); ++i)
    joint_names_.push_back(assembly.links[i].name);
  for (const Rotor& rotor : assembly.rotors) wheel_names_.push_back(rotor.name);
}

std::string Exchange::name(int index) const {
  if (index < StateLayout::velocity()) return "hub position";
  if (index < StateLayout::attitude()) return "hub velocity";
  if (index < layout_.rate()) return "hub attitude";
  if (index < layout_.joint()) return "hub rate";
  const auto joint = [this](int i) {
    return fmt::format("`{}`", joint_names_.at(static_cast<std::size_t>(i)));
  };
  if (index < layout_.joint_rate()) return joint(index - layout_.joint());
  if (index < layout_.wheel()) return "rate of " + joint(index - layout_.joint_rate());
  const auto wheel = static_cast<std::size_t>(index - layout_.wheel());
  return fmt::format("rate of `{}`", wheel_names_.at(wheel));
}

}  // namespace twincraft
