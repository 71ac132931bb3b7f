// See forces.h. Tested by tests/runtime/forces_test.cpp.
#include "runtime/forces/forces.h"

#include <algorithm>
#include <cmath>

#include "runtime/forces/field.h"

namespace twincraft {

using namespace TWINCRAFT_KERNEL;

namespace {

bool is_per_body(GravityLaw law) {
  return law == GravityLaw::kBodyCom || law == GravityLaw::kBodyGradient;
}

}  // namespace

WrenchSums sum_up(std::span<const Wrench> wrenches, std::span<const LinkPose> links,
                  std::span<const LinkRate> rates) {
  WrenchSums sums;
  for (std::size_t i = 0; i < wrenches.size(); ++i) {
    const Wrench& wrench = wrenches[i];
    if (wrench.force_W.isZero(0.0) && wrench.torque_PntB_W.isZero(0.0)) continue;
    const Vector3d& omega = rates[i].omega_LN_W;
    const Vector3d v_B = rates[i].v_LB_W - omega.cross(links[i].r_LB_W);  // of its point at B
    sums.all.force_W += wrench.force_W;
    sums.all.torque_PntB_W += wrench.torque_PntB_W;
    sums.power += wrench.force_W.dot(v_B) + wrench.torque_PntB_W.dot(omega);
  }
  return sums;
}

ForceModel::ForceModel(const Model& model, GravityLaw law,
                       const std::vector<std::vector<MassElement>>& elements, FieldFrame frame)
    : mu_(model.gravity.mu),
      law_(law),
      frame_(frame),
      elements_(elements, [](const MassElement& element) { return element.mass > 0.0; }),
      loads_(model.loads) {
  for (const Element& e : elements_) mass_ += e.mass;
  const bool all_at_hub_origin =
      std::all_of(elements_.begin(), elements_.end(),
                  [](const Element& e) { return e.link == 0 && e.r_EL_L().isZero(0.0); });
  gravity_acts_ = law == GravityLaw::kBodyGradient ||
                  (law == GravityLaw::kBodyCom && !all_at_hub_origin) ||
                  (law != GravityLaw::kNone && frame == FieldFrame::kInertial);
  needs_elements_ =
      law != GravityLaw::kNone ||
      std::any_of(loads_.begin(), loads_.end(), [](const Load& load) { return !load.r_FL_L; });
  hold(inputs_at(model, 0.0));
}

void ForceModel::hold(const Inputs& inputs) {
  acting_loads_.clear();
  acting_loads_.reserve(loads_.size());  // for all, so that later calls do not allocate
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const Load& load = loads_[i];
    const Vector3d force_L = inputs.vector(inputs.layout.force(static_cast<int>(i)));
    const Vector3d torque_L = inputs.vector(inputs.layout.torque(static_cast<int>(i)));
    const bool pushes = !force_L.isZero(0.0);
    if (!pushes && torque_L.isZero(0.0)) continue;
    acting_loads_.push_back({load.link, pushes, !load.r_FL_L.has_value(), force_L, torque_L,
                             load.r_FL_L.value_or(Vector3d::Zero())});
  }
  acts_on_hub_alone_ = !gravity_acts_ && !falls_as_a_whole() &&
                       std::ranges::all_of(acting_loads_, [](const HeldLoad& load) {
                         return load.link == 0 && !(load.pushes && load.at_system_com);
                       });
}

void ForceModel::set_shares(std::span<const double> shares) {
  if (!needs_elements_) return;
  elements_.set_shares(shares);
  mass_ = 0.0;
  for (const Element& e : elements_) mass_ += e.mass;
}

Vector3d ForceModel::center_of_mass(std::span<const LinkPose> links) const {
  Vector3d moment = Vector3d::Zero();
  for (const Element& e : elements_) moment += e.mass * place_of(e, links);
  return moment / mass_;
}

Vector3d ForceModel::place_of(const Element& e, std::span<const LinkPose> links) {
  return links[e.link].r_LB_W + links[e.link].dcm_WL * e.r_EL_L();
}

void ForceModel::apply_gravity(const Vector3d& r_BN_W, std::span<const LinkPose> links,
                               std::span<const LinkRate> rates, std::span<Wrench> wrenches,
                               Work& work) const {
  const bool uniform = law_ == GravityLaw::kSystemCom;
  const Vector3d g_system =
      uniform ? point_gravity(mu_, r_BN_W + center_of_mass(links)) : Vector3d::Zero();
  const Field<double> field(mu_, vec(r_BN_W), law_ == GravityLaw::kBodyGradient);
  for (const Element& e : elements_) {
    Wrench& wrench = wrenches[e.link];
    const Vector3d r_EB_W = place_of(e, links);
    Vector3d g = g_system;
    if (!uniform) {
      g = frame_ == FieldFrame::kFalling ? eigen(field.difference(vec(r_EB_W)))
                                         : point_gravity(mu_, r_BN_W + r_EB_W);
    }
    const Vector3d force_W = e.mass * g;
    wrench.force_W += force_W;
    wrench.torque_PntB_W += r_EB_W.cross(force_W);
    if (!field.has_gradient) continue;
    const Vector3d torque_W =
        eigen(field.gradient_torque(vec(r_EB_W), e.I.turned(mat(links[e.link].dcm_WL))));
    wrench.torque_PntB_W += torque_W;
    if (!rates.empty()) work.power += torque_W.dot(rates[e.link].omega_LN_W);
  }
}

