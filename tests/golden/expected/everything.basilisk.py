"""everything: one of each: text with `quotes` & <markup>

By sccompile 0.1.0 for Basilisk 2.12 and later, from the spec whose resolved form has the SHA-256
5a16fa52bf59f8bf12649f3bbde1ac44f1e52f36d1be999a5c1f44a4f02ea40a. SI units and radians, names as in Basilisk.

Not as in the spec:
- bsm, not written: kick: it acts at the centre of mass, which moves in this vehicle
- bsm: the attitude is in MRPs, and in quaternions in the analytic engine of the spec
- mjscene: what acts at the centre of mass follows it by a model in Python, which takes 0.2 ms a step or more
- mjscene: gravity `body_gradient` is a model in Python, which takes 0.2 ms a step or more
- mjscene: MJScene counts from the planet's centre: an attitude in orbit is off by 1e-4 to 0.4 deg
- mjscene: a step of an adaptive method is flown in tenths
"""
# flake8: noqa: E501
import argparse
import pathlib
import sys
import time
try:
    import Basilisk
    import numpy as np
    from Basilisk.architecture import bskLogging, messaging, sysModel
    from Basilisk.simulation import svIntegrators
    assert [int(n) for n in Basilisk.__version__.split(".")[:2]] >= [2, 12], f"this is {Basilisk.__version__}"
except (ImportError, AssertionError) as error:
    sys.exit(f"Basilisk 2.12 or later and numpy are needed (pip install bsk): {error}")
STEP, DURATION, RECORD, INTEGRATOR = 1, 100, 10, svIntegrators.svIntegratorRKF78  # [s]
ABSOLUTE = 1e-10
RELATIVE = 1e-10
MU = 3.98600436e+14
COLUMNS = [
    "t [s]", "r_BN_N.x [m]", "r_BN_N.y [m]", "r_BN_N.z [m]", "v_BN_N.x [m/s]", "v_BN_N.y [m/s]", "v_BN_N.z [m/s]",
    "q_BN.w [1]", "q_BN.x [1]", "q_BN.y [1]", "q_BN.z [1]", "omega_BN_B.x [rad/s]", "omega_BN_B.y [rad/s]",
    "omega_BN_B.z [rad/s]", "r_CN_N.x [m]", "r_CN_N.y [m]", "r_CN_N.z [m]", "v_CN_N.x [m/s]", "v_CN_N.y [m/s]",
    "v_CN_N.z [m/s]", "rw_slanted.rate [rad/s]", "rw_heavy.rate [rad/s]", "rw_out.rate [rad/s]",
    "wing.1.position [rad]", "wing.1.rate [rad/s]", "wing.2.position [rad]", "wing.2.rate [rad/s]",
    "wing.3.position [rad]", "wing.3.rate [rad/s]", "mass [kg]"]
INITIAL = {  # coordinates that are not here: 0
    "r_BN_N": [-2814237.218545605, 5243396.717025854, 3673809.477710733],
    "v_BN_N": [-6214.922991324592, -4107.620544118474, 1244.919283846151],
    "q_BN": [0.9515485246437886, 0.23929833774473033, 0.189307857412, 0.038134576474850156],
    "sigma_BN": [0.12261972209397605, 0.09700392023127065, 0.019540675516541803], "omega_BN_B": [0.01, -0.02, 0.015],
    "rw_slanted.rate": 314.1592653589793, "wing.1.position": 0.20943951023931956}
INPUTS = [  # from when on [s, N, N m, kg/s]
    [
        0,
        {
            "rw_slanted.torque": 0.01, "push.force": [0, 0, 0], "kick.force": [0, 0, 0.1],
            "turn.torque": [0.2, -0.3, 0.4]}], [1, {"push.force": [1, 0, 0]}], [2, {"push.force": [0, 0, 0]}],
    [3, {"push.force": [1, 0, 0]}], [4, {"push.force": [0, 0, 0]}], [5, {"kick.force": [0, 0, 0]}],
    [40, {"rw_slanted.torque": -0.01}]]
