// See basilisk_bsm_code.h. Tested by tests/compiler/basilisk_test.cpp, and flown by tests/basilisk.
#include "compiler/emit/basilisk_bsm_code.h"

#include <string_view>

#include "compiler/emit/python_text.h"

namespace twincraft {
namespace {

constexpr std::string_view kBegin = R"py(
    def bsm(self):
        """A Spacecraft with effectors, solved by back-substitution."""
        self.body = spacecraft.Spacecraft()
        self.seen = self.body.scStateOutMsg
        self.whole = lambda seen: ([*seen.r_CN_N, *seen.v_CN_N], self.body.scMassOutMsg.read().massSC)
        self.states = {"@position@": ("hubPosition", 0), "v_BN_N": ("hubVelocity", 0)@turning@}
        self.body.hub.mHub, self.body.hub.r_BcB_B, self.body.hub.IHubPntBc_B = HUB
)py";
constexpr std::string_view kTurning =
    R"py(,
                       "sigma_BN": ("hubSigma", 0), "omega_BN_B": ("hubOmega", 0))py";

constexpr std::string_view kPoint = R"py(        self.body.pointMassTranslationalOnly = True
)py";

constexpr std::string_view kWheels =
    R"py(        wheels = reactionWheelStateEffector.ReactionWheelStateEffector()
        wheels.setMaxWheelAcceleration(1e300)  # a motor gives what it is told
        wheels.setLargeTorqueThreshold(1e300)
        wheels.nameOfReactionWheelOmegasState = "wheels.Omega"
        for row, (name, (axis, inertia)) in enumerate(WHEELS.items()):
            wheel = reactionWheelStateEffector.RWConfigPayload()
            wheel.gsHat_B, wheel.Js = axis, inertia
            wheels.addReactionWheel(wheel)
            self.parts[name] = wheels
            self.states[name + ".rate"] = ("wheels.Omega", row)
)py";
constexpr std::string_view kWheelMotors =
    R"py(        self.link(wheels.rwMotorCmdInMsg, "ArrayMotorTorque",
                  lambda u: {"motorTorque": [u.get(name + ".torque", 0) for name in WHEELS]})
)py";

constexpr std::string_view kAddAll =
    R"py(        self.modules = list(dict.fromkeys(self.parts.values()))
        for effector in self.modules:
            self.body.addStateEffector(effector)
)py";

// Hinges and slides differ in names alone.
constexpr std::string_view kChains = R"py(        for name, links in @TABLE@.items():
            chain = @module@.@Chain@()
            chain.setNameOf@Theta@State(name + ".@theta@")
            chain.setNameOf@Theta@DotState(name + ".@theta@Dot")
            for row, (link, keys) in enumerate(links.items()):
                body = @module@.@Body@()
                for key, value in keys.items():
                    getattr(body, "set" + key)(value)
                chain.add@Body@(body)
                self.states |= {link + ".position": (name + ".@theta@", row), link + ".rate": (name + ".@theta@Dot", row)}
)py";
constexpr std::string_view kRests = R"py(                if link in RESTS:
                    rest = messaging.@Reference@MsgPayload(@theta@=RESTS[link])
                    self.kept.append(messaging.@Reference@Msg().write(rest))
                    chain.@body@RefInMsgs[row].subscribeTo(self.kept[-1])
)py";
constexpr std::string_view kEndOfChain =
    R"py(            self.parts |= dict.fromkeys([name, *links], chain)
)py";
constexpr std::string_view kChainMotors = R"py(            if name in DRIVEN:
                self.link(chain.motor@Effort@InMsg, "ArrayMotor@Effort@", lambda u, links=links: {
                    "motor@Effort@": [u.get(link + ".@effort@", 0) for link in links]})
)py";

const Words kHingeWords = {{"@TABLE@", "HINGES"},
                           {"@module@", "spinningBodyNDOFStateEffector"},
                           {"@Chain@", "SpinningBodyNDOFStateEffector"},
                           {"@Body@", "SpinningBody"},
                           {"@body@", "spinningBody"},
                           {"@Theta@", "Theta"},
                           {"@theta@", "theta"},
                           {"@Reference@", "HingedRigidBody"},
                           {"@Effort@", "Torque"},
                           {"@effort@", "torque"}};
const Words kSlideWords = {{"@TABLE@", "SLIDES"},
                           {"@module@", "linearTranslationNDOFStateEffector"},
                           {"@Chain@", "LinearTranslationNDOFStateEffector"},
                           {"@Body@", "TranslatingBody"},
                           {"@body@", "translatingBody"},
                           {"@Theta@", "Rho"},
                           {"@theta@", "rho"},
                           {"@Reference@", "LinearTranslationRigidBody"},
                           {"@Effort@", "Force"},
                           {"@effort@", "force"}};