/// A load as it acts, in working axes.
ForceModel::ActingLoad ForceModel::acting(const HeldLoad& load,
                                          std::span<const LinkPose> links) const {
  const LinkPose& pose = links[static_cast<std::size_t>(load.link)];
  ActingLoad acting{pose.dcm_WL * load.torque_L, Vector3d::Zero(), Vector3d::Zero()};
  if (!load.pushes) return acting;
  acting.force_W = pose.dcm_WL * load.force_L;
  acting.r_FB_W = load.at_system_com ? center_of_mass(links)
                                     : Vector3d(pose.r_LB_W + pose.dcm_WL * load.r_FL_L);
  return acting;
}

void ForceModel::apply_loads(std::span<const LinkPose> links, std::span<Wrench> wrenches) const {
  for (const HeldLoad& load : acting_loads_) {
    const ActingLoad now = acting(load, links);
    Wrench& wrench = wrenches[static_cast<std::size_t>(load.link)];
    wrench.torque_PntB_W += now.torque_W;
    if (!load.pushes) continue;
    wrench.force_W += now.force_W;
    wrench.torque_PntB_W += now.r_FB_W.cross(now.force_W);
  }
}

Work ForceModel::work_of_loads(std::span<const LinkPose> links,
                               std::span<const LinkRate> rates) const {
  Work work;
  for (const HeldLoad& load : acting_loads_) {
    const auto link = static_cast<std::size_t>(load.link);
    const ActingLoad now = acting(load, links);
    const LinkRate& rate = rates[link];
    work.force_W += now.force_W;
    work.torque_PntB_W += now.torque_W + now.r_FB_W.cross(now.force_W);
    work.power +=
        now.torque_W.dot(rate.omega_LN_W) +
        now.force_W.dot(rate.v_LB_W + rate.omega_LN_W.cross(now.r_FB_W - links[link].r_LB_W));
  }
  return work;
}

Work ForceModel::apply(const Vector3d& r_BN_W, std::span<const LinkPose> links,
                       std::span<const LinkRate> rates, std::span<Wrench> wrenches) const {
  Work work;
  if (is_idle()) return work;
  std::ranges::fill(wrenches, Wrench{});
  if (gravity_acts_) apply_gravity(r_BN_W, links, rates, wrenches, work);
  apply_loads(links, wrenches);
  if (!rates.empty()) work += work_of_loads(links, rates);
  return work;
}

Vector3d ForceModel::fall(const Vector3d& r_BN_N, const Matrix3d& dcm_NW,
                          std::span<const LinkPose> links) const {
  if (law_ == GravityLaw::kNone || frame_ == FieldFrame::kInertial) return Vector3d::Zero();
  if (is_per_body(law_)) return point_gravity(mu_, r_BN_N);
  return point_gravity(mu_, r_BN_N + dcm_NW * center_of_mass(links));
}

double ForceModel::potential(const Vector3d& r_BN_W, std::span<const LinkPose> links) const {
  if (law_ == GravityLaw::kNone) return 0.0;
  if (!is_per_body(law_)) return -mu_ * mass_ / (r_BN_W + center_of_mass(links)).norm();
  double sum = 0.0;
  for (const Element& e : elements_) sum -= mu_ * e.mass / (r_BN_W + place_of(e, links)).norm();
  return sum;
}

// The derivative of potential() at fixed places: U = -sum mu m/|r|, or -mu M/|r_C| with r_C the
// mean of the places weighted by mass.
double ForceModel::potential_rate(const Vector3d& r_BN_W, std::span<const LinkPose> links,
                                  std::span<const double> share_rates) const {
  if (law_ == GravityLaw::kNone) return 0.0;
  const Vector3d r_CN_W = r_BN_W + center_of_mass(links);
  double sum = 0.0;
  for (const Element& e : elements_) {
    if (e.tank < 0) continue;
    const double mass_rate = e.full_mass * share_rates[static_cast<std::size_t>(e.tank)];
    const Vector3d r_EN_W = r_BN_W + place_of(e, links);
    sum +=
        is_per_body(law_)
            ? -mu_ * mass_rate / r_EN_W.norm()
            : -mass_rate * (mu_ / r_CN_W.norm() + point_gravity(mu_, r_CN_W).dot(r_EN_W - r_CN_W));
  }
  return sum;
}

}  // namespace twincraft
