// See mjscene_code.h. Tested by tests/compiler/basilisk_test.cpp, and flown by tests/basilisk.
#include "compiler/emit/basilisk/mjscene_code.h"

#include <string_view>

#include "compiler/emit/basilisk/python_text.h"

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

class MjScene(Vehicle):
    """Bodies of an MJScene, moved by MuJoCo."""

    def __init__(self):
        from Basilisk.simulation import @modules@
        super().__init__(mujoco.MJScene(XML))
        self.body.highOrderAttitudeIntegration = True
        self.modules.append(self.body)
        self.seen = self.body.getBody("hub").getOrigin().stateOutMsg
        self.states = {"r_BN_N": ("mujocoQpos", 0), "v_BN_N": ("mujocoQvel", 0)@turning@}
)py";
constexpr std::string_view kTurning =
    R"py(,
                       "q_BN": ("mujocoQpos", 3), "omega_BN_B": ("mujocoQvel", 3))py";
constexpr std::string_view kJoints = R"py(        for row, name in enumerate(JOINTS):
            self.states |= {name + ".position": ("mujocoQpos", row + 7), name + ".rate": ("mujocoQvel", row + 6)}
            for effort in self.driven & {name + ".torque", name + ".force"}:
                self.parts[name] = self.body.addJointSingleActuator(name, name)
                self.link(self.parts[name].actuatorInMsg, "SingleActuator", "input", effort)
)py";
constexpr std::string_view kSites = R"py(        for name, place in SITES.items():
            self.body.getBody(place["on"]).addSite(name + ".at", place["at"])
            self.parts[name] = self.body.addForceTorqueActuator(name, name + ".at")
            self.link(self.parts[name].forceInMsg, "ForceAtSite", "force_S", name + ".force")
            self.link(self.parts[name].torqueInMsg, "TorqueAtSite", "torque_S", name + ".torque")
)py";
constexpr std::string_view kFlows = R"py(        self.flows = [(name, messaging.SCMassPropsMsg(), *part) for name, part in PARTS.items()]
        for name, message, _, _ in self.flows:
            self.body.getBody(name).derivativeMassPropertiesInMsg.subscribeTo(message)
)py";
constexpr std::string_view kMasses = R"py(        self.masses = [self.body.getBody(name) for name in self.body.getBodyNames()]
)py";
constexpr std::string_view kNBody = R"py(        planet = pointMassGravityModel.PointMassGravityModel()
        planet.muBody = MU
        gravity = NBodyGravity.NBodyGravity()
        gravity.addGravitySource("planet", planet, True)
        for body in self.masses:
            gravity.addGravityTarget(body.getName(), body)
        self.body.AddModelToDynamicsTask(gravity)
        self.kept += [planet, gravity]
)py";
constexpr std::string_view kCom = R"py(        self.com = MJSystemCoM.MJSystemCoM()
        self.com.scene = self.body
        self.body.AddModelToDynamicsTask(self.com, 2)
)py";
constexpr std::string_view kFollow = R"py(        self.kept.append(Following(self.follow))
        self.body.AddModelToDynamicsTask(self.kept[-1], 1)
)py";
constexpr std::string_view kAtCom = R"py(        self.at_com = [(name, *self.wrench(name, on + "_origin")) for name, on in AT_COM.items()]
)py";
constexpr std::string_view kWeights =
    R"py(        self.weights = [(body, *self.wrench(body.getName() + ".weight", body.getName() + "_com"))
                        for body in self.masses]
)py";
constexpr std::string_view kGradients =
    R"py(        self.gradients = [(self.body.getBody(name), *self.wrench(name + ".gradient", name + "_com"), k)
                          for name, k in GYRATION.items()]
)py";
constexpr std::string_view kJets = R"py(        self.jets = []
        for i, jet in enumerate(JETS):
            for end, on, at in zip("12", jet["on"], jet["at"]):
                self.body.getBody(on).addSite(f"jet.{i}.{end}", at)
            self.jets.append((jet, self.wrench(f"jet.{i}.1", f"jet.{i}.1"), self.wrench(f"jet.{i}.2", f"jet.{i}.2")))
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
constexpr std::string_view kReadCom = R"py(        r_CN = np.array(self.com.comStatesOutMsg.read().r_CN_N)
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
constexpr std::string_view kFollowGradients = R"py(        for body, site, _, torque, k in self.gradients:
            seen = site.read()
            r = turned(seen, np.array(seen.r_BN_N))
            self.turn(torque, 3 * MU * body.getMass() / (r @ r)**2.5 * cross(r, np.dot(k, r)), now)
)py";
constexpr std::string_view kFollowJets = R"py(        for jet, (nozzle, out, _), (source, back, turn) in self.jets:
            flow, p, e = jet["part"] * self.acting.get(jet["nozzle"], 0), nozzle.read(), source.read()
            force = -flow * np.subtract(p.v_BN_N, e.v_BN_N)
            self.push(out, turned(p, force), now)
            self.push(back, turned(e, force), now)
            self.turn(turn, flow * np.dot(jet["k"], e.omega_BN_B), now)
)py";

