// The engines by name. Whoever says which engine something is of takes the word from here.
// Tested by tests/architecture/names_test.cpp.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace twincraft {

enum class EngineKind { kBsm, kMujoco };

struct EngineName {
  EngineKind kind;
  std::string_view key;    // in specs, flags, files and reports
  std::string_view label;  // for people
};

/// In the order of every pair of them.
inline constexpr std::array<EngineName, 2> kEngines{{
    {EngineKind::kBsm, "bsm", "BSM"},
    {EngineKind::kMujoco, "mujoco", "MuJoCo"},
}};

constexpr const EngineName& name_of(EngineKind kind) {
  return kEngines[static_cast<std::size_t>(kind)];
}
inline constexpr std::string_view kBsmKey = name_of(EngineKind::kBsm).key;
inline constexpr std::string_view kMujocoKey = name_of(EngineKind::kMujoco).key;

/// @pre `key` is one of kEngines
constexpr EngineKind engine_of(std::string_view key) {
  return key == kBsmKey ? EngineKind::kBsm : EngineKind::kMujoco;
}
inline std::string engine_label(std::string_view key) {
  return std::string(name_of(engine_of(key)).label);
}

}  // namespace twincraft
