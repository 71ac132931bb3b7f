"""brick: a spacecraft

By sccompile 0.1.0 for Basilisk 2.12 and later, from the spec whose resolved form has the SHA-256
981fe7bc700276f55c8851f8040a5c4762769a25c2ba8cdcbb4d88bf97c9af7e. SI units and radians, names as in Basilisk."""
# flake8: noqa: E501
import argparse
import pathlib
import sys
import time
try:
    import Basilisk
    import numpy as np
    from Basilisk.architecture import bskLogging, messaging, sysModel
    from Basilisk.simulation import spacecraft, svIntegrators
    assert [int(n) for n in Basilisk.__version__.split(".")[:2]] >= [2, 12], f"this is {Basilisk.__version__}"
except (ImportError, AssertionError) as error:
    sys.exit(f"Basilisk 2.12 or later and numpy are needed (pip install bsk): {error}")
STEP, DURATION, RECORD, INTEGRATOR = 0.1, 10, 1, svIntegrators.svIntegratorRK4  # [s]
COLUMNS = [
    "t [s]", "r_BN_N.x [m]", "r_BN_N.y [m]", "r_BN_N.z [m]", "v_BN_N.x [m/s]", "v_BN_N.y [m/s]", "v_BN_N.z [m/s]",
    "q_BN.w [1]", "q_BN.x [1]", "q_BN.y [1]", "q_BN.z [1]", "omega_BN_B.x [rad/s]", "omega_BN_B.y [rad/s]",
    "omega_BN_B.z [rad/s]", "r_CN_N.x [m]", "r_CN_N.y [m]", "r_CN_N.z [m]", "v_CN_N.x [m/s]", "v_CN_N.y [m/s]",
    "v_CN_N.z [m/s]", "mass [kg]"]
INITIAL = {  # coordinates that are not here: 0
    "r_BN_N": [-0.04305940289319788, 0.21312711603570333, -0.07226839027393042],
    "v_BN_N": [0.0005907202216066475, -0.001037396121883657, -0.0034113573407202223],
    "q_BN": [0.7543859649122807, 0.1754385964912281, 0.3508771929824562, -0.5263157894736843],
    "sigma_BN": [0.1, 0.2, -0.30000000000000004], "omega_BN_B": [0.01, -0.02, 0.015]}
INPUTS = [[0, {}]]  # from when on [s, N, N m, kg/s]
# HUB: with what is fixed on it: mass, centre, inertia about it [kg, m, kg m2]
HUB = [750, [0.1, -0.05, 0.2], [[900, 10, -20], [10, 800, 30], [-20, 30, 600]]]
XML = """<mujoco><compiler angle="radian"/><option><flag constraint="disable"/></option><worldbody>
<body name="hub"><freejoint name="hub"/>
 <inertial pos="0.1 -0.05 0.2" mass="750" quat="0.6816529098326609 0.02620643699863514 0.7268179848918638
   0.07998843675327832" diaginertia="594.1209057684159 803.905848189786 901.9732460417974"/></body></worldbody></mujoco>"""
REFUSED = {} if Basilisk.hasBuildFeature("mujoco") else {"mjscene": ["this Basilisk has no MuJoCo"]}
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

    def bsm(self):
        """A Spacecraft with effectors, solved by back-substitution."""
        self.body = spacecraft.Spacecraft()
        self.seen = self.body.scStateOutMsg
        self.whole = lambda seen: ([*seen.r_CN_N, *seen.v_CN_N], self.body.scMassOutMsg.read().massSC)
        self.states = {"r_BN_N": ("hubPosition", 0), "v_BN_N": ("hubVelocity", 0),
                       "sigma_BN": ("hubSigma", 0), "omega_BN_B": ("hubOmega", 0)}
        self.body.hub.mHub, self.body.hub.r_BcB_B, self.body.hub.IHubPntBc_B = HUB

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


def build(sim, task, engine="bsm"):
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