XML = """<mujoco><compiler angle="radian"/><option><flag constraint="disable"/></option><worldbody>
<body name="hub"><freejoint name="hub"/>
 <inertial pos="0.029801324503311258 -0.009933774834437087 0.006953642384105961" mass="603.9970000000001"
   quat="0.7074148699128645 -0.00022453049958832445 0.7067984988336307 -0.0001829173202939646"
   diaginertia="360.00393610214684 380.34937754572144 400.34622277597276"/>
 <site name="hub.weight" pos="0.03 -0.01 0.005" quat="0.5 0.5 0.5 0.5"/>
 <site name="rw_heavy.weight" pos="0 0 0.3" quat="0.5 0.5 0.5 0.5"/>
 <body name="rw_slanted" pos="0.029801324503311258 -0.009933774834437087 0.006953642384105961">
  <joint name="rw_slanted" axis="0.5773502691896258 0.5773502691896258 0.5773502691896258"/>
  <inertial pos="0 0 0" mass="0.001" quat="-0.27984814233312133 0.11591689595929512 0.8804762392171495
    -0.36470519963100095" diaginertia="0.05 0.05 0.08000000000000002"/></body>
 <body name="rw_heavy" pos="0.029801324503311258 -0.009933774834437087 0.006953642384105961">
  <joint name="rw_heavy" axis="0 0 1"/><inertial pos="0 0 0" mass="0.001" diaginertia="0.03 0.03 0.05"/></body>
 <body name="rw_out" pos="0.029801324503311258 -0.009933774834437087 0.006953642384105961">
  <joint name="rw_out" axis="0 1 0"/><inertial pos="0 0 0" mass="0.001" diaginertia="6e-04 0.001 6e-04"/></body>
 <body name="wing.1" pos="0.8 0 0.1" quat="0 1 0 0"><joint name="wing.1" axis="0 1 0" stiffness="150" damping="2"/>
  <inertial pos="0.5 0 0" mass="10" diaginertia="1.2003333333333333 0.8336666666666667 2.033333333333333"/>
  <body name="wing.2" pos="1 0 0">
   <joint name="wing.2" axis="0 1 0" stiffness="120" springref="0.017453292519943295" damping="2"/>
   <inertial pos="0.5 0 0" mass="10" diaginertia="1.2003333333333333 0.8336666666666667 2.033333333333333"/>
   <body name="wing.3" pos="1 0 0"><joint name="wing.3" axis="0 1 0" stiffness="90" damping="2"/>
    <inertial pos="0.5 0 0" mass="10" diaginertia="1.2003333333333333 0.8336666666666667 2.033333333333333"/></body></body></body></body></worldbody></mujoco>"""
JOINTS = {  # in the order of MuJoCo, with their inputs
    "rw_slanted": "rw_slanted.torque", "rw_heavy": None, "rw_out": None, "wing.1": None, "wing.2": None,
    "wing.3": None}
# PUSHES: loads and thrusters: the body, in whose axes they act, and where [m]
PUSHES = {"push": {"on": "hub", "at": [0, 0.5, 0]}, "turn": {"on": "hub", "at": [0, 0, 0]}}
AT_COM = {"kick": "hub"}  # those at the centre of mass of the vehicle: the body in whose axes they act
PULLED = ["wing.1", "wing.2", "wing.3"]  # bodies that gravity pulls on
WEIGHTS = {"hub": 600, "rw_heavy": 4}  # and parts of others, at their sites [kg]
GRADIENTS = {  # site: a body or a mass [kg], inertia per mass there [m2]
    "hub.weight": [
        600,
        [
            [0.6334350000000005, 1.6666666666558525e-05, 1.666666666666746e-05],
            [1.6666666666558525e-05, 0.6001010000000003, 1.666666666667196e-05],
            [1.666666666666746e-05, 1.6666666666671987e-05, 0.6667676666666671]]],
    "rw_heavy.weight": [4, [[0.0075, 0, 0], [0, 0.0125, 0], [0, 0, 0.0075]]],
    "wing.1_com": ["wing.1", [[0.12003333333333333, 0, 0], [0, 0.08336666666666667, 0], [0, 0, 0.2033333333333333]]],
    "wing.2_com": ["wing.2", [[0.12003333333333333, 0, 0], [0, 0.08336666666666667, 0], [0, 0, 0.2033333333333333]]],
    "wing.3_com": ["wing.3", [[0.12003333333333333, 0, 0], [0, 0.08336666666666667, 0], [0, 0, 0.2033333333333333]]]}
REFUSED = {"bsm": ["kick: it acts at the centre of mass, which moves in this vehicle"]}
REFUSED |= {} if Basilisk.hasBuildFeature("mujoco") else {"mjscene": ["this Basilisk has no MuJoCo"]}
HALVES = [name for name in ("bsm", "mjscene") if name not in REFUSED]


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


