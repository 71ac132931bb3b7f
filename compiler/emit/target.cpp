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

Printed print_mjcf(const Model& model, const Json&) {
  if (!model.mujoco_refusal.empty()) return {.refusal = model.mujoco_refusal};
  return {.text = emit_mjcf(model)};
}

constexpr Target kTargets[] = {
    {kMjcf, ".xml", "the bodies, for MuJoCo", print_mjcf},
    {kAssemblyJson, ".bsm.json", "the assembly of the analytic engine",
     [](const Model& model, const Json&) { return Printed{emit_bsm(model)}; }},
    {kResolved, ".resolved.yaml", "the spec with every default, in SI",
     [](const Model&, const Json& resolved) { return Printed{emit_resolved(resolved)}; }},
    {"dot", ".dot", "both halves as a Graphviz drawing",
     [](const Model& model, const Json&) { return Printed{emit_dot(model)}; }},
    {kBasilisk, ".basilisk.py", "a script that flies it in Basilisk", emit_basilisk},
};

}  // namespace

std::span<const Target> targets() { return kTargets; }

const Target* find_target(std::string_view name) {
  const auto found = std::ranges::find(kTargets, name, &Target::name);
  return found == std::ranges::end(kTargets) ? nullptr : &*found;
}

}  // namespace twincraft
