// See engine.h: the state vector around the kernel. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/engine.h"

#include <limits>

#include "runtime/bsm/books.h"
#include "runtime/bsm/kernel.h"
#include "runtime/bsm/motion.h"
#include "runtime/bsm/point_mass_engine.h"
#include "runtime/forces/propellant_ledger.h"

namespace twincraft {
namespace bsm {
namespace {

std::vector<std::vector<MassElement>> elements_of(const Assembly& assembly) {
  std::vector<std::vector<MassElement>> elements;
  for (const Link& link : assembly.links) elements.push_back(link.elements);
  return elements;
}

/// What the engines of one model share: none of it ever changes.
struct Machine {
  explicit Machine(const Model& model)
      : assembly(model.assembly),
        initial(model.initial),
        loads(model.loads),
        start(inputs_at(model, 0.0)),
        layout{model.engines.attitude, static_cast<int>(model.assembly.links.size()) - 1,
               static_cast<int>(model.assembly.rotors.size())},
        plan(make_plan(model.assembly, model.engines.attitude, model.gravity, model.loads,
                       model.engines.chains, model.forces)),
        propellant(model.tanks),
        forces(model, model.gravity.bsm, elements_of(model.assembly), FieldFrame::kFalling),
        elements(elements_of(model.assembly), [](const MassElement&) { return true; }) {}

  Assembly assembly;
  VehicleState initial;
  std::vector<Load> loads;
  Inputs start;  // of t = 0
  StateLayout layout;
  Plan plan;
  // As at t = 0: each engine begins with a copy.
  PropellantLedger propellant;
  ForceModel forces;
  Elements elements;
};

class BsmEngine final : public Engine {
 public:
  BsmEngine(std::shared_ptr<const Machine> machine, InstructionSet set)
      : machine_(std::move(machine)),
        set_(set),
        kernel_(make_kernel(machine_->plan, set)),
        held_(HeldInputs::none(machine_->assembly)),
        propellant_(machine_->propellant),
        forces_(machine_->forces),
        elements_(machine_->elements),
        motion_(at_rest(tree())) {
    BsmEngine::hold(machine_->start);
  }

  std::string_view name() const override { return kBsmKey; }
  const StateLayout& layout() const override { return machine_->layout; }
  std::unique_ptr<Engine> another() const override {
    return std::make_unique<BsmEngine>(machine_, set_);
  }

  Eigen::VectorXd initial_state() const override { return pack(machine_->initial, layout()); }

  void hold(const Inputs& inputs) override {
    held_.set(inputs, machine_->loads);
    forces_.hold(inputs);
    propellant_.hold(inputs);
    const HeldInputs* held = &held_;
    kernel_->hold({&held, 1});
    drained_to_ = std::numeric_limits<double>::quiet_NaN();
  }

  void derivative(double time, std::span<const double> state, std::span<double> rate,
                  BookRates* books) override {
    if (books != nullptr) return evaluate_and_book(time, state, rate, *books);
    kernel_->derivative(time, state.data(), rate.data());
  }

  void finish_step(std::span<double> state) override { kernel_->finish_step(state.data()); }

  void observe(double time, std::span<const double> state, Observation& seen) override {
    drain(time);
    const State x = read(state);
    assign(x, seen);
    seen.time = time;
    move_links(tree(), x.joint_position, x.joint_rate, x.omega_BN_B, motion_);
    fill_books(sum_up(motion_, elements_, tree(), x.wheel_rate, moving_), x.dcm_NB, seen);
    seen.springs = spring_energy(tree(), x.joint_position);
    seen.potential = seen.springs + forces_.potential(x.r_BN_B(), motion_.poses);
  }

  Eigen::MatrixXd mass_matrix(std::span<const double> state) override {
    Tree tree = machine_->plan.tree;
    set_shares(tree, propellant_.shares(held_.inputs.since));
    const State x = read(state);
    return dense_mass_matrix(tree, motion_of(tree, x.joint_position, x.joint_rate, x.omega_BN_B),
                             x.dcm_NB);
  }

  HeldMachine held() const override {
    HeldMachine machine;
    for (const Link& link : machine_->assembly.links) {
      HeldLink held;
      for (const MassElement& element : link.elements)
        held.mass = held.mass + properties_of(element);
      if (link.parent >= 0) {
        const Joint& joint = link.joint;
        held.r_HP_P = joint.r_HP_P;
        held.reach = joint.r_HP_P.norm();
        held.dcm_PL0 = joint.dcm_PL0;
        held.axis_L = joint.axis_L;
        held.stiffness = joint.stiffness;
        held.damping = joint.damping;
        held.rest = joint.rest;
      }
      machine.links.push_back(held);
    }
    for (const Rotor& rotor : machine_->assembly.rotors)
      machine.wheels.push_back({rotor.axis_L, rotor.spin_inertia});
    return machine;
  }

 private:
  struct State : UnpackedState {
    Matrix3d dcm_NB;

    Vector3d r_BN_B() const { return dcm_NB.transpose() * r_BN_N; }
    Vector3d v_BN_B() const { return dcm_NB.transpose() * v_BN_N; }
  };

  // Apart from derivative(), which without it is a jump into the kernel.
  [[gnu::noinline]] void evaluate_and_book(double time, std::span<const double> state,
                                           std::span<double> rate, BookRates& books) {
    kernel_->derivative(time, state.data(), rate.data());
    kernel_->books(state.data(), {&books, 1});
  }

  State read(std::span<const double> state) const {
    const UnpackedState x = unpack(state, layout());
    return {x, x.q_BN.toRotationMatrix()};
  }

  /// How its links are joined; their masses as at t = 0.
  const Tree& tree() const { return machine_->plan.tree; }

  /// Let the masses of observations be those that the tanks leave; the kernel has its own.
  void drain(double time) {
    if (propellant_.is_idle() || time == drained_to_) return;
    drained_to_ = time;
    const std::span<const double> shares = propellant_.shares(time);
    elements_.set_shares(shares);
    forces_.set_shares(shares);
  }

  std::shared_ptr<const Machine> machine_;
  InstructionSet set_;
  std::unique_ptr<Kernel> kernel_;
  HeldInputs held_;
  // For observations; the kernel has its own forces and masses.
  PropellantLedger propellant_;
  ForceModel forces_;
  Elements elements_;        // with the masses at drained_to_
  double drained_to_ = 0.0;  // [s] NaN: at no time
  Motion motion_;
  std::vector<MovingElement> moving_;
};

}  // namespace
}  // namespace bsm

std::unique_ptr<Engine> make_bsm_engine(const Model& model, bsm::InstructionSet set) {
  if (model.simulation.translation) return bsm::make_point_mass_engine(model);
  return std::make_unique<bsm::BsmEngine>(std::make_shared<const bsm::Machine>(model), set);
}

}  // namespace twincraft
