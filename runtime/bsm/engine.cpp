// See engine.h: the state vector around the kernel. Tested by tests/runtime/bsm_test.cpp.
#include "runtime/bsm/engine.h"

#include <algorithm>
#include <vector>

#include "runtime/bsm/kernel.h"
#include "runtime/bsm/mass_matrix.h"
#include "runtime/bsm/motion.h"
#include "runtime/bsm/observer.h"
#include "runtime/bsm/point_mass_engine.h"
#include "runtime/forces/propellant_ledger.h"

namespace twincraft {
namespace bsm {
namespace {

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
        propellant(model.tanks) {}

  Assembly assembly;
  VehicleState initial;
  std::vector<Load> loads;
  Inputs start;  // of t = 0
  StateLayout layout;
  Plan plan;
  PropellantLedger propellant;  // as at t = 0: each engine begins with a copy
};

/// States that wait to be observed.
class Notebook {
 public:
  Notebook(std::size_t pages, const Machine& machine)
      : state_size_(static_cast<std::size_t>(machine.layout.size())),
        tanks_(machine.propellant.share_rates().size()),
        numbers_(pages * (state_size_ + tanks_)) {
    noted_.reserve(pages);
  }

  void add(std::span<const double> state, std::span<const double> shares, Observation& seen) {
    double* at = numbers_.data() + noted_.size() * (state_size_ + tanks_);
    std::copy_n(state.data(), state_size_, at);
    std::copy_n(shares.data(), tanks_, at + state_size_);
    noted_.push_back({at, at + state_size_, &seen});
  }
  std::span<const Noted> noted() const { return noted_; }
  void clear() { noted_.clear(); }

 private:
  std::size_t state_size_, tanks_;
  std::vector<double> numbers_;
  std::vector<Noted> noted_;
};

class BsmEngine final : public Engine {
 public:
  BsmEngine(std::shared_ptr<const Machine> machine, InstructionSet set)
      : machine_(std::move(machine)),
        set_(set),
        kernel_(make_kernel(machine_->plan, set)),
        observer_(make_observer(machine_->plan, machine_->assembly, set)),
        notebook_(observer_->lanes(), *machine_),
        held_(HeldInputs::none(machine_->assembly)),
        propellant_(machine_->propellant) {
    BsmEngine::hold(machine_->start);
  }

  std::string_view name() const override { return kBsmKey; }
  const StateLayout& layout() const override { return machine_->layout; }
  bool may_use_avx2() const override { return set_ != InstructionSet::kPortable; }
  std::unique_ptr<Engine> another() const override {
    return std::make_unique<BsmEngine>(machine_, set_);
  }

  Eigen::VectorXd initial_state() const override { return pack(machine_->initial, layout()); }

  void hold(const Inputs& inputs) override {
    held_.set(inputs, machine_->loads);
    propellant_.hold(inputs);
    const HeldInputs* held = &held_;
    kernel_->hold({&held, 1});
  }

  void derivative(double time, std::span<const double> state, std::span<double> rate,
                  BookRates* books) override {
    if (books != nullptr) return derivative_and_books(time, state, rate, *books);
    kernel_->derivative(time, state.data(), rate.data());
  }
  void derivative_to_book(double time, std::span<const double> state, std::span<double> rate,
                          BookRates& books) override {
    kernel_->derivative_to_book(time, state.data(), rate.data(), &books);
  }
  void settle_books() override { kernel_->settle_books(); }

  void finish_step(std::span<double> state) override { kernel_->finish_step(state.data()); }

  void observe(double time, std::span<const double> state, Observation& seen) override {
    note(time, state, seen);
    sum_up_noted();
  }
  std::size_t summed_at_once() const override { return observer_->lanes(); }
  void note(double time, std::span<const double> state, Observation& seen) override {
    seen.time = time;
    notebook_.add(state, propellant_.shares(time), seen);
  }
  void sum_up_noted() override {
    if (notebook_.noted().empty()) return;
    observer_->observe(notebook_.noted());
    notebook_.clear();
  }

  Eigen::MatrixXd mass_matrix(std::span<const double> state) override {
    Tree tree = machine_->plan.tree;
    set_shares(tree, propellant_.shares(held_.inputs.since));
    VehicleState x;
    unpack(state, layout(), x);
    return dense_mass_matrix(tree, motion_of(tree, x.joint_position, x.joint_rate, x.omega_BN_B),
                             x.q_BN.toRotationMatrix());
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
  // Apart from derivative(), which without it is a jump into the kernel.
  [[gnu::noinline]] void derivative_and_books(double time, std::span<const double> state,
                                              std::span<double> rate, BookRates& books) {
    BsmEngine::derivative_to_book(time, state, rate, books);
    BsmEngine::settle_books();
  }

  std::shared_ptr<const Machine> machine_;
  InstructionSet set_;
  std::unique_ptr<Kernel> kernel_;
  std::unique_ptr<Observer> observer_;
  Notebook notebook_;
  HeldInputs held_;
  PropellantLedger propellant_;  // of observations; the kernel has its own
};

}  // namespace
}  // namespace bsm

std::unique_ptr<Engine> make_bsm_engine(const Model& model, bsm::InstructionSet set) {
  if (model.simulation.translation) return bsm::make_point_mass_engine(model);
  return std::make_unique<bsm::BsmEngine>(std::make_shared<const bsm::Machine>(model), set);
}

}  // namespace twincraft