class Vehicle(sysModel.SysModel):
    """In a task after its `modules`: it sets the state of t = 0, again at every Reset, and holds what acts."""

    def __init__(self, engine):
        super().__init__()
        self.modules, self.parts, self.holds = [], {}, []
        self.kept = []  # Basilisk has raw pointers to these
        getattr(self, engine)()
        self.modules.append(self.body)
        self.integrator = INTEGRATOR(self.body)
        self.body.setIntegrator(self.integrator)

    def mjscene(self):
        """Bodies of an MJScene, moved by MuJoCo."""
        from Basilisk.simulation import NBodyGravity, MJSystemCoM, mujoco, pointMassGravityModel
        self.body = mujoco.MJScene(XML)
        self.body.highOrderAttitudeIntegration = True
        self.seen = self.body.getBody("hub").getOrigin().stateOutMsg
        self.states = {"r_BN_N": ("mujocoQpos", 0), "v_BN_N": ("mujocoQvel", 0),
                       "q_BN": ("mujocoQpos", 3), "omega_BN_B": ("mujocoQvel", 3)}
        bodies = [self.body.getBody(name) for name in self.body.getBodyNames()]
        self.whole = lambda seen: np.average(
            [[*site.r_BN_N, *site.v_BN_N] for site in (body.getCenterOfMass().stateOutMsg.read() for body in bodies)],
            axis=0, weights=[body.getMass() for body in bodies], returned=True)
        for row, (name, effort) in enumerate(JOINTS.items()):
            self.states |= {name + ".position": ("mujocoQpos", row + 7), name + ".rate": ("mujocoQvel", row + 6)}
            if effort:
                motor = self.parts[name] = self.body.addJointSingleActuator(name, name)
                self.link(motor.actuatorInMsg, "SingleActuator", lambda u, effort=effort: {"input": u.get(effort, 0)})
        for name, place in PUSHES.items():
            self.add_push(name, **place)
        planet = pointMassGravityModel.PointMassGravityModel()
        planet.muBody = MU
        gravity = NBodyGravity.NBodyGravity()
        gravity.addGravitySource("planet", planet, True)
        for name in PULLED:
            gravity.addGravityTarget(name, self.body.getBody(name))
        self.body.AddModelToDynamicsTask(gravity)
        self.kept += [planet, gravity]
        for name, mass in WEIGHTS.items():
            part = gravity.addGravityTarget(name + ".weight", self.body.getSite(name + ".weight"))
            self.kept.append(messaging.SCMassPropsMsg().write(messaging.SCMassPropsMsgPayload(massSC=mass)))
            part.massPropertiesInMsg.subscribeTo(self.kept[-1])
        self.com = MJSystemCoM.MJSystemCoM()
        self.com.scene = self.body
        self.body.AddModelToDynamicsTask(self.com, 2)
        self.kept.append(Following(self.follow))
        self.body.AddModelToDynamicsTask(self.kept[-1], 1)
        self.at_com = [(name, *self.wrench(name, on + "_origin")) for name, on in AT_COM.items()]
        self.gradients = [(of, *self.wrench(site + ".gradient", site), k) for site, (of, k) in GRADIENTS.items()]

    def add_push(self, name, on, at):
        actuator = self.parts[name] = self.body.addForceTorqueActuator(name, on + "_origin")
        self.link(actuator.forceInMsg, "ForceAtSite", lambda u: {"force_S": u.get(name + ".force", [0, 0, 0])})
        self.link(actuator.torqueInMsg, "TorqueAtSite", lambda u: {"torque_S": np.add(
            u.get(name + ".torque", [0, 0, 0]), np.cross(at, u.get(name + ".force", [0, 0, 0])))})

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
        r_CN = np.array(self.com.comStatesOutMsg.read().r_CN_N)
        for name, site, force, torque in self.at_com:
            seen, f = site.read(), self.acting.get(name + ".force", [0, 0, 0])
            self.push(force, f, now)
            about = cross(turned(seen, r_CN - seen.r_BN_N), f)
            self.turn(torque, about + self.acting.get(name + ".torque", [0, 0, 0]), now)
        for of, site, _, torque, k in self.gradients:
            mass, seen = self.body.getBody(of).getMass() if isinstance(of, str) else of, site.read()
            r = turned(seen, np.array(seen.r_BN_N))
            self.turn(torque, 3 * MU * mass / (r @ r)**2.5 * cross(r, np.dot(k, r)), now)

    def link(self, port, kind, say):
        port.subscribeTo(message := getattr(messaging, kind + "Msg")())
        self.holds.append(lambda now: message.write(getattr(messaging, kind + "MsgPayload")(**say(self.acting)), now))

    def Reset(self, now):
        self.acting, self.coming = {}, list(INPUTS)
        self.body.timeBefore, self.body.timeBeforeNanos = 1e-9 * now, now  # an MJScene has that of an earlier run
        for name, (state, row) in self.states.items():
            state, value = self.body.dynManager.getStateObject(state), INITIAL.get(name, 0)
            column = np.array(state.getState())
            column[row:row + np.size(value), 0] = value
            state.setState(column)
        self.integrator.setAbsoluteTolerance(ABSOLUTE)
        self.integrator.setRelativeTolerance(RELATIVE)
        for name in {"mujocoQpos", "mujocoQvel"} & {state for state, _ in self.states.values()}:
            # all coordinates at once: nothing is relative to an orbit's radius
            self.integrator.setRelativeTolerance(name, 0)
            self.integrator.setAbsoluteTolerance(name, ABSOLUTE + 1e-15 * np.linalg.norm(INITIAL["r_BN_N"]))

    def UpdateState(self, now):
        while self.coming and round(1e9 * self.coming[0][0]) <= now:
            self.acting |= self.coming.pop(0)[1]
        for hold in self.holds:
            hold(now)
        for module in self.modules[:-1]:
            module.UpdateState(now)

    def row(self, t):
        com, mass = self.whole(seen := self.seen.read())
        s = np.array(seen.sigma_BN)
        q = np.hstack([1 - s @ s, 2 * s]) / (1 + s @ s)
        places = [self.states[column.split(" ")[0]] for column in COLUMNS[20:-1]]
        joints = [self.body.dynManager.getStateObject(state).getState()[row][0] for state, row in places]
        row = np.hstack([t, seen.r_BN_N, seen.v_BN_N, q, seen.omega_BN_B, com, joints, np.ravel(mass)[0]])
        return row if np.isfinite(row).all() else sys.exit(f"the motion is not finite at {t} s")

    def fly(self, step, duration):
        """The lines of our CSV. Steps end at multiples of `step` and where INPUTS change."""
        yield COLUMNS
        for module in [*self.modules, self]:
            module.SelfInit()
        for module in [*self.modules, self]:
            module.Reset(0)
        self.UpdateState(0)
        self.body.UpdateState(0)
        yield self.row(0.0)
        if "q_BN" in self.states:  # in MJScene, which stops where the first trial of a step ends nowhere
            step /= 10
        grid, changes = np.arange(1, duration / step + 1e-9) * step, [t for t, _ in INPUTS if 0 < t < duration]
        times = np.unique(np.rint(1e9 * np.hstack([grid, changes, duration])).astype(int))
        self.steps, self.seconds, samples = len(times), 0, 1
        for now in times.tolist():
            begin = time.perf_counter()
            self.body.UpdateState(now)
            self.seconds += time.perf_counter() - begin
            if now >= round(1e9 * (samples * RECORD)) or now == times[-1]:
                yield self.row(now / 1e9)
                samples = int((now + 1) / 1e9 / RECORD) + 1
            if self.coming and round(1e9 * self.coming[0][0]) <= now:
                self.UpdateState(now)