constexpr std::string_view kTanks = R"py(        for name, keys in TANKS.items():
            self.add_tank(name, **keys)
)py";
constexpr std::string_view kAddTank = R"py(
    def add_tank(self, name, mass, r_TB_B, radius, length=None, dcm_TB=None):
        tank = fuelTank.FuelTank()
        solid = fuelTank.FuelTankModelUniformBurn() if length else fuelTank.FuelTankModelConstantVolume()
        if length:
            solid.lengthTank = length
            tank.setDcm_TB(dcm_TB)
        solid.propMassInit = mass
        solid.radiusTankInit = radius
        solid.r_TcT_TInit = [0, 0, 0]
        tank.setTankModel(solid)
        tank.setR_TB_B(r_TB_B)
        tank.setNameOfMassState(name + ".mass")
        self.kept.append(solid)
        self.holds.append(lambda now: tank.setFuelLeakRate(self.acting.get(name + ".flow", 0)))
        self.parts[name] = tank
)py";

constexpr std::string_view kParticles = R"py(        for name, keys in PARTICLES.items():
            self.add_slosh(name, linearSpringMassDamper.LinearSpringMassDamper(), keys, {"": "Rho"})
)py";
constexpr std::string_view kPendulums = R"py(        for name, keys in PENDULUMS.items():
            angles = {".phi": "Phi", ".theta": "Theta"}
            self.add_slosh(name, sphericalPendulum.SphericalPendulum(), keys, angles)
)py";
constexpr std::string_view kAddSlosh = R"py(
    def add_slosh(self, name, slosh, keys, coordinates):
        for key, value in keys.items():
            setattr(slosh, key, value)
        slosh.nameOfMassState = name + ".mass"
        for suffix, word in coordinates.items():
            position, rate = name + suffix + ".position", name + suffix + ".rate"
            setattr(slosh, f"nameOf{word}State", position)
            setattr(slosh, f"nameOf{word}DotState", rate)
            self.states |= {position: (position, 0), rate: (rate, 0)}
        if name in TANK_OF:
            self.parts[TANK_OF[name]].pushFuelSloshParticle(slosh)
        self.parts[name] = slosh
)py";

constexpr std::string_view kLoads = R"py(        for name, place in LOADS.items():
            self.add_load(name, **place)
)py";
constexpr std::string_view kAddLoad = R"py(
    def add_load(self, name, on, at):
        load = self.parts[name] = extForceTorque.ExtForceTorque()
        self.modules.append(load)
        if on:
            self.parts[on[0]].addDynamicEffector(load, on[1])
        else:
            self.body.addDynamicEffector(load)

        def hold(now):
            force, torque = (self.acting.get(name + kind, [0, 0, 0]) for kind in (".force", ".torque"))
            load.extForce_B = force
            load.extTorquePntB_B = np.add(torque, np.cross(at, force))
        self.holds.append(hold)
)py";

constexpr std::string_view kGravity = R"py(        planet = gravityEffector.GravBodyData()
        planet.planetName = "planet"
        planet.isCentralBody = True
        planet.mu = MU
        self.body.gravField.gravBodies = gravityEffector.GravBodyVector([planet])
        self.kept.append(planet)
)py";
constexpr std::string_view kGradient =
    R"py(        gradient = GravityGradientEffector.GravityGradientEffector()
        gradient.addPlanetName("planet")
        self.body.addDynamicEffector(gradient)
        self.modules.append(gradient)
)py";

}  // namespace

std::string bsm_code(const BsmTables& has) {
  std::string code;
  const auto add = [&code](bool wanted, std::string_view text, const Words& words = {}) {
    if (wanted) code += with(text, words);
  };
  const bool has_slosh = has.particles || has.pendulums;
  // Of a point mass the state is that of its centre of mass, and it does not turn.
  add(true, kBegin,
      {{"@position@", has.is_point ? "r_CN_N" : "r_BN_N"},
       {"@turning@", has.is_point ? "" : kTurning}});
  add(has.is_point, kPoint);
  add(has.wheels, kWheels);
  add(has.wheel_motors, kWheelMotors);
  for (const bool turns : {true, false}) {
    if (!(turns ? has.hinges : has.slides)) continue;
    const Words& words = turns ? kHingeWords : kSlideWords;
    add(true, kChains, words);
    add(has.rests, kRests, words);
    add(true, kEndOfChain, words);
    add(has.chain_motors, kChainMotors, words);
  }
  add(has.tanks, kTanks);
  add(has.particles, kParticles);
  add(has.pendulums, kPendulums);
  add(has.wheels || has.hinges || has.slides || has_slosh || has.tanks, kAddAll);
  add(has.loads, kLoads);
  add(has.gravity != GravityLaw::kNone, kGravity);
  add(has.gravity == GravityLaw::kBodyGradient, kGradient);
  add(has.tanks, kAddTank);
  add(has_slosh, kAddSlosh);
  add(has.loads, kAddLoad);
  return code;
}

}  // namespace twincraft
