// Propellant that leaves as a jet: closed forms of jet damping, a momentum balance that is written
// without forces, the share of every body, and what must stay as it was.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "compiler/analysis/configuration.h"
#include "runtime/bsm/engine.h"
#include "runtime/compare/agreement.h"
#include "runtime/mujoco/engine.h"
#include "runtime/simulate/propagate.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/asked.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

using test::compiled;
using test::derivative_at;
using test::span_of;

Bundle written(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return compiled({"<test>", overrides, "format: spacecraft/1\nname: test\n" + text});
}

/// A vehicle with a jet in every place it can have one.
Bundle every_jet(const std::vector<std::string>& overrides = {}) {
  return compiled({TWINCRAFT_ROOT "/tests/components/vehicles/jet.yaml", overrides});
}

const std::string kNone = "tanks.*.depletion.momentum=none";

std::vector<std::unique_ptr<Engine>> both_engines(const Bundle& bundle) {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(make_bsm_engine(bundle.model));
  engines.push_back(make_mujoco_engine(bundle.model, bundle.text(kMjcf)));
  return engines;
}

Observation end_of(Engine& engine, const Bundle& bundle) {
  const Trajectory run = propagate(engine, bundle.model);
  EXPECT_EQ(run.status, Trajectory::Status::kComplete) << run.failure;
  return run.samples.back();
}

// ---- closed forms

/// Two tanks at radius 1 that drain through a nozzle on the spin axis: what leaves keeps no spin,
/// so the angular momentum stays. All but 18 g of 92.7 kg leave.
const std::string kSpinUp = R"(
hub: {mass: 200 kg, inertia: [90, 95, 104]}
tanks:
  - {name: left, position: [1, 0, 0], shape: {sphere: {radius: 1 mm}}, propellant: 46.35 kg, depletion: {momentum: jet}}
  - {name: right, position: [-1, 0, 0], shape: {sphere: {radius: 1 mm}}, propellant: 46.35 kg, depletion: {momentum: jet}}
thrusters:
  - {name: a, position: [0, 0, -0.7], direction: [0, 0, 1], thrust: 90.8899055925 N, isp: 20 s, tank: left}
  - {name: b, position: [0, 0, -0.7], direction: [0, 0, 1], thrust: 90.8899055925 N, isp: 20 s, tank: right}
initial: {rate: [0, 0, 1]}
simulation: {step: 0.05 s, duration: 100 s}
)";

TEST(Jet, SpinsUpAVehicleThatDrainsThroughItsAxis) {
  const Bundle bundle = written(kSpinUp);
  const double left = bundle.model.tanks.at(0).share(100.0);
  ASSERT_LT(left, 1e-3);
  const double tanks = 92.7 * (1.0 + 0.4e-6);  // [kg m^2] full
  const double ratio = (104.0 + tanks) / (104.0 + left * tanks);
  EXPECT_NEAR(ratio, 1.89134615385, 1e-3);
  for (const auto& engine : both_engines(bundle)) {
    const Vector3d rate = end_of(*engine, bundle).omega_BN_B;
    EXPECT_NEAR(rate.z(), ratio, 1e-10) << engine->name();
    EXPECT_LT(rate.head<2>().norm(), 1e-12) << engine->name();
  }
}

TEST(Jet, LeavesTheSpinAloneWithoutTheKey) {
  const Bundle bundle = written(kSpinUp, {"tanks.*.depletion=null"});
  for (const auto& engine : both_engines(bundle))
    EXPECT_NEAR(end_of(*engine, bundle).omega_BN_B.z(), 1.0, 1e-12) << engine->name();
}