constexpr std::string_view kHoldFlows = R"py(
    def UpdateState(self, now):
        super().UpdateState(now)
        for _, message, tank, part in self.flows:
            flow = part * self.acting.get(tank + ".flow", 0)
            message.write(messaging.SCMassPropsMsgPayload(massSC=-flow), now)
)py";
constexpr std::string_view kTolerances = R"py(
    def Reset(self, now):
        super().Reset(now)
        for name in ("mujocoQpos", "mujocoQvel"):  # all coordinates at once: nothing relative to an orbit's radius
            self.integrator.setRelativeTolerance(name, 0)
            self.integrator.setAbsoluteTolerance(name, ABSOLUTE + 1e-15 * np.linalg.norm(INITIAL["r_BN_N"]))
)py";
constexpr std::string_view kEnd = R"py(
    def whole(self):
        sites = [body.getCenterOfMass().stateOutMsg.read() for body in self.masses]
        masses = np.array([body.getMass() for body in self.masses])
        return masses @ [[*site.r_BN_N, *site.v_BN_N] for site in sites] / masses.sum(), masses.sum()
)py";

}  // namespace

std::string mjscene_code(const MjSceneTables& has) {
  std::string code;
  const auto add = [&code](bool wanted, std::string_view text, const Words& words = {}) {
    if (wanted) code += with(text, words);
  };
  const bool pulls_at_com = has.gravity == GravityLaw::kSystemCom;
  const bool pulls_bodies =
      has.gravity == GravityLaw::kBodyCom || has.gravity == GravityLaw::kBodyGradient;
  const bool needs_com = has.at_com || pulls_at_com;
  const bool follows = needs_com || has.jets || has.gyration;
  std::string modules = "mujoco";
  if (needs_com) modules = "MJSystemCoM, " + modules;
  if (pulls_bodies) modules = "NBodyGravity, " + modules + ", pointMassGravityModel";
  add(follows, kFollowing);
  add(true, kBegin, {{"@modules@", modules}, {"@turning@", has.is_point ? "" : kTurning}});
  add(has.joints, kJoints);
  add(has.sites, kSites);
  add(has.flows, kFlows);
  add(true, kMasses);
  add(pulls_bodies, kNBody);
  add(needs_com, kCom);
  add(follows, kFollow);
  add(has.at_com, kAtCom);
  add(pulls_at_com, kWeights);
  add(has.gyration, kGradients);
  add(has.jets, kJets);
  add(follows, kWrench);
  add(needs_com, kReadCom);
  add(has.at_com, kFollowAtCom);
  add(pulls_at_com, kFollowWeights);
  add(has.gyration, kFollowGradients);
  add(has.jets, kFollowJets);
  add(has.flows, kHoldFlows);
  add(has.is_adaptive, kTolerances);
  add(true, kEnd);
  return code;
}

}  // namespace twincraft
