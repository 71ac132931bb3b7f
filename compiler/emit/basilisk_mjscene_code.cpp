// See basilisk_mjscene_code.h. Tested by tests/compiler/basilisk_test.cpp, and flown by
// tests/basilisk.
#include "compiler/emit/basilisk_mjscene_code.h"

#include <string_view>

#include "compiler/emit/python_text.h"

namespace twincraft {
namespace {

constexpr std::string_view kFollowing = R"py(

class Following(sysModel.SysModel):
    """Calls what follows the motion, at every stage of a step."""

    def __init__(self, call):
        super().__init__()
        self.call = call

    def UpdateState(self, now):
        self.call(now)


def turned(seen, v):
    """Components in N as a site has them."""
    s = np.array(seen.sigma_BN)
    once, s2 = cross(s, v), s @ s
    return v + (8 * cross(s, once) - 4 * (1 - s2) * once) / (1 + s2)**2


def cross(a, b):  # numpy's takes twenty times as long
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
)py";

constexpr std::string_view kBegin = R"py(
    def mjscene(self):
        """Bodies of an MJScene, moved by MuJoCo."""
        from Basilisk.simulation import @modules@
        self.body = mujoco.MJScene(XML)
        self.body.highOrderAttitudeIntegration = True
        self.seen = self.body.getBody("hub").getOrigin().stateOutMsg
        self.states = {"r_BN_N": ("mujocoQpos", 0), "v_BN_N": ("mujocoQvel", 0)@turning@}
        bodies = [self.body.getBody(name) for name in self.body.getBodyNames()]
        self.whole = lambda seen: np.average(
            [[*site.r_BN_N, *site.v_BN_N] for site in (body.getCenterOfMass().stateOutMsg.read() for body in bodies)],
            axis=0, weights=[body.getMass() for body in bodies], returned=True)
)py";
constexpr std::string_view kTurning =
    R"py(,
                       "q_BN": ("mujocoQpos", 3), "omega_BN_B": ("mujocoQvel", 3))py";
constexpr std::string_view kJoints =
    R"py(        for row, (name, effort) in enumerate(JOINTS.items()):
            self.states |= {name + ".position": ("mujocoQpos", row + 7), name + ".rate": ("mujocoQvel", row + 6)}
)py";
constexpr std::string_view kMotors = R"py(            if effort:
                motor = self.parts[name] = self.body.addJointSingleActuator(name, name)
                self.link(motor.actuatorInMsg, "SingleActuator", lambda u, effort=effort: {"input": u.get(effort, 0)})
)py";
constexpr std::string_view kSites = R"py(        for name, place in PUSHES.items():
            self.add_push(name, **place)
)py";
constexpr std::string_view kFlows = R"py(        for name, (tank, part) in PARTS.items():
            self.link(self.body.getBody(name).derivativeMassPropertiesInMsg, "SCMassProps",
                      lambda u, tank=tank, part=part: {"massSC": -part * u.get(tank + ".flow", 0)})
)py";
constexpr std::string_view kNBody =
    R"py(        planet = pointMassGravityModel.PointMassGravityModel()
        planet.muBody = MU
        gravity = NBodyGravity.NBodyGravity()
        gravity.addGravitySource("planet", planet, True)
        for name in PULLED:
            gravity.addGravityTarget(name, self.body.getBody(name))
        self.body.AddModelToDynamicsTask(gravity)
        self.kept += [planet, gravity]
)py";
constexpr std::string_view kNBodyParts = R"py(        for name, mass in WEIGHTS.items():
            part = gravity.addGravityTarget(name + ".weight", self.body.getSite(name + ".weight"))
            self.kept.append(messaging.SCMassPropsMsg().write(messaging.SCMassPropsMsgPayload(massSC=mass)))
            part.massPropertiesInMsg.subscribeTo(self.kept[-1])
)py";
constexpr std::string_view kCom = R"py(        self.com = MJSystemCoM.MJSystemCoM()
        self.com.scene = self.body
        self.body.AddModelToDynamicsTask(self.com, 2)
)py";
constexpr std::string_view kFollow = R"py(        self.kept.append(Following(self.follow))
        self.body.AddModelToDynamicsTask(self.kept[-1], 1)
)py";
constexpr std::string_view kAtCom =
    R"py(        self.at_com = [(name, *self.wrench(name, on + "_origin")) for name, on in AT_COM.items()]
)py";
constexpr std::string_view kWeights =
    R"py(        self.weights = [(body, *self.wrench(body.getName() + ".weight", body.getName() + "_com"))
                        for body in bodies]
)py";
constexpr std::string_view kGradients =
    R"py(        self.gradients = [(of, *self.wrench(site + ".gradient", site), k) for site, (of, k) in GRADIENTS.items()]
)py";
constexpr std::string_view kJets = R"py(        self.jets = []
        for i, jet in enumerate(JETS):
            for end, on, at in zip("12", jet["on"], jet["at"]):
                self.body.getBody(on).addSite(f"jet.{i}.{end}", at)
            self.jets.append((jet, self.wrench(f"jet.{i}.1", f"jet.{i}.1"), self.wrench(f"jet.{i}.2", f"jet.{i}.2")))
)py";

