"""tanker: a spacecraft

By sccompile 0.1.0 for Basilisk 2.12 and later, from the spec whose resolved form has the SHA-256
1f9b7b0eec412ccad493e7f475f804ffc04a034d03407086471cf31bc4a62a12. SI units and radians, names as in Basilisk.

Not as in the spec:
- bsm, not written: fuel: its jet takes momentum along by another law than Basilisk's
- bsm, not written: bob: its bob has an inertia, and Basilisk's is a point
- bsm: bob: beyond 45 deg of its second angle Basilisk's pendulum changes its axes, and the angles written are those
  about the new ones
- mjscene: jet damping is a model in Python, which takes 0.2 ms a step or more
- mjscene: MJScene counts from the origin of N: an attitude is off by up to 1e-4 deg once the vehicle has gained
  kilometres a second
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
STEP, DURATION, RECORD, INTEGRATOR = 0.02, 10, 0.06, svIntegrators.svIntegratorRK4  # [s]
COLUMNS = [
    "t [s]", "r_BN_N.x [m]", "r_BN_N.y [m]", "r_BN_N.z [m]", "v_BN_N.x [m/s]", "v_BN_N.y [m/s]", "v_BN_N.z [m/s]",
    "q_BN.w [1]", "q_BN.x [1]", "q_BN.y [1]", "q_BN.z [1]", "omega_BN_B.x [rad/s]", "omega_BN_B.y [rad/s]",
    "omega_BN_B.z [rad/s]", "r_CN_N.x [m]", "r_CN_N.y [m]", "r_CN_N.z [m]", "v_CN_N.x [m/s]", "v_CN_N.y [m/s]",
    "v_CN_N.z [m/s]", "blob.position [m]", "blob.rate [m/s]", "bob.phi.position [rad]", "bob.phi.rate [rad/s]",
    "bob.theta.position [rad]", "bob.theta.rate [rad/s]", "mass [kg]"]
INITIAL = {  # coordinates that are not here: 0
    "r_BN_N": [-0.02920526117133641, -0.055925302501946036, 0.31605072417140584],
    "v_BN_N": [-0.009591025217698466, 0.018603706260549916, -3.633595813891657e-05], "q_BN": [1, 0, 0, 0],
    "sigma_BN": [0, 0, 0], "omega_BN_B": [0, 0, 0], "blob.position": 0.05, "bob.phi.position": 0.25,
    "bob.phi.rate": 0.25, "bob.theta.position": 0.125, "bob.theta.rate": -0.5}
INPUTS = [  # from when on [s, N, N m, kg/s]
    [
        0,
        {
            "main_engine.force": [0, 0, 400], "kicker.force": [0, 4, 0], "fuel.flow": 0.20394324259558563,
            "main_engine.flow": 0.20394324259558563}],
    [6, {"main_engine.force": [0, 0, 100], "fuel.flow": 0.05098581064889641, "main_engine.flow": 0.05098581064889641}],
    [9, {"main_engine.force": [0, 0, 0], "fuel.flow": 0, "main_engine.flow": 0}]]
XML = """<mujoco><compiler angle="radian"/><option><flag constraint="disable"/></option><worldbody>
<body name="hub"><freejoint name="hub"/><inertial pos="0 0 0" mass="300" diaginertia="400 380 360"/>
 <site name="hub_origin"/>
 <body name="fuel" pos="0 0.1 -0.8"><inertial pos="0 0 0" mass="325" diaginertia="73.125 73.125 73.125"/></body>
 <body name="oxidiser" pos="0.1 0 0.6">
  <inertial pos="0 0 0" mass="200" diaginertia="21.166666666666668 9 21.166666666666668"/></body>
 <body name="blob" pos="0 0.1 -0.8"><joint name="blob" type="slide" axis="0 1 0" stiffness="11" damping="0.5"/>
  <inertial pos="0 0 0" mass="25" diaginertia="1e-06 1e-06 1e-06"/></body>
 <body name="bob" pos="0 0.1 -0.8" quat="0.5 0.5 0.5 -0.5"><joint name="bob.phi" axis="0 0 1"/>
  <joint name="bob.theta" axis="0 1 0"/><inertial pos="0.25 0 0" mass="150" diaginertia="1.5001 1.5001 1.5001"/>
  <site name="bob_com" pos="0.25 0 0"/></body></body></worldbody>
