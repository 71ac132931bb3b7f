// See jet.h.
#include "runtime/forces/jet.h"

#include <algorithm>
#include <set>

namespace twincraft {
namespace {

/// k omega in working axes.
Vector3d spin_of(const Matrix3d& k_L, const Matrix3d& dcm_WL, const Vector3d& omega_W) {
  return dcm_WL * (k_L * (dcm_WL.transpose() * omega_W));
}

void push(const Vector3d& force, const Vector3d& r_B, Wrench& wrench) {
  wrench.force_W += force;
  wrench.torque_PntB_W += r_B.cross(force);
}

}  // namespace

JetModel::JetModel(const Model& model) {
  std::set<int> tanks, links;
  for (const Nozzle& nozzle : model.nozzles) {
    nozzles_.push_back({nozzle, 0.0});
    tanks.insert(nozzle.tank);
    links.insert(nozzle.link);
  }
  for (std::size_t i = 0; i < model.assembly.links.size(); ++i) {
    for (const MassElement& e : model.assembly.links[i].elements) {
      if (!tanks.contains(e.tank)) continue;
      const int link = static_cast<int>(i);
      const double content = model.tanks[static_cast<std::size_t>(e.tank)].content;
      sources_.push_back({e.tank, link, e.mass / content, e.r_EL_L, e.I_PntE_L / e.mass});
      links.insert(link);
    }
  }
  links_.assign(links.begin(), links.end());
  hold(inputs_at(model, 0.0));
}

void JetModel::hold(const Inputs& inputs) {
  acts_ = false;
  for (std::size_t i = 0; i < nozzles_.size(); ++i) {
    nozzles_[i].flow = inputs[inputs.layout.nozzle_flow(static_cast<int>(i))];
    acts_ = acts_ || nozzles_[i].flow > 0.0;
  }
}

JetModel::Point JetModel::point_of(int link, const Vector3d& r_L, std::span<const LinkPose> links,
                                   std::span<const LinkRate> rates) {
  const auto i = static_cast<std::size_t>(link);
  const Vector3d r_W = links[i].dcm_WL * r_L;
  return {links[i].r_LB_W + r_W, rates[i].v_LB_W + rates[i].omega_LN_W.cross(r_W)};
}

/// @param each  takes nozzle, source and the rate between them [kg/s]
template <class Each>
void JetModel::for_each_stream(const Each& each) const {
  for (const Outlet& outlet : nozzles_) {
    if (!(outlet.flow > 0.0)) continue;
    for (const Source& source : sources_) {
      if (source.tank == outlet.nozzle.tank) each(outlet.nozzle, source, source.part * outlet.flow);
    }
  }
}

Work JetModel::add(std::span<const LinkPose> links, std::span<const LinkRate> rates,
                   std::span<Wrench> wrenches) const {
  Work work;
  for_each_stream([&](const Nozzle& nozzle, const Source& source, double mdot) {
    const auto from = static_cast<std::size_t>(source.link);
    const Point P = point_of(nozzle.link, nozzle.r_PL_L, links, rates);
    const Point E = point_of(source.link, source.r_EL_L, links, rates);
    const Vector3d force = -mdot * (P.v - E.v);
    push(force, P.r_B, wrenches[static_cast<std::size_t>(nozzle.link)]);
    push(force, E.r_B, wrenches[from]);
    const Vector3d& omega = rates[from].omega_LN_W;
    const Vector3d torque = mdot * spin_of(source.k_L, links[from].dcm_WL, omega);
    wrenches[from].torque_PntB_W += torque;
    work.power += force.dot(P.v + E.v) + torque.dot(omega);
    work.force_W += 2.0 * force;
  });
  return work;
}

}  // namespace twincraft
