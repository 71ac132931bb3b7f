"""bodies: a spacecraft

By sccompile 0.1.0 for Basilisk 2.12 and later, from the spec whose resolved form has the SHA-256
fcf6966c1144e7c7c5ea5c6ef3ebb9981f575f2875a6bc68c917a94bc20d5c2f. SI units and radians, names as in Basilisk.

Not as in the spec:
- bsm, not written: arm: `slider` and `wing.1` branch off it, and Basilisk's effectors are chains on the hub
- bsm, not written: rw: its mount `arm` carries more than the wheel, and only the last body of a chain of Basilisk's
  can be a wheel
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
STEP, DURATION, RECORD, INTEGRATOR = 0.125, 10, 0.125, svIntegrators.svIntegratorRK4  # [s]
COLUMNS = [
    "t [s]", "r_BN_N.x [m]", "r_BN_N.y [m]", "r_BN_N.z [m]", "v_BN_N.x [m/s]", "v_BN_N.y [m/s]", "v_BN_N.z [m/s]",
    "q_BN.w [1]", "q_BN.x [1]", "q_BN.y [1]", "q_BN.z [1]", "omega_BN_B.x [rad/s]", "omega_BN_B.y [rad/s]",
    "omega_BN_B.z [rad/s]", "r_CN_N.x [m]", "r_CN_N.y [m]", "r_CN_N.z [m]", "v_CN_N.x [m/s]", "v_CN_N.y [m/s]",
    "v_CN_N.z [m/s]", "rw.rate [rad/s]", "wing.1.position [rad]", "wing.1.rate [rad/s]", "arm.position [rad]",
    "arm.rate [rad/s]", "slider.position [m]", "slider.rate [m/s]", "mass [kg]"]
INITIAL = {  # coordinates that are not here: 0
    "r_BN_N": [-0.026007411935387477, -0.00544573561641666, 0],
    "v_BN_N": [0.0005453813160843156, -0.00106740682423953, 0], "q_BN": [1, 0, 0, 0], "sigma_BN": [0, 0, 0],
    "omega_BN_B": [0, 0, 0], "arm.position": 0.5235987755982988, "arm.rate": 0.1, "slider.position": 0.02,
    "slider.rate": 0.001}
INPUTS = [  # from when on [s, N, N m, kg/s]
    [0, {"arm.torque": 0, "slider.force": 1.5, "push.force": [0, 0, 0]}],
    [1, {"arm.torque": 0.2, "push.force": [-1, 0, 0]}], [2, {"arm.torque": 0, "push.force": [0, 0, 0]}]]
XML = """<mujoco><compiler angle="radian"/><option><flag constraint="disable"/></option><worldbody>
<body name="hub"><freejoint name="hub"/><inertial pos="0 0 0" mass="600" diaginertia="400 380 360"/>
 <body name="arm" pos="0.5 0 0">
  <joint name="arm" axis="0 0 1" stiffness="10" springref="0.05235987755982989" damping="0.5"/>
  <inertial pos="0.4 0 0" mass="12" diaginertia="0.1 0.9 0.9"/>
  <body name="tool" pos="0.8 0 0" quat="0 0 0 1">
   <inertial pos="0.1 0 0" mass="1.999999" diaginertia="0.01 0.02 0.03"/>
   <body name="rw" pos="0.1 0 0"><joint name="rw" axis="1 0 0"/>
    <inertial pos="0 0 0" mass="1e-06" diaginertia="0.02 0.0125 0.0125"/></body>
   <body name="wing.1" pos="0 0.1 0" quat="0.7071067811865476 0.7071067811865475 0 0">
    <joint name="wing.1" axis="0 1 0"/><inertial pos="0.5 0 0" mass="4" diaginertia="0.5 0.25 0.5"/></body></body>
  <body name="slider"><joint name="slider" type="slide" axis="0 1 0"/>
   <inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.01"/></body></body></body></worldbody></mujoco>"""
# JOINTS: in the order of MuJoCo, with their inputs
JOINTS = {"arm": "arm.torque", "rw": None, "wing.1": None, "slider": "slider.force"}
# PUSHES: loads and thrusters: the body, in whose axes they act, and where [m]
PUSHES = {"push": {"on": "arm", "at": [0.8, 0, 0.5]}}
REFUSED = {"bsm": [
    "arm: `slider` and `wing.1` branch off it, and Basilisk's effectors are chains on the hub",
    "rw: its mount `arm` carries more than the wheel, and only the last body of a chain of Basilisk's can be a wheel"]}
REFUSED |= {} if Basilisk.hasBuildFeature("mujoco") else {"mjscene": ["this Basilisk has no MuJoCo"]}
HALVES = [name for name in ("bsm", "mjscene") if name not in REFUSED]


class Vehicle(sysModel.SysModel):
    """In a task after its `modules`: it sets the state of t = 0, again at every Reset, and holds what acts."""

    def __init__(self, engine):
        super().__init__()
        self.modules, self.parts, self.holds = [], {}, []
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
            if effort:
                motor = self.parts[name] = self.body.addJointSingleActuator(name, name)
                self.link(motor.actuatorInMsg, "SingleActuator", lambda u, effort=effort: {"input": u.get(effort, 0)})
        for name, place in PUSHES.items():
            self.add_push(name, **place)

    def add_push(self, name, on, at):
        actuator = self.parts[name] = self.body.addForceTorqueActuator(name, on + "_origin")
        self.link(actuator.forceInMsg, "ForceAtSite", lambda u: {"force_S": u.get(name + ".force", [0, 0, 0])})
        self.link(actuator.torqueInMsg, "TorqueAtSite", lambda u: {"torque_S": np.add(
            u.get(name + ".torque", [0, 0, 0]), np.cross(at, u.get(name + ".force", [0, 0, 0])))})

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
