#include "runtime/bsm/recording.h"

#include <algorithm>
#include <vector>

#include "runtime/bsm/vehicle.h"
#include "runtime/engine/state.h"
#include "runtime/scalar/recorder.h"

namespace twincraft::bsm {
namespace {

using ::twincraft::TWINCRAFT_KERNEL::Recorded;
using ::twincraft::TWINCRAFT_KERNEL::Vec;
using Held = HeldInputsIn<Recorded>;

StateLayout layout_of(const Model& model) {
  return {model.engines.attitude, static_cast<int>(model.assembly.links.size()) - 1,
          static_cast<int>(model.assembly.rotors.size()), model.simulation.translation};
}

void run_vehicle(const Model& model, const InputsIn<Recorded>& inputs, const Recorded& time,
                 const Recorded* state, Recorded* rate) {
  const Plan plan = make_plan(model.assembly, model.engines.attitude, model.gravity, model.loads,
                              model.engines.chains, model.forces);
  const Plan* of = &plan;
  TWINCRAFT_KERNEL::Vehicle<Recorded, Recorded> vehicle({&of, 1});
  Held held = Held::none(model.assembly);
  held.set(inputs, model.loads);
  const Held* lane = &held;
  vehicle.hold({&lane, 1});
  vehicle.derivative(time, state, rate);
}

/// As of PointMassEngine and what makes it the analytic one.
void run_point_mass(const Model& model, const InputsIn<Recorded>& inputs, const Recorded* state,
                    Recorded* rate) {
  MassProperties sum;
  for (const MassElement& element : model.assembly.links.front().elements)
    sum = sum + properties_of(element);
  Vec<Recorded> force, a, r_CB;
  for (int load = 0; load < inputs.layout.loads; ++load) {
    const int at = inputs.layout.force(load);
    force += Vec<Recorded>{inputs[at], inputs[at + 1], inputs[at + 2]};
  }
  set_lane(r_CB, 0, sum.r_CL_L);
  if (model.gravity.bsm != GravityLaw::kNone && model.gravity.mu != 0.0) {
    const Vec<Recorded> r_BN{state[0], state[1], state[2]};
    a = TWINCRAFT_KERNEL::Field<Recorded>(model.gravity.mu, r_BN + r_CB, false).at_hub();
  }
  const Recorded mass = sum.mass;
  a += Vec<Recorded>{force.x / mass, force.y / mass, force.z / mass};
  std::copy_n(state + 3, 3, rate);
  rate[3] = a.x;
  rate[4] = a.y;
  rate[5] = a.z;
}

}  // namespace

RecordedInputs::RecordedInputs(const Model& model)
    : states(static_cast<std::size_t>(layout_of(model).size())),
      inputs(static_cast<std::size_t>(InputLayout(model).size())),
      tanks(model.tanks.size()) {}

void RecordedInputs::put(const Inputs& held, std::span<double> in) const {
  std::ranges::copy(held.u, in.begin() + static_cast<std::ptrdiff_t>(u(0)));
  in[since()] = held.since;
  for (std::size_t i = 0; i < tanks; ++i) {
    const Drain& drain = held.tanks[i];
    in[tank(i)] = drain.full;
    in[tank(i) + 1] = drain.spent;
    in[tank(i) + 2] = drain.since;
    in[tank(i) + 3] = drain.flow;
  }
}

Tape recorded_derivative(const Model& model) {
  const RecordedInputs at(model);
  Tape tape;
  std::vector<Recorded> in;
  for (std::size_t i = 0; i < at.size(); ++i) in.push_back(Recorded::input(tape));
  InputsIn<Recorded> inputs;
  inputs.layout = InputLayout(model);
  inputs.since = in[at.since()];
  for (std::size_t i = 0; i < at.inputs; ++i) inputs.u.push_back(in[at.u(i)]);
  for (std::size_t i = 0; i < at.tanks; ++i) {
    const Recorded* tank = &in[at.tank(i)];
    inputs.tanks.push_back({tank[0], tank[1], tank[2], tank[3]});
  }
  std::vector<Recorded> rate(at.states);
  const Recorded* state = &in[at.state(0)];
  if (model.simulation.translation)
    run_point_mass(model, inputs, state, rate.data());
  else
    run_vehicle(model, inputs, in[at.time()], state, rate.data());
  for (const Recorded& number : rate) number.output(tape);
  return tape;
}

}  // namespace twincraft::bsm
