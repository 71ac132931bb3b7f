// See bsm_code.h. Tested by tests/compiler/basilisk_test.cpp, and flown by tests/basilisk.
#include "compiler/emit/basilisk/bsm_code.h"

#include <string_view>

#include "compiler/emit/basilisk/python_text.h"

namespace twincraft {
namespace {

constexpr std::string_view kBegin = R"py(

class Bsm(Vehicle):
    """A Spacecraft with effectors, solved by back-substitution."""

    def __init__(self):
        super().__init__(spacecraft.Spacecraft())
        self.states = {"@position@": ("hubPosition", 0), "v_BN_N": ("hubVelocity", 0)@turning@}
        self.seen = self.body.scStateOutMsg
        for key, value in HUB.items():
            setattr(self.body.hub, key, value)
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
        wheels.nameOfReactionWheelOmegasState = "wheels"
        for row, (name, keys) in enumerate(WHEELS.items()):
            wheel = reactionWheelStateEffector.RWConfigPayload()
            for key, value in keys.items():
                setattr(wheel, key, value)
            wheels.addReactionWheel(wheel)
            self.states[name + ".rate"] = ("wheels", row)
        self.add(wheels, WHEELS, "Torque", wheels.rwMotorCmdInMsg)
)py";

constexpr std::string_view kAdd = R"py(
    def add(self, effector, names, effort=None, port=None):
        self.body.addStateEffector(effector)
        self.modules.append(effector)
        self.parts.update(dict.fromkeys(names, effector))
)py";
constexpr std::string_view kLinkMotors =
    R"py(        if effort:
            inputs = [f"{name}.{effort}".lower() for name in names]
            self.link(port, "ArrayMotor" + effort, "motor" + effort, inputs)
)py";

// Hinges and slides differ in names alone.
constexpr std::string_view kChains = R"py(        for name, links in @TABLE@.items():
            chain = @module@.@Chain@()
            chain.setNameOf@Theta@State(name)
            chain.setNameOf@Theta@DotState(name + ".rate")
            for row, (link, keys) in enumerate(links.items()):
                body = @module@.@Body@()
                for key, value in keys.items():
                    getattr(body, "set" + key)(value)
                chain.add@Body@(body)
                self.kept.append(body)
                self.states |= {link + ".position": (name, row), link + ".rate": (name + ".rate", row)}
)py";
constexpr std::string_view kRests = R"py(                if link in @JOINT@_RESTS:
                    rest = messaging.@Reference@MsgPayload(@theta@=@JOINT@_RESTS[link])
                    self.kept.append(messaging.@Reference@Msg().write(rest))
                    chain.@body@RefInMsgs[row].subscribeTo(self.kept[-1])
)py";
constexpr std::string_view kEndOfChain =
    R"py(            self.add(chain, @names@, "@Effort@", chain.motor@Effort@InMsg)
)py";

const Words kHingeWords = {{"@TABLE@", "HINGES"},
                           {"@JOINT@", "HINGE"},
                           {"@module@", "spinningBodyNDOFStateEffector"},
                           {"@Chain@", "SpinningBodyNDOFStateEffector"},
                           {"@Body@", "SpinningBody"},
                           {"@body@", "spinningBody"},
                           {"@Theta@", "Theta"},
                           {"@theta@", "theta"},
                           {"@Reference@", "HingedRigidBody"},
                           {"@Effort@", "Torque"},
                           {"@names@", "links"}};
const Words kSlideWords = {{"@TABLE@", "SLIDES"},
                           {"@JOINT@", "SLIDE"},
                           {"@module@", "linearTranslationNDOFStateEffector"},
                           {"@Chain@", "LinearTranslationNDOFStateEffector"},
                           {"@Body@", "TranslatingBody"},
                           {"@body@", "translatingBody"},
                           {"@Theta@", "Rho"},
                           {"@theta@", "rho"},
                           {"@Reference@", "LinearTranslationRigidBody"},
                           {"@Effort@", "Force"},
                           {"@names@", "links"}};

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
        self.add(tank, [name])
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
        self.add(slosh, [name])
)py";

constexpr std::string_view kLoads = R"py(        for name, place in LOADS.items():
            load = self.parts[name] = extForceTorque.ExtForceTorque()
            if place["on"]:
                self.parts[place["on"][0]].addDynamicEffector(load, place["on"][1])
            else:
                self.body.addDynamicEffector(load)
            self.modules.append(load)
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

constexpr std::string_view kEndOfInit = R"py(        self.modules.append(self.body)
)py";

constexpr std::string_view kHold = R"py(
    def UpdateState(self, now):
        super().UpdateState(now)
)py";
constexpr std::string_view kHoldLoads = R"py(        for name, place in LOADS.items():
            force, torque = self.acting.get(name + ".force", [0, 0, 0]), self.acting.get(name + ".torque", [0, 0, 0])
            self.parts[name].extForce_B = force
            self.parts[name].extTorquePntB_B = np.add(torque, np.cross(place["at"], force))
)py";
constexpr std::string_view kHoldTanks = R"py(        for name in TANKS:
            self.parts[name].setFuelLeakRate(self.acting.get(name + ".flow", 0))
)py";
constexpr std::string_view kEnd = R"py(
    def whole(self):
        seen = self.seen.read()
        return [*seen.r_CN_N, *seen.v_CN_N], self.body.scMassOutMsg.read().massSC
)py";

}  // namespace

std::string bsm_code(const BsmTables& has) {
  std::string code;
  const auto add = [&code](bool wanted, std::string_view text, const Words& words = {}) {
    if (wanted) code += with(text, words);
  };
  const bool has_motors = has.wheels || has.hinges || has.slides;
  const bool has_slosh = has.particles || has.pendulums;
  // Of a point mass the state is that of its centre of mass, and it does not turn.
  add(true, kBegin,
      {{"@position@", has.is_point ? "r_CN_N" : "r_BN_N"},
       {"@turning@", has.is_point ? "" : kTurning}});
  add(has.is_point, kPoint);
  add(has.wheels, kWheels);
  for (const bool turns : {true, false}) {
    if (!(turns ? has.hinges : has.slides)) continue;
    const Words& words = turns ? kHingeWords : kSlideWords;
    add(true, kChains, words);
    add(turns ? has.hinge_rests : has.slide_rests, kRests, words);
    add(true, kEndOfChain, words);
  }
  add(has.tanks, kTanks);
  add(has.particles, kParticles);
  add(has.pendulums, kPendulums);
  add(has.loads, kLoads);
  add(has.gravity != GravityLaw::kNone, kGravity);
  add(has.gravity == GravityLaw::kBodyGradient, kGradient);
  add(true, kEndOfInit);
  add(has_motors || has_slosh || has.tanks, kAdd);
  add(has_motors, kLinkMotors);
  add(has.tanks, kAddTank);
  add(has_slosh, kAddSlosh);
  add(has.loads || has.tanks, kHold);
  add(has.loads, kHoldLoads);
  add(has.tanks, kHoldTanks);
  add(true, kEnd);
  return code;
}

}  // namespace twincraft
