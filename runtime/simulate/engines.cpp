// See engines.h.
#include "runtime/simulate/engines.h"

#include "runtime/bsm/engine.h"
#include "runtime/mujoco/engine.h"

namespace twincraft {
namespace {

struct Maker {
  std::unique_ptr<Engine> (*make)(const Bundle&, bsm::InstructionSet);
  std::string (*refuses)(const Model&);
};

// In the order of kEngines.
constexpr std::array<Maker, kEngines.size()> kMakers{{
    {[](const Bundle& bundle, bsm::InstructionSet instructions) {
       return make_bsm_engine(bundle.model, instructions);
     },
     [](const Model&) { return std::string(); }},
    {[](const Bundle& bundle, bsm::InstructionSet) {
       return make_mujoco_engine(bundle.model, bundle.text(kMjcf));
     },
     [](const Model& model) { return model.mujoco_refusal; }},
}};

const Maker& maker_of(EngineKind kind) { return kMakers.at(static_cast<std::size_t>(kind)); }

}  // namespace

std::unique_ptr<Engine> make_engine(EngineKind kind, const Bundle& bundle,
                                    bsm::InstructionSet instructions) {
  return maker_of(kind).make(bundle, instructions);
}

std::string refusal_of(EngineKind kind, const Model& model) {
  return maker_of(kind).refuses(model);
}

}  // namespace twincraft
