#include "compiler/emit/target.h"

#include <algorithm>

#include "compiler/emit/assembly_json.h"
#include "compiler/emit/basilisk.h"
#include "compiler/emit/dot.h"
#include "compiler/emit/mjcf.h"
#include "compiler/emit/resolved.h"
#include "compiler/ir/bundle.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

std::string fits_always(const Model&) { return {}; }
std::string mujoco_refusal(const Model& model) { return model.mujoco_refusal; }
std::vector<Remark> nothing(const Model&) { return {}; }

constexpr Target kTargets[] = {
    {kMjcf, ".xml", "the bodies, for MuJoCo",
     [](const Model& model, const Json&) { return emit_mjcf(model); }, mujoco_refusal, nothing},
    {kAssemblyJson, ".bsm.json", "the assembly of the analytic engine",
     [](const Model& model, const Json&) { return emit_bsm(model); }, fits_always, nothing},
    {kResolved, ".resolved.yaml", "the spec with every default, in SI",
     [](const Model&, const Json& resolved) { return emit_resolved(resolved); }, fits_always,
     nothing},
    {"dot", ".dot", "both halves as a Graphviz drawing",
     [](const Model& model, const Json&) { return emit_dot(model); }, fits_always, nothing},
    {kBasilisk, ".basilisk.py", "a script that flies it in Basilisk", emit_basilisk,
     basilisk_refusal, basilisk_remarks},
};

}  // namespace

std::span<const Target> targets() { return kTargets; }

const Target* find_target(std::string_view name) {
  const auto found = std::ranges::find(kTargets, name, &Target::name);
  return found == std::ranges::end(kTargets) ? nullptr : &*found;
}

}  // namespace twincraft