def build(sim, task, engine="mjscene"):
    """Put the vehicle into a task of your own. INPUTS act from ticks on; after INPUTS.clear() none does. Keep it."""
    vehicle = Vehicle(engine)
    for i, module in enumerate([*vehicle.modules, vehicle]):
        sim.AddModelToTask(task, module, 1000 - i)
    return vehicle


if __name__ == "__main__":
    line = argparse.ArgumentParser(description=__doc__.split("\n")[0].replace("%", "%%"))
    line.add_argument("--engine", choices=["bsm", "mjscene", "both"], default="both")
    line.add_argument("--step", type=float, default=STEP, help="[s]")
    line.add_argument("--duration", type=float, default=DURATION, help="[s]")
    line.add_argument("-o", type=pathlib.Path, default=".", metavar="DIR")
    asked = line.parse_args()
    if not asked.step >= 1e-9 or not 0 < asked.duration < 9e9:
        line.error("--step and --duration are in seconds, and at least a nanosecond")
    for name in HALVES if asked.engine == "both" else [asked.engine]:
        vehicle = sys.exit(f"{name}: {'; '.join(REFUSED[name])}") if name in REFUSED else Vehicle(name)
        try:
            lines = [",".join(map(str, row)) + "\n" for row in vehicle.fly(asked.step, asked.duration)]
        except bskLogging.BasiliskError as error:
            sys.exit(f"{name}: {error}; a shorter --step may help")
        asked.o.mkdir(parents=True, exist_ok=True)
        (asked.o / f"basilisk_{name}.csv").write_text("".join(lines))
        print(f"{name}: {vehicle.steps} steps, {1e6 * vehicle.seconds / vehicle.steps:.2f} us per step")
