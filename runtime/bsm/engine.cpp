// See engine.h: the state vector around the recursion. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/engine.h"

#include "runtime/bsm/attitude.h"
#include "runtime/bsm/books.h"
#include "runtime/bsm/point_mass_engine.h"
#include "runtime/bsm/recursion.h"
#include "runtime/forces/propellant_ledger.h"

namespace twincraft {
namespace bsm {
namespace {

std::vector<std::vector<MassElement>> elements_of(const Assembly& assembly) {
  std::vector<std::vector<MassElement>> elements;
  for (const Link& link : assembly.links) elements.push_back(link.elements);
  return elements;
}

template <class Chart>
class BsmEngine final : public Engine {
 public:
  BsmEngine(const Model& model, AttitudeChart chart)
      : assembly_(model.assembly),
        initial_(model.initial),
        recursion_(model.assembly, model.engines.chains == ChainPath::kGeneral
                                       ? bsm::Chains::kGeneral
                                       : bsm::Chains::kPlanar),
        propellant_(model.tanks),
        shares_(propellant_.shares(0.0)),
        forces_(model, model.gravity.bsm, elements_of(model.assembly), FieldFrame::kFalling),
        layout_{chart, static_cast<int>(model.assembly.links.size()) - 1,
                static_cast<int>(model.assembly.rotors.size())},
        effort_(static_cast<std::size_t>(layout_.joints)),
        motor_torque_(static_cast<std::size_t>(layout_.wheels)),
        wrenches_(model.assembly.links.size()) {
    hold_inputs(0.0);
  }

  std::string_view name() const override { return "bsm"; }
  const StateLayout& layout() const override { return layout_; }

  Eigen::VectorXd initial_state() const override {
    Eigen::VectorXd state(layout_.size());
    state.segment<3>(StateLayout::position()) = initial_.r_BN_N;
    state.segment<3>(StateLayout::velocity()) = initial_.v_BN_N;
    state.segment<kAttitude>(StateLayout::attitude()) = Chart::from(initial_.q_BN);
    state.segment<3>(layout_.rate()) = initial_.omega_BN_B;
    const auto put = [&state](int at, const std::vector<double>& values) {
      for (std::size_t i = 0; i < values.size(); ++i) state[at + static_cast<int>(i)] = values[i];
    };
    put(layout_.joint(), initial_.joint_position);
    put(layout_.joint_rate(), initial_.joint_rate);
    put(layout_.wheel(), initial_.rotor_speed);
    return state;
  }

  void hold_inputs(double time) override {
    for (std::size_t i = 0; i < effort_.size(); ++i) {
      effort_[i] = assembly_.links[i + 1].joint.effort.at(time);
    }
    for (std::size_t k = 0; k < motor_torque_.size(); ++k) {
      motor_torque_[k] = assembly_.rotors[k].torque.at(time);
    }
    forces_.hold(time);
    propellant_.hold(time);
    drain(time);
  }

  void derivative(double time, std::span<const double> state, std::span<double> rate) override {
    const State x = read(state);
    drain(time);
    recursion_.move(x.q, x.q_dot, x.omega_BN_B, x.rotor_speed);
    Vector3d g_B = Vector3d::Zero();
    if (!forces_.is_silent()) {
      g_B = forces_.apply(x.dcm_NB.transpose() * x.r_BN_N, recursion_.poses(), wrenches_);
    }
    recursion_.accelerate(x.q, x.q_dot, {effort_, motor_torque_}, acting_wrenches(),
                          block(rate, layout_.joint_rate(), layout_.joints),
                          block(rate, layout_.wheel(), layout_.wheels));
    vector(rate, StateLayout::position()) = x.v_BN_N;
    vector(rate, StateLayout::velocity()) = x.dcm_NB * (recursion_.a_BN_B() + g_B);
    Attitude(rate.data() + StateLayout::attitude()) = Chart::rate(x.attitude, x.omega_BN_B);
    vector(rate, layout_.rate()) = recursion_.omega_dot_BN_B();
    std::copy(x.q_dot.begin(), x.q_dot.end(), rate.begin() + layout_.joint());
  }

  void finish_step(std::span<double> state) override {
    Attitude attitude(state.data() + StateLayout::attitude());
    attitude = Chart::regular(attitude.eval());
  }

  Observation observe(double time, std::span<const double> state) override {
    const State x = read(state);
    drain(time);
    recursion_.move(x.q, x.q_dot, x.omega_BN_B, x.rotor_speed);
    Observation o = books(time, x);
    o.q_BN = Chart::quaternion(x.attitude);
    if (o.q_BN.w() < 0.0) o.q_BN.coeffs() = -o.q_BN.coeffs();
    return o;
  }

  ExternalRates external_rates(double time, std::span<const double> state) override {
    const State x = read(state);
    drain(time);
    recursion_.move(x.q, x.q_dot, x.omega_BN_B, x.rotor_speed);
    return outside(x);
  }

  Eigen::MatrixXd mass_matrix(std::span<const double> state) override {
    const State x = read(state);
    recursion_.move(x.q, x.q_dot, x.omega_BN_B, x.rotor_speed);
    return dense_mass_matrix(recursion_, x.dcm_NB);
  }

 private:
  static constexpr int kAttitude = Chart::Coordinates::SizeAtCompileTime;
  using Attitude = Eigen::Map<typename Chart::Coordinates>;

  struct State {
    Vector3d r_BN_N, v_BN_N, omega_BN_B;
    typename Chart::Coordinates attitude;
    Matrix3d dcm_NB;
    std::span<const double> q, q_dot, rotor_speed;
  };

