// Our integrators against two that others wrote, on the engines' own derivatives: Boost.odeint's
// controlled Runge-Kutta-Fehlberg 7(8), and CVODE, whose Adams method is no Runge-Kutta at all.
#include <cvode/cvode.h>
#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_fehlberg78.hpp>
#include <boost/numeric/odeint/stepper/generation/make_controlled.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <memory>

#include "runtime/bsm/engine.h"
#include "runtime/mujoco/engine.h"
#include "runtime/simulate/propagate.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

using State = std::vector<double>;

std::vector<double> initial_state(Engine& engine) {
  const Eigen::VectorXd start = engine.initial_state();
  return {start.begin(), start.end()};
}

/// Neither knows that a quaternion has a norm: it is made a unit at the end.
Observation observe(Engine& engine, double time, State state) {
  engine.finish_step(state);
  return engine.observe(time, state);
}

Observation by_odeint(Engine& engine, double duration, double tolerance) {
  namespace odeint = boost::numeric::odeint;
  State state = initial_state(engine);
  const auto rate = [&engine](const State& y, State& dy, double t) { engine.derivative(t, y, dy); };
  odeint::integrate_adaptive(
      odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(tolerance, tolerance), rate,
      state, 0.0, duration, 1.0e-2);
  return observe(engine, duration, state);
}

int rate_for_cvode(realtype t, N_Vector y, N_Vector dy, void* engine) {
  const auto size = static_cast<std::size_t>(N_VGetLength_Serial(y));
  static_cast<Engine*>(engine)->derivative(t, {N_VGetArrayPointer(y), size},
                                           {N_VGetArrayPointer(dy), size});
  return 0;
}

/// What SUNDIALS makes, freed as it wants it.
template <class T, class Free>
std::unique_ptr<std::remove_pointer_t<T>, Free> owned(T made, Free free) {
  return {made, free};
}

Observation by_cvode(Engine& engine, double duration, double tolerance) {
  State state = initial_state(engine);
  SUNContext context = nullptr;
  EXPECT_EQ(SUNContext_Create(nullptr, &context), 0);
  const auto keep = owned(context, [](SUNContext made) { SUNContext_Free(&made); });
  const auto y = owned(
      N_VMake_Serial(static_cast<sunindextype>(state.size()), state.data(), context), N_VDestroy);
  const auto solver = owned(SUNNonlinSol_FixedPoint(y.get(), 0, context), SUNNonlinSolFree);
  const auto memory = owned(CVodeCreate(CV_ADAMS, context), [](void* made) { CVodeFree(&made); });
  EXPECT_EQ(CVodeInit(memory.get(), rate_for_cvode, 0.0, y.get()), CV_SUCCESS);
  EXPECT_EQ(CVodeSStolerances(memory.get(), tolerance, tolerance), CV_SUCCESS);
  EXPECT_EQ(CVodeSetNonlinearSolver(memory.get(), solver.get()), CV_SUCCESS);
  EXPECT_EQ(CVodeSetUserData(memory.get(), &engine), CV_SUCCESS);
  EXPECT_EQ(CVodeSetMaxNumSteps(memory.get(), 1'000'000), CV_SUCCESS);
  EXPECT_EQ(CVodeSetStopTime(memory.get(), duration), CV_SUCCESS);
  double reached = 0.0;
  EXPECT_GE(CVode(memory.get(), duration, y.get(), &reached, CV_NORMAL), 0);
  EXPECT_EQ(reached, duration);
  return observe(engine, duration, state);
}

struct Vehicle {
  std::string file;
  double duration;  // [s] without events
};
void PrintTo(const Vehicle& one, std::ostream* out) { *out << one.file; }

class Integrators : public testing::TestWithParam<Vehicle> {
 protected:
  void SetUp() override {
    bundle = test::compiled_file(
        GetParam().file, {"engines.bsm.attitude=quaternion", "simulation.integrator=rkf78",
                          "simulation.tolerance=1.0e-13", "simulation.step=1", "references=[]",
                          "simulation.duration=" + std::to_string(GetParam().duration)});
    engines.push_back(make_bsm_engine(bundle.model));
    engines.push_back(make_mujoco_engine(bundle.model, bundle.text(kMjcf)));
  }

  static void expect_same(const Observation& a, const Observation& b, double bound) {
    EXPECT_LT((a.omega_BN_B - b.omega_BN_B).norm(), bound);
    EXPECT_LT((a.q_BN.conjugate() * b.q_BN).vec().norm(), bound);
    EXPECT_LT((a.r_CN_N - b.r_CN_N).norm(), bound * std::max(1.0, a.r_CN_N.norm()));
    EXPECT_LT((a.v_CN_N - b.v_CN_N).norm(), bound * std::max(1.0, a.v_CN_N.norm()));
    for (std::size_t i = 0; i < a.joint_position.size(); ++i) {
      EXPECT_LT(std::abs(a.joint_position[i] - b.joint_position[i]), bound);
      EXPECT_LT(std::abs(a.joint_rate[i] - b.joint_rate[i]), bound);
    }
    for (std::size_t i = 0; i < a.wheel_rate.size(); ++i)
      EXPECT_LT(std::abs(a.wheel_rate[i] - b.wheel_rate[i]), bound * 100.0);
  }

  Bundle bundle;
  std::vector<std::unique_ptr<Engine>> engines;
};

TEST_P(Integrators, EndWhereBoostDoes) {
  for (const auto& engine : engines) {
    const Observation ours = propagate(*engine, bundle.model).samples.back();
    // Local errors of 1e-13, some hundred steps of either.
    expect_same(ours, by_odeint(*engine, GetParam().duration, 1.0e-13), 2.0e-10);
  }
}

TEST_P(Integrators, EndWhereCvodeDoes) {
  for (const auto& engine : engines) {
    const Observation ours = propagate(*engine, bundle.model).samples.back();
    // A multistep method's steps are smaller and more: some ten thousand local errors of 1e-12.
    expect_same(ours, by_cvode(*engine, GetParam().duration, 1.0e-12), 2.0e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Integrators,
                         testing::Values(Vehicle{"models/quickstart.yaml", 30.0},
                                         Vehicle{"models/gallery/tumble.yaml", 200.0},
                                         Vehicle{"models/nesc/case_10a.yaml", 3000.0},
                                         Vehicle{"tests/components/vehicles/arm_in_orbit.yaml",
                                                 10.0},
                                         Vehicle{"tests/components/vehicles/burn.yaml", 2.0}),
                         [](const auto& one) {
                           const std::string stem =
                               one.param.file.substr(one.param.file.rfind('/') + 1);
                           return stem.substr(0, stem.find('.'));
                         });

}  // namespace
}  // namespace twincraft
