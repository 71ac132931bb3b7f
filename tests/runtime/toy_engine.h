// An engine small enough to be checked by eye, for tests of what is built on engines: one rigid
// body under point gravity and scheduled torques, and uncoupled oscillators q'' = u - k q of unit
// mass for joints. It reads the same model as the real engines and can be told to misbehave.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "runtime/engine/engine.h"

namespace twincraft {

class ToyEngine : public Engine {
 public:
  explicit ToyEngine(const Model& model) : model_(model) {
    layout_ = {model.engines.attitude, static_cast<int>(model.assembly.links.size()) - 1, 0};
    for (const MassElement& element : model.assembly.links[0].elements)
      hub_ = hub_ + properties_of(element);
  }

  // Called before every evaluation with the time and the rates to spoil after it.
  std::function<void(double time, std::span<double> rate)> mischief = [](double, auto) {};
  std::vector<double> held_at;      // since when the inputs of every hold() hold
  std::vector<double> final_state;  // after the last step

  std::string_view name() const override { return "toy"; }
  const StateLayout& layout() const override { return layout_; }
  std::unique_ptr<Engine> another() const override { return std::make_unique<ToyEngine>(model_); }

  Eigen::VectorXd initial_state() const override { return pack(model_.initial, layout_); }

  void hold(const Inputs& inputs) override {
    held_at.push_back(inputs.since);
    torque_.setZero();
    for (int load = 0; load < inputs.layout.loads; ++load)
      torque_ += inputs.vector(inputs.layout.torque(load));
    efforts_.assign(1, 0.0);
    for (int joint = 0; joint < inputs.layout.joints; ++joint)
      efforts_.push_back(inputs[inputs.layout.effort(joint)]);
  }

  void derivative(double time, std::span<const double> state, std::span<double> rate,
                  BookRates* books) override {
    const auto y = map(state);
    Eigen::Map<Eigen::VectorXd> dy(rate.data(), static_cast<Eigen::Index>(rate.size()));
    const Vector3d omega = y.segment<3>(layout_.rate());
    dy.segment<3>(0) = y.segment<3>(3);
    dy.segment<3>(3) = gravity(y.segment<3>(0));
    if (layout_.chart == AttitudeChart::kMrp) {
      const Vector3d sigma = y.segment<3>(6);
      dy.segment<3>(6) = 0.25 * ((1.0 - sigma.squaredNorm()) * omega + 2.0 * sigma.cross(omega) +
                                 2.0 * sigma * sigma.dot(omega));
    } else {
      const Vector3d vector = y.segment<3>(7);
      dy[6] = -0.5 * vector.dot(omega);
      dy.segment<3>(7) = 0.5 * (y[6] * omega + vector.cross(omega));
    }
    const Vector3d H = hub_.I_PntC_L * omega;
    dy.segment<3>(layout_.rate()) = hub_.I_PntC_L.inverse() * (torque_ - omega.cross(H));
    for (int joint = 0; joint < layout_.joints; ++joint) {
      const auto link = static_cast<std::size_t>(joint) + 1;
      const double stiffness = model_.assembly.links[link].joint.stiffness;
      dy[layout_.joint() + joint] = y[layout_.joint_rate() + joint];
      dy[layout_.joint_rate() + joint] = efforts_[link] - stiffness * y[layout_.joint() + joint];
    }
    if (books != nullptr) *books = book_rates(y);
    mischief(time, rate);
  }

  void finish_step(std::span<double> state) override {
    Eigen::Map<Eigen::VectorXd> y(state.data(), static_cast<Eigen::Index>(state.size()));
    if (layout_.chart == AttitudeChart::kQuaternion)
      y.segment<4>(6).normalize();
    else if (const double square = y.segment<3>(6).squaredNorm(); square > 1.0)
      y.segment<3>(6) /= -square;
    final_state.assign(state.begin(), state.end());
  }

  void observe(double time, std::span<const double> state, Observation& seen) override {
    const auto y = map(state);
    seen = {};
    seen.time = time;
    seen.r_BN_N = seen.r_CN_N = y.segment<3>(0);
    seen.v_BN_N = seen.v_CN_N = y.segment<3>(3);
    seen.q_BN = attitude(y);
    seen.omega_BN_B = y.segment<3>(layout_.rate());
    for (int joint = 0; joint < layout_.joints; ++joint) {
      seen.joint_position.push_back(y[layout_.joint() + joint]);
      seen.joint_rate.push_back(y[layout_.joint_rate() + joint]);
    }
    seen.mass = hub_.mass;
  }

  Eigen::MatrixXd mass_matrix(std::span<const double>) override { return {}; }

 private:
  BookRates book_rates(const Eigen::Ref<const Eigen::VectorXd>& y) const {
    const Vector3d omega = y.segment<3>(layout_.rate());
    return {torque_.dot(omega), hub_.mass * gravity(y.segment<3>(0)), attitude(y) * torque_};
  }
  static Eigen::Map<const Eigen::VectorXd> map(std::span<const double> state) {
    return {state.data(), static_cast<Eigen::Index>(state.size())};
  }
  Vector3d gravity(const Vector3d& r) const {
    if (model_.gravity.mu == 0.0) return Vector3d::Zero();
    const double radius = r.norm();
    return -model_.gravity.mu / (radius * radius * radius) * r;
  }
  Quaterniond attitude(const Eigen::Ref<const Eigen::VectorXd>& y) const {
    if (layout_.chart == AttitudeChart::kQuaternion) return {y[6], y[7], y[8], y[9]};
    const Vector3d sigma = y.segment<3>(6);
    const double square = sigma.squaredNorm();
    const Vector3d vector = 2.0 * sigma / (1.0 + square);
    return {(1.0 - square) / (1.0 + square), vector.x(), vector.y(), vector.z()};
  }

  const Model& model_;
  StateLayout layout_;
  MassProperties hub_;
  Vector3d torque_ = Vector3d::Zero();
  std::vector<double> efforts_;
};

/// 750 kg, diag(900, 800, 600) kg m^2 about the hub origin, at rest in deep space.
inline Model toy_model() {
  Model model;
  const Vector3d moments(900.0, 800.0, 600.0);
  Link hub;
  hub.name = "hub";
  hub.elements = {{.name = "hub", .mass = 750.0, .I_PntE_L = moments.asDiagonal()}};
  model.assembly.links.push_back(hub);
  const Tolerance tight{1.0e-9, 1.0e-9};
  model.simulation = {.method = Method::kRk4,
                      .step = 0.1,
                      .duration = 1.0,
                      .record = 0.1,
                      .tolerance = {tight, tight, tight, tight, tight, tight, tight}};
  return model;
}

/// The torque of a load named `push` about the hub's z axis [N m].
inline void push_about_z(Model& model, Schedule torque) {
  Load load;
  load.name = "push";
  load.torque_L[2] = std::move(torque);
  model.loads.push_back(load);
}

/// An oscillator named NAME of `stiffness` [N/m] at displacement 0.1, with `effort`.
inline void add_oscillator(Model& model, const std::string& name, double stiffness,
                           Schedule effort = {}) {
  Link link;
  link.name = name;
  link.parent = 0;
  link.joint.kind = JointKind::kSlide;
  link.joint.stiffness = stiffness;
  link.joint.effort = std::move(effort);
  const int index = static_cast<int>(model.assembly.links.size());
  model.assembly.links.push_back(link);
  model.coordinates.push_back({name, Coordinate::Kind::kParticle, index});
  model.initial.joint_position.push_back(0.1);
  model.initial.joint_rate.push_back(0.0);
}

}  // namespace twincraft
