// See jet_kernel.h.
#include "runtime/bsm/jet_kernel.h"

#include <utility>

#include "runtime/bsm/motion.h"
#include "runtime/engine/state.h"

namespace twincraft::bsm {
namespace {

/// The links whose motion decides that of `links`, parents before children; not the hub.
std::vector<std::size_t> with_ancestors(const Tree& tree, const std::vector<int>& links) {
  std::vector<bool> is_needed(tree.links.size(), false);
  for (int link : links) {
    for (; link > 0; link = tree.links[static_cast<std::size_t>(link)].parent)
      is_needed[static_cast<std::size_t>(link)] = true;
  }
  std::vector<std::size_t> needed;
  for (std::size_t i = 1; i < is_needed.size(); ++i)
    if (is_needed[i]) needed.push_back(i);
  return needed;
}

class JetKernel final : public Kernel {
 public:
  JetKernel(std::unique_ptr<Kernel> inner, const Plan& plan, const JetModel& jets)
      : inner_(std::move(inner)),
        plan_(plan),
        jets_(jets),
        layout_{plan.chart, plan.joints(), plan.rotors()},
        moving_(with_ancestors(plan.tree, jets.links())),
        motion_(at_rest(plan.tree)),
        wrenches_(plan.tree.links.size()) {}

  std::size_t lanes() const override { return 1; }
  void set_masses(std::span<const Plan* const> plans) override { inner_->set_masses(plans); }
  void hold(std::span<const Plan* const> plans, std::span<const HeldInputs* const> held) override {
    held_ = pushed_ = *held.front();
    inner_->hold(plans, held);
  }
  void derivative(const double* state, double* rate) override {
    if (jets_.acts()) push(state);
    inner_->derivative(state, rate);
  }
  void finish_step(double* state) const override { inner_->finish_step(state); }
  void hub_equation(std::span<double, 42> equation) const override {
    inner_->hub_equation(equation);
  }

 private:
  /// Hold what the jets do at this state, beside what is held anyway.
  void push(const double* state) {
    const auto joints = static_cast<std::size_t>(layout_.joints);
    const std::span<const double> q(state + layout_.joint(), joints);
    const std::span<const double> q_dot(state + layout_.joint_rate(), joints);
    motion_.rates.front().omega_LN_W = Vector3d::Map(state + layout_.rate());
    for (const std::size_t link : moving_) move_link(plan_.tree, link, q, q_dot, motion_);
    for (const int link : jets_.links()) wrenches_[static_cast<std::size_t>(link)] = Wrench{};
    jets_.add(motion_.poses, motion_.rates, wrenches_);
    for (const int link : jets_.links()) {
      const auto i = static_cast<std::size_t>(link);
      const LinkPose& pose = motion_.poses[i];
      const Wrench& jet = wrenches_[i];
      const Vector3d torque_PntL_W = jet.torque_PntB_W - pose.r_LB_W.cross(jet.force_W);
      pushed_.force_L[i] = held_.force_L[i] + pose.dcm_WL.transpose() * jet.force_W;
      pushed_.torque_L[i] = held_.torque_L[i] + pose.dcm_WL.transpose() * torque_PntL_W;
    }
    const Plan* plan = &plan_;
    const HeldInputs* pushed = &pushed_;
    inner_->hold({&plan, 1}, {&pushed, 1});
  }

  std::unique_ptr<Kernel> inner_;
  const Plan& plan_;
  const JetModel& jets_;
  StateLayout layout_;
  std::vector<std::size_t> moving_;
  Motion motion_;
  std::vector<Wrench> wrenches_;  // those of jets_.links() are meant
  HeldInputs held_, pushed_;
};

}  // namespace

std::unique_ptr<Kernel> with_jets(std::unique_ptr<Kernel> inner, const Plan& plan,
                                  const JetModel& jets) {
  return std::make_unique<JetKernel>(std::move(inner), plan, jets);
}

}  // namespace twincraft::bsm
