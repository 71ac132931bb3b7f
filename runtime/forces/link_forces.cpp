// See link_forces.h. Tested by tests/components/jet_test.cpp.
#include "runtime/forces/link_forces.h"

#include "runtime/forces/list.h"

namespace twincraft {

using namespace TWINCRAFT_KERNEL;

struct LinkForces::List : ForceList<double> {
  using ForceList<double>::ForceList;
};

LinkForces::LinkForces(const Forces& forces, const Inputs& inputs)
    : forces_(forces), links_(links_of(forces)) {
  const Forces* lane = &forces;
  list_ = std::make_unique<List>(std::span<const Forces* const>(&lane, 1));
  hold(inputs);
}

LinkForces::~LinkForces() = default;

void LinkForces::hold(const Inputs& inputs) { list_->hold(0, forces_, inputs); }

bool LinkForces::acts() const { return list_->acts(); }

Work LinkForces::add(const Place& place, std::span<const LinkPose> poses,
                     std::span<const LinkRate> rates, std::span<Wrench> wrenches) const {
  Work work;
  const Surroundings<double> around{place.time, vec(place.r_BN_N), vec(place.v_BN_N),
                                    mat(place.dcm_NW)};
  const auto motion_of = [&](int link) {
    const auto i = static_cast<std::size_t>(link);
    return LinkMotion<double>{mat(poses[i].dcm_WL), vec(rates[i].omega_LN_W), vec(poses[i].r_LB_W),
                              vec(rates[i].v_LB_W)};
  };
  list_->add(around, motion_of, [&](int link, const Pull<double>& pull) {
    const auto i = static_cast<std::size_t>(link);
    const Vector3d force = eigen(pull.force), torque = eigen(pull.torque);
    wrenches[i].force_W += force;
    wrenches[i].torque_PntB_W += torque + poses[i].r_LB_W.cross(force);
    work.force_W += force;
    work.torque_PntB_W += torque + poses[i].r_LB_W.cross(force);
    work.power += force.dot(rates[i].v_LB_W) + torque.dot(rates[i].omega_LN_W);
  });
  return work;
}

}  // namespace twincraft
