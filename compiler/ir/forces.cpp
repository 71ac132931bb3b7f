// See forces.h.
#include "compiler/ir/forces.h"

#include <set>

namespace twincraft {

Forces forces_of(const Model& model) {
  Forces forces;
  for (std::size_t n = 0; n < model.nozzles.size(); ++n) {
    const Nozzle& nozzle = model.nozzles[n];
    const double content = model.tanks[static_cast<std::size_t>(nozzle.tank)].content;
    for (std::size_t i = 0; i < model.assembly.links.size(); ++i)
      for (const MassElement& e : model.assembly.links[i].elements)
        if (e.tank == nozzle.tank)
          forces.streams.push_back({static_cast<int>(n), e.mass / content, nozzle.link,
                                    static_cast<int>(i), nozzle.r_PL_L, e.r_EL_L,
                                    e.I_PntE_L / e.mass});
  }
  return forces;
}

std::vector<int> links_of(const Forces& forces) {
  std::set<int> links;
  for (const Stream& stream : forces.streams)
    for (const int link : stream.links()) links.insert(link);
  return {links.begin(), links.end()};
}

}  // namespace twincraft