/// 50 of 100 kg leave at 1 kg/s, l = 1.5 m aft of the centre of mass.
std::string damped_motor(const std::string& radius) {
  return R"(
hub: {mass: 50 kg, inertia: [60, 60, 30]}
tanks: [{name: motor, shape: {sphere: {radius: )" +
         radius + R"(}}, propellant: 100 kg, depletion: {momentum: jet}}]
thrusters: [{name: nozzle, position: [0, 0, -1.5], direction: [0, 0, 1], thrust: 980.665 N, isp: 100 s, tank: motor}]
initial: {rate: [0.03, 0.04, 0]}
simulation: {step: 0.05 s, duration: 50 s}
)";
}

/// I w' = -(I' + mdot l^2) w gives w = w0 (I/I0)^((l^2 - k)/k), and exp(-mdot l^2 t/I) for k = 0.
TEST(Jet, DampsTheTransverseRateOfAMotor) {
  for (const auto& [radius, ratio] :
       std::map<std::string, double>{{"0.4 m", 0.185060718577}, {"1 um", 0.153354966845}}) {
    const Bundle bundle = written(damped_motor(radius));
    for (const auto& engine : both_engines(bundle)) {
      const Vector3d rate = end_of(*engine, bundle).omega_BN_B;
      EXPECT_LT((rate - ratio * Vector3d(0.03, 0.04, 0.0)).norm(), 1e-12) << engine->name();
    }
  }
}

TEST(Jet, ChangesNothingOfARocketThatDoesNotTurn) {
  const std::string rocket = TWINCRAFT_ROOT "/models/gallery/rocket.yaml";
  const Bundle quiet = compiled({rocket, {}});
  const Bundle jet = compiled({rocket, {"tanks.*.depletion.momentum=jet"}});
  ASSERT_EQ(jet.model.nozzles.size(), 1u);
  const auto without = both_engines(quiet), with = both_engines(jet);
  for (std::size_t i = 0; i < with.size(); ++i) {
    const Observation a = end_of(*without[i], quiet), b = end_of(*with[i], jet);
    EXPECT_EQ(a.v_CN_N, b.v_CN_N);
    EXPECT_EQ(a.r_CN_N, b.r_CN_N);
  }
}

// ---- an integrator of its own, for one rigid body with its nozzle anywhere

/// Momentum and angular momentum about the inertial origin are the state; they change by the thrust
/// and by what leaves and what is on its way, not by any force of a jet.
struct RigidRocket {
  MassElement dry;
  MassElement full;  // what the tank holds at t = 0
  double flow;       // [kg/s]
  Vector3d nozzle_B, thrust_B;

  struct State {
    Vector3d r_BN, p, H;
    Eigen::Vector4d q;  // scalar first
    State plus(double h, const State& d) const {
      return {r_BN + h * d.r_BN, p + h * d.p, H + h * d.H, q + h * d.q};
    }
  };
  struct Motion {
    Matrix3d dcm_NB;
    Vector3d v_BN, omega_N;
    double mass;
  };

  MassProperties body(double time) const {
    MassElement left = full;
    const double share = 1.0 - flow * time / full.mass;
    left.mass *= share;
    left.I_PntE_L *= share;
    return properties_of(dry) + properties_of(left);
  }
  Motion motion(double time, const State& x) const {
    const MassProperties now = body(time);
    const Matrix3d dcm = Quaterniond(x.q[0], x.q[1], x.q[2], x.q[3]).normalized().matrix();
    const Vector3d c = dcm * now.r_CL_L;
    const Vector3d H_PntC = x.H - (x.r_BN + c).cross(x.p);
    const Vector3d omega = dcm * now.I_PntC_L.ldlt().solve(dcm.transpose() * H_PntC);
    return {dcm, x.p / now.mass - omega.cross(c), omega, now.mass};
  }
  /// The centre of mass at rest at the origin.
  State start(const Vector3d& omega) const {
    const MassProperties now = body(0.0);
    return {-now.r_CL_L, Vector3d::Zero(), now.I_PntC_L * omega, Eigen::Vector4d::Unit(0)};
  }
  State rate(double time, const State& x) const {
    const Motion m = motion(time, x);
    const Vector3d to_nozzle = m.dcm_NB * nozzle_B, to_tank = m.dcm_NB * full.r_EL_L;
    const Vector3d r_e = x.r_BN + to_nozzle, r_t = x.r_BN + to_tank;
    const Vector3d v_e = m.v_BN + m.omega_N.cross(to_nozzle);
    const Vector3d v_t = m.v_BN + m.omega_N.cross(to_tank);
    const Vector3d F = m.dcm_NB * thrust_B;
    // In the line: flow (r_e - r_t), and flow r_t x r_e about the origin.
    const Vector3d p_dot = F - flow * v_e - flow * (v_e - v_t);
    const Vector3d H_dot =
        r_e.cross(F) - flow * r_e.cross(v_e) - flow * (v_t.cross(r_e) + r_t.cross(v_e));
    const Vector3d w = m.dcm_NB.transpose() * m.omega_N;
    const Quaterniond turn =
        Quaterniond(x.q[0], x.q[1], x.q[2], x.q[3]) * Quaterniond(0.0, w.x(), w.y(), w.z());
    return {m.v_BN, p_dot, H_dot, 0.5 * Eigen::Vector4d(turn.w(), turn.x(), turn.y(), turn.z())};
  }
  State fly(State x, double duration, int steps) const {
    const double h = duration / steps;
    for (int i = 0; i < steps; ++i) {
      const double t = i * h;
      const State a = rate(t, x), b = rate(t + 0.5 * h, x.plus(0.5 * h, a));
      const State c = rate(t + 0.5 * h, x.plus(0.5 * h, b)), d = rate(t + h, x.plus(h, c));
      x = x.plus(h / 6.0, a).plus(h / 3.0, b).plus(h / 3.0, c).plus(h / 6.0, d);
    }
    return x;
  }
};

TEST(Jet, MovesARigidBodyAsItsMomentumBalanceSays) {
  const Bundle bundle = written(R"(
hub: {mass: 100 kg, inertia: [[40, 3, -2], [3, 55, 4], [-2, 4, 30]], center_of_mass: [0.1, -0.05, 0.2]}
tanks: [{name: main, position: [0.4, 0.3, -0.2], shape: {cylinder: {radius: 0.3 m, length: 0.8 m, axis: [1, 2, 2]}}, propellant: 80 kg, depletion: {momentum: jet}}]
thrusters: [{name: nozzle, position: [-0.6, 0.8, -1.1], direction: [0, 0, 1], thrust: 0.14709975 N, isp: 0.01 s, tank: main}]
initial: {rate: [0.3, -0.2, 0.25]}
simulation: {step: 0.01 s, duration: 40 s}
)");
  const std::vector<MassElement>& elements = bundle.model.assembly.links.at(0).elements;
  ASSERT_EQ(elements.size(), 2u);
  const RigidRocket rocket{elements[0], elements[1], 1.5, Vector3d(-0.6, 0.8, -1.1),
                           Vector3d(0.0, 0.0, 0.14709975)};
  const RigidRocket::State end = rocket.fly(rocket.start({0.3, -0.2, 0.25}), 40.0, 8000);
  const RigidRocket::Motion motion = rocket.motion(40.0, end);
  for (const auto& engine : both_engines(bundle)) {
    const Observation seen = end_of(*engine, bundle);
    const Vector3d omega_B = motion.dcm_NB.transpose() * motion.omega_N;
    EXPECT_NEAR(seen.mass, motion.mass, 1e-12 * motion.mass);
    // RK4 leaves 1e-11 at these steps.
    EXPECT_LT((seen.omega_BN_B - omega_B).norm(), 1e-10) << engine->name();
    EXPECT_LT((seen.r_BN_N - end.r_BN).norm(), 1e-8) << engine->name();
    EXPECT_LT((seen.q_BN.matrix() - motion.dcm_NB).norm(), 1e-9) << engine->name();
  }
}

// ---- bodies that move against each other

/// A stream from one element to one nozzle, seen in inertial axes.
struct Stream {
  double flow;
  Vector3d r_P, v_P, r_E, v_E;
  int link_P, link_E;
  Vector3d r_P_L, r_E_L;
  Matrix3d k_L;
};

std::vector<Stream> streams_of(const Model& model, const RandomState& x) {
  const Assembly& assembly = model.assembly;
  const auto links = configuration(assembly, x.joint_position, x.joint_rate);
  const Matrix3d dcm_NB = x.q_BN.matrix();
  const auto place = [&](int link, const Vector3d& r_L) -> Vector3d {
    const LinkMotion& at = links.at(static_cast<std::size_t>(link));
    return at.r_LB_B + at.dcm_BL * r_L;
  };
  const auto velocity = [&](int link, const Vector3d& r_L) -> Vector3d {
    const LinkMotion& at = links.at(static_cast<std::size_t>(link));
    const Vector3d seen_in_B = at.v_LB_B + at.omega_LB_B.cross(at.dcm_BL * r_L);
    return x.v_BN_N + dcm_NB * (seen_in_B + x.omega_BN_B.cross(place(link, r_L)));
  };
  std::vector<Stream> streams;
  for (const Nozzle& nozzle : model.nozzles) {
    for (int link = 0; link < static_cast<int>(assembly.links.size()); ++link) {
      for (const MassElement& e : assembly.links[static_cast<std::size_t>(link)].elements) {
        if (e.tank != nozzle.tank) continue;
        const double part = e.mass / model.tanks.at(static_cast<std::size_t>(e.tank)).content;
        streams.push_back({part * nozzle.mass_flow.at(x.time),
                           x.r_BN_N + dcm_NB * place(nozzle.link, nozzle.r_PL_L),
                           velocity(nozzle.link, nozzle.r_PL_L),
                           x.r_BN_N + dcm_NB * place(link, e.r_EL_L), velocity(link, e.r_EL_L),
                           nozzle.link, link, nozzle.r_PL_L, e.r_EL_L, e.I_PntE_L / e.mass});
      }
    }
  }
  return streams;
}

struct Momenta {
  Vector3d p, H;  // about the inertial origin
};

Momenta momenta(Engine& engine, double time, const Eigen::VectorXd& x) {
  const Observation o = engine.observe(time, span_of(x));
  return {o.momentum, o.H_PntC_N + o.r_CN_N.cross(o.momentum)};
}

/// How fast momenta change along the motion: central differences of fourth order.
Momenta momenta_rate(Engine& engine, const RandomState& state) {
  const Eigen::VectorXd x = pack(state, engine.layout());
  const Eigen::VectorXd rate = derivative_at(engine, state.time, x);
  constexpr double h = 2e-3;
  const auto difference = [&](double d) -> Momenta {
    const Momenta a = momenta(engine, state.time + d, x + d * rate);
    const Momenta b = momenta(engine, state.time - d, x - d * rate);
    return {(a.p - b.p) / (2.0 * d), (a.H - b.H) / (2.0 * d)};
  };
  const Momenta near = difference(h), far = difference(2.0 * h);
  return {(4.0 * near.p - far.p) / 3.0, (4.0 * near.H - far.H) / 3.0};
}

/// In the middle of a phase of constant flow.
std::vector<RandomState> burning_states(const Model& model) {
  std::vector<RandomState> states = random_states(model, 20);
  for (RandomState& state : states) state.time = 4.0;
  return states;
}

TEST(Jet, TakesTheMomentumOfTheNozzleAlongWhateverTheBodies) {
  const Bundle bundle = every_jet({"thrusters.kicker.tank=null"});
  for (const auto& engine : both_engines(bundle)) {
    for (const RandomState& state : burning_states(bundle.model)) {
      engine->hold(inputs_at(bundle.model, state.time));
      Momenta expected{Vector3d::Zero(), Vector3d::Zero()};
      const auto links =
          configuration(bundle.model.assembly, state.joint_position, state.joint_rate);
      for (const Load& load : bundle.model.loads) {
        const LinkMotion& at = links.at(static_cast<std::size_t>(load.link));
        const Vector3d F_L(load.force_L[0].at(4.0), load.force_L[1].at(4.0),
                           load.force_L[2].at(4.0));
        const Vector3d F = state.q_BN * (at.dcm_BL * F_L);
        const Vector3d r =
            state.r_BN_N + state.q_BN * (at.r_LB_B + at.dcm_BL * load.r_FL_L.value());
        expected.p += F;
        expected.H += r.cross(F);
      }
      for (const Stream& s : streams_of(bundle.model, state)) {
        expected.p -= s.flow * (s.v_P + (s.v_P - s.v_E));
        expected.H -= s.flow * (s.r_P.cross(s.v_P) + s.v_E.cross(s.r_P) + s.r_E.cross(s.v_P));
      }
      const Momenta found = momenta_rate(*engine, state);
      // Differences of momenta of 100 kg m/s over 2 ms.
      EXPECT_LT((found.p - expected.p).norm(), 1e-7 * expected.p.norm()) << engine->name();
      EXPECT_LT((found.H - expected.H).norm(), 1e-7 * expected.H.norm()) << engine->name();
    }
  }
}

/// Generalised forces on (v_B, omega, joints) of the stream that lies evenly along its line and
/// feels 2 flow (v_P - v_E) there, from partial derivatives of its places, by differences.
Eigen::VectorXd stream_forces(const Model& model, const RandomState& state) {
  const auto joints = static_cast<Eigen::Index>(state.joint_position.size());
  const auto wheels = static_cast<Eigen::Index>(state.wheel_rate.size());
  Eigen::VectorXd Q = Eigen::VectorXd::Zero(6 + joints + wheels);
  const std::vector<Stream> streams = streams_of(model, state);
  const auto links = configuration(model.assembly, state.joint_position, state.joint_rate);
  for (const Stream& s : streams) {
    const Vector3d f = -s.flow * (s.v_P - s.v_E);
    const LinkMotion& from = links.at(static_cast<std::size_t>(s.link_E));
    const Vector3d omega_L = from.dcm_BL.transpose() * (state.omega_BN_B + from.omega_LB_B);
    const Vector3d torque_B = from.dcm_BL * (s.flow * s.k_L * omega_L);
    const Vector3d f_B = state.q_BN.conjugate() * f;
    const Vector3d arms_B = state.q_BN.conjugate() * (s.r_P + s.r_E - 2.0 * state.r_BN_N);
    Q.head<3>() += 2.0 * f;
    Q.segment<3>(3) += arms_B.cross(f_B) + torque_B;
    for (Eigen::Index i = 0; i < joints; ++i) {
      std::vector<double> unit(state.joint_position.size(), 0.0);
      unit[static_cast<std::size_t>(i)] = 1.0;
      const auto turning = configuration(model.assembly, state.joint_position, unit);
      Q[6 + i] += torque_B.dot(turning.at(static_cast<std::size_t>(s.link_E)).omega_LB_B);
      const auto places = [&](double d) -> Vector3d {
        std::vector<double> q = state.joint_position;
        q[static_cast<std::size_t>(i)] += d;
        const auto at = configuration(model.assembly, q, state.joint_rate);
        const LinkMotion& P = at.at(static_cast<std::size_t>(s.link_P));
        const LinkMotion& E = at.at(static_cast<std::size_t>(s.link_E));
        return P.r_LB_B + P.dcm_BL * s.r_P_L + E.r_LB_B + E.dcm_BL * s.r_E_L;
      };
      constexpr double h = 1e-4;
      Q[6 + i] += f_B.dot((places(h) - places(-h)) / (2.0 * h));
    }
  }
  return Q;
}

TEST(Jet, PushesEveryBodyByItsShareOfTheStream) {
  const Bundle jet = every_jet(), quiet = every_jet({kNone});
  const auto with = both_engines(jet), without = both_engines(quiet);
  for (std::size_t i = 0; i < with.size(); ++i) {
    for (const RandomState& state : burning_states(jet.model)) {
      const StateLayout& layout = with[i]->layout();
      const Eigen::VectorXd x = pack(state, layout);
      with[i]->hold(inputs_at(jet.model, state.time));
      without[i]->hold(inputs_at(quiet.model, state.time));
      const Eigen::VectorXd change =
          accelerations_of(derivative_at(*with[i], state.time, x), layout) -
          accelerations_of(derivative_at(*without[i], state.time, x), layout);
      const Eigen::VectorXd Q = stream_forces(jet.model, state);
      const Eigen::VectorXd found = with[i]->mass_matrix(span_of(x)) * change;
      ASSERT_GT(Q.norm(), 0.1);
      // Central differences over 1e-4.
      EXPECT_LT((found - Q).norm(), 1e-7 * Q.norm()) << with[i]->name();
    }
  }
}

// ---- in flight

TEST(Jet, FliesAlikeInBothEngines) {
  const Bundle bundle = every_jet();
  const auto engines = both_engines(bundle);
  const Trajectory a = propagate(*engines[0], bundle.model);
  const Trajectory b = propagate(*engines[1], bundle.model);
  const Trajectory quiet = propagate(*both_engines(every_jet({kNone}))[0], bundle.model);
  const Comparison alike = compare(bundle.model, a, b);
  const Comparison other = compare(bundle.model, a, quiet);
  ASSERT_EQ(alike.metrics.at(0).key, "attitude_deg");
  // RK4 errs differently in MRPs and quaternions.
  EXPECT_LT(alike.metrics.at(0).maximum, 1e-6);
  EXPECT_GT(other.metrics.at(0).maximum, 1.0);
}

TEST(Jet, FliesAlikeToRoundingInOneChart) {
  const Bundle bundle = every_jet({"engines.bsm.attitude=quaternion"});
  const auto engines = both_engines(bundle);
  const Comparison alike = compare(bundle.model, propagate(*engines[0], bundle.model),
                                   propagate(*engines[1], bundle.model));
  for (const Metric& metric : alike.metrics) EXPECT_LT(metric.maximum, 1e-10) << metric.key;
}

TEST(Jet, KeepsTheOrderOfTheIntegrator) {
  Bundle bundle = every_jet();
  for (const auto& engine : both_engines(bundle)) {
    const auto end = [&](double step) {
      bundle.model.simulation.step = step;
      const Observation last = end_of(*engine, bundle);
      Eigen::VectorXd state(6);
      state << last.omega_BN_B, last.v_BN_N;
      return state;
    };
    // 0.033 s divides neither the burns nor the run: steps are split at every event.
    const Eigen::VectorXd truth = end(0.033 / 8.0);
    const double ratio = (end(0.033) - truth).norm() / (end(0.0165) - truth).norm();
    EXPECT_GT(ratio, 12.0) << engine->name();
    EXPECT_LT(ratio, 24.0) << engine->name();
  }
}

TEST(Jet, TakesNothingFromTheHeapInADerivative) {
  const Bundle bundle = every_jet();
  for (const auto& engine : both_engines(bundle)) {
    const Eigen::VectorXd x = engine->initial_state();
    Eigen::VectorXd rate(x.size());
    const auto size = static_cast<std::size_t>(x.size());
    InputFeed feed(bundle.model);
    engine->derivative(0.0, {x.data(), size}, {rate.data(), size});
    const long before = test::allocation_count();
    for (int i = 0; i < 100; ++i) {
      engine->hold(feed.begin(0.07 * i));
      engine->derivative(0.07 * i, {x.data(), size}, {rate.data(), size});
    }
    EXPECT_EQ(test::allocation_count() - before, 0) << engine->name();
  }
}

/// Between burns nothing of the last push is left.
TEST(Jet, EndsWithTheBurn) {
  const Bundle jet = every_jet({"thrusters.*.during=[[0, 3]]"});
  const Bundle quiet = every_jet({"thrusters.*.during=[[0, 3]]", kNone});
  const auto with = both_engines(jet), without = both_engines(quiet);
  for (std::size_t i = 0; i < with.size(); ++i) {
    const Eigen::VectorXd x = with[i]->initial_state();
    with[i]->hold(inputs_at(jet.model, 1.0));
    without[i]->hold(inputs_at(quiet.model, 1.0));
    EXPECT_NE(derivative_at(*with[i], 1.0, x), derivative_at(*without[i], 1.0, x));
    with[i]->hold(inputs_at(jet.model, 3.0));
    without[i]->hold(inputs_at(quiet.model, 3.0));
    EXPECT_EQ(derivative_at(*with[i], 3.0, x), derivative_at(*without[i], 3.0, x));
  }
}

}  // namespace
}  // namespace twincraft
