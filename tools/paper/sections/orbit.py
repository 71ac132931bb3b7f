"""A point mass on orbit for two periods, against Kepler."""

import math

from plot import BLUE, ENGINE_COLOUR, ENGINE_NAME, GREY, VERMILION, Plot, slope_line, ticks
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
        "A point mass on an eccentric orbit, RK4, held against Kepler's solution. The paper's way "
        "gives MuJoCo the orbital state and a force; the exact way adds gravity to what MuJoCo "
        "answers in the frame that moves along.",
    )
    inertial = ("engines.mujoco.frame=inertial",)
    ways = (runner.run("orbit", "orbit_paper", inertial), runner.run("orbit"))
    sweeps = (
        runner.run("studies/orbit_steps", "orbit_steps_paper", inertial),
        runner.run("studies/orbit_steps"),
    )
    section.add("orbit.kepler", *map(worst, ways))
    section.add(
        "orbit.energy", *(max(energy_drift(way, engine) for engine in ENGINES) for way in ways)
    )
    section.add("orbit.coarse", *(worst(sweep, 0) for sweep in sweeps))
    section.add("orbit.fine", *(worst(sweep, 4) for sweep in sweeps))
    orders = sweeps[0].trend("convergence", engine="mujoco", metric="position_m")["orders"]
    for i, order in enumerate(orders):
        section.add(f"orbit.order{i}", order)
    section.add("orbit.cross", *(way.agreement("position_m") for way in ways))
    cross = [[sweep.agreement("position_m", i) for i in range(5)] for sweep in sweeps]
    section.add("orbit.cross_sweep", *map(max, cross))
    draw_error(sweeps[0], plots)
    section.figure("figure-1a", "error of the orbit against the step; both engines on one curve")
    draw_residual(cross, plots)
    section.figure("figure-1b", "distance of the engines against the step, both ways")
    return section


def draw_error(sweep: Report, plots: dict[str, Plot]) -> None:
    plot = Plot("Error against the Kepler orbit", "step [s]", "largest distance [m]", "xy")
    for engine in ENGINES:
        trend = sweep.trend("convergence", engine=engine, metric="position_m")
        points = list(zip(trend["steps_s"], trend["errors"]))
        look = {"marker": 7} if engine == "bsm" else {"marker": 4, "dash": 2}
        plot.add(ENGINE_NAME[engine], points, ENGINE_COLOUR[engine], **look)
    plot.add("fourth order", slope_line(points, 4), GREY, style="lines", dash=3)
    plot.extra = ticks("x", STEPS, 2.0, 50.0)
    plots["figure-1a"] = plot


def draw_residual(cross: list[list[float]], plots: dict[str, Plot]) -> None:
    plot = Plot("Distance of the engines", "step [s]", "largest distance [m]", "xy")
    plot.key, plot.zero = "at graph 0.98, 0.88", 1.0e-10
    for name, residuals, colour in zip(("the paper's way", "exact"), cross, (VERMILION, BLUE)):
        plot.add(name, list(zip(reversed(STEPS), residuals)), colour)
    bound = PUBLISHED["orbit.cross_sweep"]["published"]
    plot.add("the paper's bound", [(2.5, bound), (40.0, bound)], GREY, style="lines", dash=3)
    plot.extra = ticks("x", STEPS, 2.0, 50.0)
    plots["figure-1b"] = plot
