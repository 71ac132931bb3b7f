// Decides which of MuJoCo's stages see a state, in which frame, and with which forces.
//
// Only the stages that matter are called: no contacts, constraints, sensors or actuation; motor
// torques and joint efforts go straight into the force vector. In the co-moving frame MuJoCo sees
// the hub's origin at rest at zero and the hub's axes along the world's: accelerations do not
// depend on a common velocity or attitude, and two kinds of rounding are gone. Kilometres per
// second leave m v^2 in MuJoCo's bias forces; a fast wheel leaves Js Omega^2 there unless its axis
// lies along a world axis, as those of most wheels lie along a hub axis. Other wheels get a tensor
// without axes, see round_wheels.h. A wheel is always handed over at angle zero: it is balanced, so
// its angle changes neither mass nor inertia, and none is integrated.
// Tested by tests/runtime/mujoco_test.cpp.
#include "runtime/mujoco/engine.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "runtime/forces/forces.h"
#include "runtime/forces/link_forces.h"
#include "runtime/forces/propellant_ledger.h"
#include "runtime/mujoco/handles.h"
#include "runtime/mujoco/held_model.h"
#include "runtime/mujoco/inertia_terms.h"
#include "runtime/mujoco/machine.h"
#include "runtime/mujoco/motion_sums.h"
#include "runtime/mujoco/point_mass_engine.h"
#include "runtime/mujoco/round_wheels.h"
#include "runtime/mujoco/tree_map.h"
#include "runtime/mujoco/wrenches.h"