<actuator>
 <general name="bob.drag.x" site="bob_com" refsite="hub_origin" gear="1 0 0 0 0 0" gainprm="0" biastype="affine"
   biasprm="0 0 -8"/>
 <general name="bob.drag.y" site="bob_com" refsite="hub_origin" gear="0 1 0 0 0 0" gainprm="0" biastype="affine"
   biasprm="0 0 -8"/>
 <general name="bob.drag.z" site="bob_com" refsite="hub_origin" gear="0 0 1 0 0 0" gainprm="0" biastype="affine"
   biasprm="0 0 -8"/>
</actuator></mujoco>"""
JOINTS = {"blob": None, "bob.phi": None, "bob.theta": None}  # in the order of MuJoCo, with their inputs
# PUSHES: loads and thrusters: the body, in whose axes they act, and where [m]
PUSHES = {"main_engine": {"on": "hub", "at": [0, 0, -1.5]}, "kicker": {"on": "hub", "at": [1, 0, 0]}}
# PARTS: body that drains: its tank, its part of what that holds
PARTS = {"fuel": ["fuel", 0.65], "blob": ["fuel", 0.05], "bob": ["fuel", 0.3]}
JETS = [  # from source to nozzle: part of the nozzle's flow, bodies, places [m], k of the source [m2]
    {
        "nozzle": "main_engine.flow", "part": 0.65, "on": ["hub", "hub"], "at": [[0, 0, -1.5], [0, 0.1, -0.8]],
        "k": [[0.225, 0, 0], [0, 0.225, 0], [0, 0, 0.225]]},
    {
        "nozzle": "main_engine.flow", "part": 0.05, "on": ["hub", "blob"], "at": [[0, 0, -1.5], [0, 0, 0]],
        "k": [[0, 0, 0], [0, 0, 0], [0, 0, 0]]},
    {
        "nozzle": "main_engine.flow", "part": 0.3, "on": ["hub", "bob"], "at": [[0, 0, -1.5], [0.25, 0, 0]],
        "k": [[0.01, 0, 0], [0, 0.01, 0], [0, 0, 0.01]]}]
REFUSED = {"bsm": [
    "fuel: its jet takes momentum along by another law than Basilisk's",
    "bob: its bob has an inertia, and Basilisk's is a point"]}
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
        from Basilisk.simulation import mujoco
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
        for name, place in PUSHES.items():
            self.add_push(name, **place)
        for name, (tank, part) in PARTS.items():
            self.link(self.body.getBody(name).derivativeMassPropertiesInMsg, "SCMassProps",
                      lambda u, tank=tank, part=part: {"massSC": -part * u.get(tank + ".flow", 0)})
        self.kept.append(Following(self.follow))
        self.body.AddModelToDynamicsTask(self.kept[-1], 1)
        self.jets = []
        for i, jet in enumerate(JETS):
            for end, on, at in zip("12", jet["on"], jet["at"]):
                self.body.getBody(on).addSite(f"jet.{i}.{end}", at)
            self.jets.append((jet, self.wrench(f"jet.{i}.1", f"jet.{i}.1"), self.wrench(f"jet.{i}.2", f"jet.{i}.2")))

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
        for jet, (nozzle, out, _), (source, back, turn) in self.jets:
            flow, p, e = jet["part"] * self.acting.get(jet["nozzle"], 0), nozzle.read(), source.read()
            force = -flow * np.subtract(p.v_BN_N, e.v_BN_N)
            self.push(out, turned(p, force), now)
            self.push(back, turned(e, force), now)
            self.turn(turn, flow * np.dot(jet["k"], e.omega_BN_B), now)

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