  static Eigen::Map<Vector3d> vector(std::span<double> values, int at) {
    return Eigen::Map<Vector3d>(values.data() + at);
  }
  template <class T>
  static std::span<T> block(std::span<T> values, int at, int size) {
    return values.subspan(static_cast<std::size_t>(at), static_cast<std::size_t>(size));
  }

  State read(std::span<const double> state) const {
    const auto three = [&state](int at) {
      return Vector3d(Eigen::Map<const Vector3d>(state.data() + at));
    };
    const typename Chart::Coordinates attitude =
        Eigen::Map<const typename Chart::Coordinates>(state.data() + StateLayout::attitude());
    return {three(StateLayout::position()),
            three(StateLayout::velocity()),
            three(layout_.rate()),
            attitude,
            Chart::dcm_NB(attitude),
            block(state, layout_.joint(), layout_.joints),
            block(state, layout_.joint_rate(), layout_.joints),
            block(state, layout_.wheel(), layout_.wheels)};
  }

  /// Everything that depends on mass follows the tanks.
  void drain(double time) {
    if (propellant_.is_idle()) return;
    shares_ = propellant_.shares(time);
    recursion_.set_shares(shares_);
    forces_.set_shares(shares_);
  }

  std::span<const Wrench> acting_wrenches() const {
    return forces_.is_idle() ? std::span<const Wrench>{} : wrenches_;
  }

  Observation books(double time, const State& x) {
    Observation o;
    o.time = time;
    o.r_BN_N = x.r_BN_N;
    o.v_BN_N = x.v_BN_N;
    o.omega_BN_B = x.omega_BN_B;
    o.joint_position.assign(x.q.begin(), x.q.end());
    o.joint_rate.assign(x.q_dot.begin(), x.q_dot.end());
    o.wheel_rate.assign(x.rotor_speed.begin(), x.rotor_speed.end());
    const Totals totals = sum_up(recursion_, assembly_, shares_, x.q_dot, x.rotor_speed);
    fill_books(totals, x.dcm_NB, o);
    o.potential = spring_energy(recursion_.tree(), x.q) +
                  forces_.potential(x.dcm_NB.transpose() * x.r_BN_N, recursion_.poses());
    return o;
  }

  ExternalRates outside(const State& x) {
    const Totals totals = sum_up(recursion_, assembly_, shares_, x.q_dot, x.rotor_speed);
    const Vector3d r_BN_B = x.dcm_NB.transpose() * x.r_BN_N;
    std::fill(wrenches_.begin(), wrenches_.end(), Wrench{});
    const Vector3d g_B = forces_.apply(r_BN_B, recursion_.poses(), wrenches_);
    Vector3d force_B = totals.mass * g_B;
    Vector3d torque_PntC_B = Vector3d::Zero();
    for (const Wrench& wrench : wrenches_) {
      force_B += wrench.force_W;
      torque_PntC_B += wrench.torque_PntB_W - totals.r_CB_B.cross(wrench.force_W);
    }
    std::vector<LinkRate> rates(wrenches_.size());
    recursion_.rates(x.q_dot, rates);
    for (LinkRate& rate : rates) rate.v_LN_W += x.dcm_NB.transpose() * x.v_BN_N;
    const double power = joint_power(recursion_.tree(), x.q, x.q_dot, effort_) +
                         motor_power(x.rotor_speed, motor_torque_) +
                         forces_.power(r_BN_B, recursion_.poses(), rates);
    ExternalRates rates_outside{power, x.dcm_NB * force_B, x.dcm_NB * torque_PntC_B};
    if (!propellant_.is_idle()) add_leaving(x, totals, rates_outside);
    return rates_outside;
  }

  /// Propellant takes its own energy and momentum along.
  void add_leaving(const State& x, const Totals& totals, ExternalRates& rates) {
    const std::span<const double> share_rates = propellant_.share_rates();
    const Leaving leaving = sum_up_leaving(recursion_, assembly_, x.q_dot, share_rates, totals);
    const Vector3d v_BN_B = x.dcm_NB.transpose() * x.v_BN_N;
    rates.power +=
        leaving.kinetic + leaving.momentum_B.dot(v_BN_B) +
        0.5 * leaving.mass * v_BN_B.squaredNorm() +
        forces_.potential_rate(x.dcm_NB.transpose() * x.r_BN_N, recursion_.poses(), share_rates);
    rates.force_N += x.dcm_NB * leaving.momentum_B + leaving.mass * x.v_BN_N;
    rates.torque_PntC_N += x.dcm_NB * leaving.H_PntC_B;
  }

  Assembly assembly_;
  InitialState initial_;
  Recursion recursion_;
  PropellantLedger propellant_;
  std::span<const double> shares_;
  ForceModel forces_;
  StateLayout layout_;
  std::vector<double> effort_, motor_torque_;
  std::vector<Wrench> wrenches_;
};

}  // namespace
}  // namespace bsm

std::unique_ptr<Engine> make_bsm_engine(const Model& model) {
  if (model.simulation.translation) return bsm::make_point_mass_engine(model);
  if (model.engines.attitude == AttitudeChart::kMrp) {
    return std::make_unique<bsm::BsmEngine<bsm::MrpChart>>(model, AttitudeChart::kMrp);
  }
  return std::make_unique<bsm::BsmEngine<bsm::QuaternionChart>>(model, AttitudeChart::kQuaternion);
}

}  // namespace twincraft