namespace twincraft {
namespace {

using Input = Eigen::Map<const Vector3d>;

/// Body to N components; a quaternion within a step is read as if normalised.
Matrix3d dcm_of(const double* q) {
  return Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

class MujocoEngine final : public Engine {
 public:
  explicit MujocoEngine(std::shared_ptr<const MujocoMachine> machine);

  std::string_view name() const override { return kMujocoKey; }
  const StateLayout& layout() const override { return machine_->exchange.layout(); }
  bool may_use_avx2() const override { return __builtin_cpu_supports("avx2") != 0; }
  std::unique_ptr<Engine> another() const override {
    return std::make_unique<MujocoEngine>(machine_);
  }
  Eigen::VectorXd initial_state() const override { return pack(machine_->initial, layout()); }
  void hold(const Inputs& inputs) override;
  void derivative(double time, std::span<const double> state, std::span<double> rate,
                  BookRates* books) override;
  void finish_step(std::span<double> state) override;
  void observe(double time, std::span<const double> state, Observation& seen) override;
  Eigen::MatrixXd mass_matrix(std::span<const double> state) override;
  HeldMachine held() const override { return held_by(*machine_->loaded, machine_->map); }
  RoundingTerms rounding_terms(std::span<const double> state) override;

 private:
  /// What was found of forces; the wrenches are in wrenches_.
  struct Found {
    Vector3d fall_N = Vector3d::Zero();  // [m/s^2] the common acceleration of the falling frame
    Work work;                           // when it was asked for
  };

  void drain(double time);
  BookRates book_rates(std::span<const double> state, const Matrix3d& dcm_NW,
                       const Found& found) const;
  BookRates centred_book_rates(double time, std::span<const double> state);
  void add_leaving(const Vector3d& r_BN_W, const Vector3d& v_BN_W, const Matrix3d& dcm_NW,
                   const BodyCenter& center, BookRates& rates) const;
  [[noreturn]] void fail(std::span<const double> state, std::span<const double> rate);
  void move_to(std::span<const double> state);
  void gather_poses();
  void gather_rates(std::span<const int> links);
  /// Into held_: nothing but these acts on the links until the next hold().
  void hold_hub_loads();
  Found find_forces(double time, std::span<const double> state, const Matrix3d& dcm_NW,
                    bool with_work);
  /// Some force does, on some link.
  bool acts() const { return !forces_.is_idle() || link_forces_.acts(); }
  double joint_power() const;
  std::vector<int> dof_order() const;

  std::shared_ptr<const MujocoMachine> machine_;
  MujocoModel own_model_;  // see MujocoMachine::model_to_drain
  const mjModel* model_;   // that one, or the shared one
  MujocoData data_;
  PropellantLedger propellant_;
  double drained_to_ = 0.0;  // [s] the time the masses are of; NaN: of none
  double held_since_ = 0.0;  // [s]
  WrenchProjector projector_;
  ForceModel forces_;
  LinkForces link_forces_;
  bool holds_all_loads_ = false;  // see hold_hub_loads
  std::vector<double> held_;      // held efforts, motor torques and hub loads, per MuJoCo dof
  std::vector<double> applied_;   // inputs and projected wrenches
  std::vector<LinkPose> poses_;
  std::vector<Wrench> wrenches_;
  std::vector<LinkRate> link_rates_;
  std::vector<int> all_links_;
};

MujocoEngine::MujocoEngine(std::shared_ptr<const MujocoMachine> machine)
    : machine_(std::move(machine)),
      own_model_(machine_->model_to_drain()),
      model_(own_model_ ? own_model_.get() : machine_->loaded.get()),
      data_(make_data(*model_)),
      propellant_(machine_->propellant),
      projector_(*model_, machine_->map),
      forces_(machine_->forces),
      link_forces_(machine_->link_forces, machine_->start),
      held_(static_cast<std::size_t>(model_->nv)),
      applied_(held_.size()),
      poses_(machine_->map.link_body.size()),
      wrenches_(poses_.size()),
      link_rates_(poses_.size()),
      all_links_(poses_.size()) {
  std::iota(all_links_.begin(), all_links_.end(), 0);
  MujocoEngine::hold(machine_->start);
}

void MujocoEngine::hold(const Inputs& inputs) {
  double* held = held_.data();
  for (std::size_t i = 0; i < machine_->map.joint_dof.size(); ++i)
    held[machine_->map.joint_dof[i]] = inputs[inputs.layout.effort(static_cast<int>(i))];
  for (std::size_t i = 0; i < machine_->map.wheel_dof.size(); ++i)
    held[machine_->map.wheel_dof[i]] = inputs[inputs.layout.motor_torque(static_cast<int>(i))];
  forces_.hold(inputs);
  propellant_.hold(inputs);
  link_forces_.hold(inputs);
  drained_to_ = std::numeric_limits<double>::quiet_NaN();
  held_since_ = inputs.since;
  hold_hub_loads();
}

// In the aligned frame a load in hub axes is one generalised force for all evaluations.
void MujocoEngine::hold_hub_loads() {
  holds_all_loads_ = machine_->placement == Placement::kAligned && forces_.acts_on_hub_alone() &&
                     !link_forces_.acts();
  Wrench load;
  if (holds_all_loads_) {
    const LinkPose hub{Matrix3d::Identity(), Vector3d::Zero()};
    forces_.apply(Vector3d::Zero(), {&hub, 1}, {}, {&load, 1});
  }
  Eigen::Map<Vector3d>(held_.data()) = load.force_W;
  Eigen::Map<Vector3d>(held_.data() + 3) = load.torque_PntB_W;
}

void MujocoEngine::drain(double time) {
  if (propellant_.is_idle() || time == drained_to_) return;
  drained_to_ = time;
  const std::span<const double> shares = propellant_.shares(time);
  if (own_model_) machine_->draining.set_shares(shares, *own_model_);
  forces_.set_shares(shares);
}

void MujocoEngine::derivative(double time, std::span<const double> state, std::span<double> rate,
                              BookRates* books) {
  const mjModel* m = model_;
  mjData* d = data_.get();
  const Matrix3d dcm_NW = machine_->placement == Placement::kAligned
                              ? dcm_of(state.data() + StateLayout::attitude())
                              : Matrix3d::Identity();
  drain(time);
  machine_->exchange.hand_over(state.data(), machine_->placement, *d);
  mj_kinematics(m, d);
  align_round_wheels(machine_->round_wheels, *d);
  mj_comPos(m, d);
  mj_comVel(m, d);
  const double* applied = held_.data();
  Found found;
  if (holds_all_loads_ && books == nullptr) {
    found.fall_N = forces_.fall(Input(state.data() + StateLayout::position()), dcm_NW, {});
  } else if (machine_->law != GravityLaw::kNone || acts()) {
    found = find_forces(time, state, dcm_NW, books != nullptr);
    if (acts() && !holds_all_loads_) {
      std::ranges::copy(held_, applied_.begin());
      projector_.add(*m, *d, wrenches_, applied_);
      applied = applied_.data();
    }
  }
  mj_crb(m, d);
  mj_factorM(m, d);
  mj_rne(m, d, 0, d->qfrc_bias);
  machine_->passive.apply(*d);
  for (int i = 0; i < m->nv; ++i) d->qacc[i] = d->qfrc_passive[i] - d->qfrc_bias[i] + applied[i];
  mj_solveM(m, d, d->qacc, d->qacc, 1);
  const double sum = machine_->exchange.take_back(
      state.data(), dcm_NW * Input(d->qacc) + found.fall_N, *d, rate.data());
  // A singular mass matrix only warns, and MuJoCo goes on with a made-up pivot.
  if (!std::isfinite(sum) || d->warning[mjWARN_INERTIA].number > 0) fail(state, rate);
  if (books == nullptr) return;
  *books = machine_->placement == Placement::kAligned ? book_rates(state, dcm_NW, found)
                                                      : centred_book_rates(time, state);
}

// One bad entry spoils all accelerations, so the state is searched for the culprit first.
void MujocoEngine::fail(std::span<const double> state, std::span<const double> rate) {
  const auto bad = [](double value) { return !std::isfinite(value); };
  const mjWarningStat singular = std::exchange(data_->warning[mjWARN_INERTIA], {});
  std::string what;
  if (const auto x = std::ranges::find_if(state, bad); x != state.end()) {
    what = machine_->exchange.name(static_cast<int>(x - state.begin())) + " is not finite";
  } else if (singular.number > 0) {
    const int joint = model_->dof_jntid[singular.lastinfo];
    what =
        fmt::format("the mass matrix is singular at `{}`", mj_id2name(model_, mjOBJ_JOINT, joint));
  } else {
    const auto r = std::ranges::find_if(rate, bad);
    what = machine_->exchange.name(static_cast<int>(r - rate.begin())) +
           " has a rate that is not finite";
  }
  throw NumericalFailure(what);
}

void MujocoEngine::finish_step(std::span<double> state) {
  Eigen::Map<Eigen::Vector4d>(state.data() + StateLayout::attitude()).normalize();
}

void MujocoEngine::gather_poses() {
  using Rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  const Input r_BO_N(data_->xpos + 3 * kHubBody);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const int body = machine_->map.link_body[i];
    poses_[i].dcm_WL = Rotation(data_->xmat + 9 * body);
    poses_[i].r_LB_W = Input(data_->xpos + 3 * body) - r_BO_N;
  }
}

// Poses and, where something acts, the wrenches of all links.
MujocoEngine::Found MujocoEngine::find_forces(double time, std::span<const double> state,
                                              const Matrix3d& dcm_NW, bool with_work) {
  const Vector3d r_BN_N = Input(state.data() + StateLayout::position());
  const Vector3d v_BN_N = Input(state.data() + StateLayout::velocity());
  Found found;
  gather_poses();
  if (with_work) gather_rates(all_links_);
  if (!forces_.is_idle()) {
    const std::span<const LinkRate> rates =
        with_work ? std::span<const LinkRate>(link_rates_) : std::span<const LinkRate>();
    found.work = forces_.apply(dcm_NW.transpose() * r_BN_N, poses_, rates, wrenches_);
  }
  if (link_forces_.acts()) {
    if (forces_.is_idle()) std::ranges::fill(wrenches_, Wrench{});
    if (!with_work) gather_rates(link_forces_.links());
    found.work += link_forces_.add({time, r_BN_N, v_BN_N, dcm_NW}, poses_, link_rates_, wrenches_);
  }
  found.fall_N = forces_.fall(r_BN_N, dcm_NW, poses_);
  return found;
}

// The vehicle at `state`, centred in any frame: what is observed is not what is tested.
void MujocoEngine::move_to(std::span<const double> state) {
  machine_->exchange.hand_over(state.data(), Placement::kCentred, *data_);
  mj_kinematics(model_, data_.get());
  align_round_wheels(machine_->round_wheels, *data_);
  mj_comPos(model_, data_.get());
  mj_comVel(model_, data_.get());
}

void MujocoEngine::observe(double time, std::span<const double> state, Observation& seen) {
  drain(time);
  move_to(state);
  gather_poses();
  const MotionSums sums =
      sum_motion(*model_, *data_, Input(state.data() + StateLayout::velocity()));
  unpack(state, layout(), seen);
  seen.time = time;
  seen.r_CN_N = seen.r_BN_N + sums.r_CB_N;
  seen.v_CN_N = sums.v_CN_N;
  seen.mass = sums.mass;
  seen.kinetic = sums.kinetic;
  seen.own_kinetic = sums.own_kinetic;
  seen.springs = machine_->passive.spring_energy(*data_);
  seen.potential = seen.springs + forces_.potential(seen.r_BN_N, poses_);
  seen.momentum = sums.momentum;
  seen.H_PntC_N = sums.H_PntC_N;
  seen.momentum_scale = sums.momentum_scale;
  seen.H_scale = sums.H_scale;
}

// From what the evaluation left behind. @pre the hub's origin is at rest at zero there
BookRates MujocoEngine::book_rates(std::span<const double> state, const Matrix3d& dcm_NW,
                                   const Found& found) const {
  const Vector3d r_BN_W = dcm_NW.transpose() * Input(state.data() + StateLayout::position());
  const Vector3d v_BN_W = dcm_NW.transpose() * Input(state.data() + StateLayout::velocity());
  const double inner_power = joint_power();
  BookRates rates{.power = inner_power, .own_power = inner_power};
  if (machine_->law == GravityLaw::kNone && !acts() && propellant_.is_idle()) return rates;
  const BodyCenter center = center_of(*model_, *data_);
  rates.force_N = center.mass * found.fall_N;  // what falls does so at C
  if (acts()) {
    const WrenchSums sums = sum_up(wrenches_, poses_, link_rates_);
    const Vector3d& force_W = sums.all.force_W;
    rates.power += found.work.power + found.work.force_W.dot(v_BN_W);
    rates.own_power += sums.power - force_W.dot(center.v_CB_W);
    rates.force_N += dcm_NW * force_W;
    rates.torque_PntC_N += dcm_NW * (sums.all.torque_PntB_W - center.r_CB_W.cross(force_W));
  }
  if (!propellant_.is_idle()) add_leaving(r_BN_W, v_BN_W, dcm_NW, center, rates);
  return rates;
}

// In the inertial frame the hub stands where it is, and sums about it would lose their digits.
BookRates MujocoEngine::centred_book_rates(double time, std::span<const double> state) {
  move_to(state);
  const Matrix3d dcm_NW = Matrix3d::Identity();
  return book_rates(state, dcm_NW, find_forces(time, state, dcm_NW, true));
}

// Propellant takes its own energy and momentum along.
void MujocoEngine::add_leaving(const Vector3d& r_BN_W, const Vector3d& v_BN_W,
                               const Matrix3d& dcm_NW, const BodyCenter& center,
                               BookRates& rates) const {
  const std::span<const double> share_rates = propellant_.share_rates();
  const LeavingSums left = machine_->draining.leaving(*model_, *data_, v_BN_W, center, share_rates);
  rates.force_N += dcm_NW * left.momentum;
  rates.torque_PntC_N += dcm_NW * left.H_PntC_W;
  rates.power += left.kinetic + forces_.potential_rate(r_BN_W, poses_, share_rates);
  rates.own_power += left.own_kinetic;
}

// Relative to the hub origin, wherever the hub is placed; cvel is taken at the centre of mass of
// the whole tree.
void MujocoEngine::gather_rates(std::span<const int> links) {
  const Input r_CO_W(data_->subtree_com + 3 * kHubBody);
  const Input v_BO_W(data_->qvel);
  for (const int link : links) {
    const auto i = static_cast<std::size_t>(link);
    const int body = machine_->map.link_body[i];
    const Vector3d omega = Input(data_->cvel + 6 * body);
    const Vector3d r_LC_W = Input(data_->xpos + 3 * body) - r_CO_W;
    link_rates_[i] = {omega, Input(data_->cvel + 6 * body + 3) - v_BO_W + omega.cross(r_LC_W)};
  }
}

// Motors and efforts, less what the dampers take; a wheel's bearing has no friction.
double MujocoEngine::joint_power() const {
  double power = -machine_->passive.damper_power(*data_);
  for (int i = kHubDofs; i < model_->nv; ++i) {
    power += held_[static_cast<std::size_t>(i)] * data_->qvel[i];
  }
  return power;
}

// MuJoCo's degrees of freedom in our order.
std::vector<int> MujocoEngine::dof_order() const {
  std::vector<int> order = {0, 1, 2, 3, 4, 5};
  order.insert(order.end(), machine_->map.joint_dof.begin(), machine_->map.joint_dof.end());
  order.insert(order.end(), machine_->map.wheel_dof.begin(), machine_->map.wheel_dof.end());
  return order;
}

Eigen::MatrixXd MujocoEngine::mass_matrix(std::span<const double> state) {
  drain(held_since_);
  move_to(state);
  mj_crb(model_, data_.get());
  Eigen::MatrixXd mass(model_->nv, model_->nv);
  mj_fullM(model_, mass.data(), data_->qM);
  const std::vector<int> order = dof_order();
  return mass(order, order);
}

RoundingTerms MujocoEngine::rounding_terms(std::span<const double> state) {
  drain(held_since_);
  move_to(state);
  std::fill_n(data_->qfrc_passive, model_->nv, 0.0);
  machine_->passive.apply(*data_);
  const RoundingTerms terms = inertia_terms(*model_, *data_);
  const std::vector<int> order = dof_order();
  return {terms.mass(order, order), terms.force(order)};
}

}  // namespace

std::unique_ptr<Engine> make_mujoco_engine(const Model& model, const std::string& mjcf) {
  if (model.simulation.translation) return make_mujoco_point_mass_engine(model, mjcf);
  return std::make_unique<MujocoEngine>(std::make_shared<const MujocoMachine>(model, mjcf));
}

}  // namespace twincraft
