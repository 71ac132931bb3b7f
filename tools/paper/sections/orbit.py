"""A point mass on orbit for two periods, against Kepler."""

import math

from plot import ENGINE_COLOUR, ENGINE_NAME, GREY, Plot, slope_line, ticks
from runs import ENGINES, Report, Runner
from verdict import PUBLISHED, Section

NAME = "orbit"
MU = 3.98600436e14  # [m3/s2]
STEPS = (2.5, 5.0, 10.0, 20.0, 40.0)  # [s]


def energy_drift(report: Report, engine: str) -> float:
    trajectory = report.trajectory(engine)
    energies = [
        0.5 * math.hypot(*v) ** 2 - MU / math.hypot(*r)
        for r, v in zip(trajectory.vector("r_BN_N"), trajectory.vector("v_BN_N"))
    ]
    return max(abs(e - energies[0]) for e in energies) / abs(energies[0])


def worst(report: Report, member: int = 0) -> float:
    return max(report.reference("kepler", engine, "position_m", member) for engine in ENGINES)


def run(runner: Runner, plots: dict[str, Plot]) -> Section:
    section = Section(
        "Translational orbit",
        "A point mass on an eccentric orbit, RK4, held against Kepler's solution. There is one way "
        "only: without attitude the paper's machines and ours are the same.",
    )
    base = runner.run("orbit")
    steps = runner.run("studies/orbit_steps")
    section.add("orbit.kepler", worst(base), worst(base))
    drift = max(energy_drift(base, engine) for engine in ENGINES)
    section.add("orbit.energy", drift, drift)
    section.add("orbit.coarse", worst(steps, 0), worst(steps, 0))
    section.add("orbit.fine", worst(steps, 4), worst(steps, 4))
    orders = steps.trend("convergence", engine="mujoco", metric="position_m")["orders"]
    for i, order in enumerate(orders):
        section.add(f"orbit.order{i}", order)
    section.add("orbit.cross", base.agreement("position_m"), base.agreement("position_m"))
    cross = [steps.agreement("position_m", i) for i in range(5)]
    section.add("orbit.cross_sweep", max(cross), max(cross))

    error = Plot("Error against the Kepler orbit", "step [s]", "largest distance [m]", "xy")
    for engine in ENGINES:
        trend = steps.trend("convergence", engine=engine, metric="position_m")
        points = list(zip(trend["steps_s"], trend["errors"]))
        look = {"marker": 7} if engine == "bsm" else {"marker": 4, "dash": 2}
        error.add(ENGINE_NAME[engine], points, ENGINE_COLOUR[engine], **look)
    error.add("fourth order", slope_line(points, 4), GREY, style="lines", dash=3)
    error.extra = ticks("x", STEPS, 2.0, 50.0)
    plots["figure-1a"] = error
    section.figure("figure-1a", "error of the orbit against the step; both engines on one curve")
    residual = Plot("Distance of the engines", "step [s]", "largest distance [m]", "xy")
    residual.key, residual.zero = "center right", 1.0e-10
    residual.add("BSM and MuJoCo", list(zip(trend["steps_s"], cross)), ENGINE_COLOUR["bsm"])
    bound = PUBLISHED["orbit.cross_sweep"]["published"]
    residual.add("the paper's bound", [(2.5, bound), (40.0, bound)], GREY, style="lines", dash=3)
    residual.extra = ticks("x", STEPS, 2.0, 50.0)
    plots["figure-1b"] = residual
    section.figure("figure-1b", "distance of the engines against the step")
    return section