constexpr std::string_view kAddPush = R"py(
    def add_push(self, name, on, at):
        actuator = self.parts[name] = self.body.addForceTorqueActuator(name, on + "_origin")
        self.link(actuator.forceInMsg, "ForceAtSite", lambda u: {"force_S": u.get(name + ".force", [0, 0, 0])})
        self.link(actuator.torqueInMsg, "TorqueAtSite", lambda u: {"torque_S": np.add(
            u.get(name + ".torque", [0, 0, 0]), np.cross(at, u.get(name + ".force", [0, 0, 0])))})
)py";

constexpr std::string_view kWrench = R"py(
    def wrench(self, name, site):
        """What a site says, and what may say force and torque there."""
        actuator = self.body.addForceTorqueActuator(name, site)
        force, torque = messaging.ForceAtSiteMsg(), messaging.TorqueAtSiteMsg()
        actuator.forceInMsg.subscribeTo(force)
        actuator.torqueInMsg.subscribeTo(torque)
        self.parts[name] = actuator
        return self.body.getSite(site).stateOutMsg, force, torque

    def push(self, message, force, now):
        message.write(messaging.ForceAtSiteMsgPayload(force_S=force), now)

    def turn(self, message, torque, now):
        message.write(messaging.TorqueAtSiteMsgPayload(torque_S=torque), now)

    def follow(self, now):
)py";
constexpr std::string_view kReadCom =
    R"py(        r_CN = np.array(self.com.comStatesOutMsg.read().r_CN_N)
)py";
constexpr std::string_view kFollowAtCom = R"py(        for name, site, force, torque in self.at_com:
            seen, f = site.read(), self.acting.get(name + ".force", [0, 0, 0])
            self.push(force, f, now)
            about = cross(turned(seen, r_CN - seen.r_BN_N), f)
            self.turn(torque, about + self.acting.get(name + ".torque", [0, 0, 0]), now)
)py";
constexpr std::string_view kFollowWeights = R"py(        for body, site, force, _ in self.weights:
            self.push(force, turned(site.read(), -MU * body.getMass() / (r_CN @ r_CN)**1.5 * r_CN), now)
)py";
constexpr std::string_view kFollowGradients =
    R"py(        for of, site, _, torque, k in self.gradients:
            mass, seen = self.body.getBody(of).getMass() if isinstance(of, str) else of, site.read()
            r = turned(seen, np.array(seen.r_BN_N))
            self.turn(torque, 3 * MU * mass / (r @ r)**2.5 * cross(r, np.dot(k, r)), now)
)py";
constexpr std::string_view kFollowJets =
    R"py(        for jet, (nozzle, out, _), (source, back, turn) in self.jets:
            flow, p, e = jet["part"] * self.acting.get(jet["nozzle"], 0), nozzle.read(), source.read()
            force = -flow * np.subtract(p.v_BN_N, e.v_BN_N)
            self.push(out, turned(p, force), now)
            self.push(back, turned(e, force), now)
            self.turn(turn, flow * np.dot(jet["k"], e.omega_BN_B), now)
)py";

}  // namespace

std::string mjscene_models(const MjSceneTables& has) {
  return has.follows() ? std::string(kFollowing) : std::string();
}

std::string mjscene_code(const MjSceneTables& has) {
  std::string code;
  const auto add = [&code](bool wanted, std::string_view text, const Words& words = {}) {
    if (wanted) code += with(text, words);
  };
  std::string modules = "mujoco";
  if (has.needs_com()) modules = "MJSystemCoM, " + modules;
  if (has.pulls_bodies()) modules = "NBodyGravity, " + modules + ", pointMassGravityModel";
  add(true, kBegin, {{"@modules@", modules}, {"@turning@", has.is_point ? "" : kTurning}});
  add(has.joints, kJoints);
  add(has.motors, kMotors);
  add(has.sites, kSites);
  add(has.flows, kFlows);
  add(has.pulls_bodies(), kNBody);
  add(has.weights, kNBodyParts);
  add(has.needs_com(), kCom);
  add(has.follows(), kFollow);
  add(has.at_com, kAtCom);
  add(has.pulls_at_com(), kWeights);
  add(has.gradients, kGradients);
  add(has.jets, kJets);
  add(has.sites, kAddPush);
  add(has.follows(), kWrench);
  add(has.needs_com(), kReadCom);
  add(has.at_com, kFollowAtCom);
  add(has.pulls_at_com(), kFollowWeights);
  add(has.gradients, kFollowGradients);
  add(has.jets, kFollowJets);
  return code;
}

}  // namespace twincraft
