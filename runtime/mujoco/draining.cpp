// See draining.h.
#include "runtime/mujoco/draining.h"

namespace twincraft {

DrainingBodies::DrainingBodies(const Model& model, const mjModel& loaded) {
  for (const TreeBody& body : model.tree.bodies) {
    if (body.tank < 0) continue;
    const int id = mj_name2id(&loaded, mjOBJ_BODY, body.name.c_str());
    const Vector3d moments = Eigen::Map<const Vector3d>(loaded.body_inertia + 3 * id);
    bodies_.push_back({id, static_cast<std::size_t>(body.tank), loaded.body_mass[id], moments});
  }
}

void DrainingBodies::set_shares(std::span<const double> shares, mjModel& model) const {
  for (const Body& body : bodies_) {
    const double share = shares[body.tank];
    model.body_mass[body.id] = share * body.full_mass;
    Eigen::Map<Vector3d>(model.body_inertia + 3 * body.id) = share * body.full_moments;
  }
}

LeavingSums DrainingBodies::leaving(const mjModel& model, const mjData& data,
                                    const Vector3d& v_BN_W, const BodyCenter& center,
                                    std::span<const double> share_rates) const {
  LeavingSums all;
  for (const Body& body : bodies_) {
    const double share = model.body_mass[body.id] / body.full_mass;
    const LeavingSums one =
        twincraft::leaving(model, data, v_BN_W, center, {body.id, share_rates[body.tank] / share});
    all.kinetic += one.kinetic;
    all.own_kinetic += one.own_kinetic;
    all.momentum += one.momentum;
    all.H_PntC_W += one.H_PntC_W;
  }
  return all;
}

}  // namespace twincraft
