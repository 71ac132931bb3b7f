"""A torqued rigid body on orbit, at rest and in uniform motion."""

import math

from plot import BLUE, GREEN, GREY, VERMILION, Plot, slope_line, ticks
from runs import ENGINES, Report, Runner, Trajectory, principal_angle
from verdict import Section

NAME = "torque"
STEPS = (0.4, 0.2, 0.1, 0.05, 0.025, 0.0125)  # [s]
INERTIA = (900.0, 800.0, 600.0)  # [kg m2]
IDENTITY = (1.0, 0.0, 0.0, 0.0)
REST, COMOVING, INERTIAL = 0, 1, 2  # members of torque_motion
DRIFT = {"comoving": 0, "inertial": 6}  # first members of torque_drift in either frame
SPEEDS = (0.0, 0.75, 1.5, 3.0, 5.0, 7.5)  # [km/s]


def bias(trajectory: Trajectory) -> list[float]:
    """The constant torque [N m] behind a body's turn from rest, with the sign of a bias force.

    A torque L turns the body by L t^2 / 2I, so L = 2 I phi / t^2; small turns are vectors. After
    10 s the turn is 1e-7 rad: a quaternion has nine digits of it, and no axis mixes with another.
    """
    t, q = trajectory.times[10], trajectory.attitudes[10]
    return [-I * 2 * (2 * part) / t**2 for I, part in zip(INERTIA, q[1:])]


def turn(report: Report, member: int) -> float:
    return max(principal_angle(IDENTITY, q) for q in report.trajectory("mujoco", member).attitudes)


def cross_engine(runner: Runner, section: Section) -> None:
    paper = runner.run("torque", "torque_paper", ("engines.mujoco.frame=inertial", "agreement=null"))
    exact = runner.run("torque", "torque_exact", ("engines.bsm.attitude=quaternion",))
    for key, metric in (("attitude", "attitude_deg"), ("rate", "rate_rad_s")):
        section.add(f"torque.{key}", paper.agreement(metric), exact.agreement(metric))
    spin = runner.run("studies/torque_principal")
    for key, metric in (("spin_rate", "rate_rad_s"), ("spin_attitude", "attitude_deg")):
        for engine in ENGINES:
            ours = spin.reference("spin_up", engine, metric)
            section.add(f"torque.{key}.{engine}", ours, ours)


def motion(runner: Runner, section: Section, plots: dict[str, Plot]) -> None:
    runs = [
        runner.run("studies/torque_motion", f"torque_motion_{h}", (f"simulation.step={h}",))
        for h in STEPS
    ]

    def sensitivity(engine: str, member: int) -> list[float]:
        return [run.against(engine, "attitude_deg", member) for run in runs]

    paper, exact = sensitivity("mujoco", INERTIAL), sensitivity("mujoco", COMOVING)
    section.add("torque.motion.bsm", *[max(sensitivity("bsm", COMOVING))] * 2)
    section.add("torque.motion.mujoco", paper[2], exact[2])
    section.add("torque.motion.least", min(paper), min(exact))
    section.add("torque.motion.most", max(paper), max(exact))
    plot = Plot("On orbit against at rest", "step [s]", "largest difference [deg]", "xy")
    plot.key, plot.zero = "center right", 1.0e-16
    plot.add("MuJoCo, inertial frame", list(zip(STEPS, paper)), VERMILION)
    plot.add("MuJoCo, moving frame", list(zip(STEPS, exact)), GREEN, marker=6)
    plot.add("BSM", list(zip(STEPS, sensitivity("bsm", COMOVING))), BLUE, marker=2)
    plot.extra = ticks("x", STEPS, 0.01, 0.5)
    plots["figure-2a"] = plot
    section.figure(
        "figure-2a",
        "what an orbit does to the rotation of either engine: in MuJoCo's inertial frame something "
        "without order in the step, elsewhere nothing",
    )


def at_rest(runner: Runner, section: Section, plots: dict[str, Plot]) -> None:
    trend = runner.run("studies/torque_steps").trend("convergence", metric="attitude_deg")
    points = list(zip(trend["steps_s"], trend["errors"]))
    section.add("torque.rest.coarse", points[0][1])
    section.add("torque.rest.fine", points[-1][1])
    plot = Plot("Difference of the engines at rest", "step [s]", "largest difference [deg]", "xy")
    plot.add("MRPs and a quaternion", points, BLUE)
    plot.add("fourth order", slope_line(points, 4), GREY, style="lines", dash=3)
    plot.extra = ticks("x", STEPS, 0.01, 0.5)
    plots["figure-2b"] = plot
    section.figure("figure-2b", "the engines at rest: two charts of attitude under one integrator")


def drift(runner: Runner, section: Section, plots: dict[str, Plot]) -> None:
    report = runner.run("studies/torque_drift")

    def against_rest(engine: str, frame: str) -> list[tuple[float, float]]:
        first = DRIFT[frame]
        return [
            (SPEEDS[i], report.against(engine, "attitude_deg", first + i)) for i in range(1, 6)
        ]

    for_bsm = max(y for frame in DRIFT for _, y in against_rest("bsm", frame))
    section.add("torque.drift.bsm", for_bsm, for_bsm)
    paper, exact = against_rest("mujoco", "inertial"), against_rest("mujoco", "comoving")
    section.add("torque.drift.slow", paper[0][1], exact[0][1])
    section.add("torque.drift.fast", paper[-1][1], exact[-1][1])
    plot = Plot("Uniform motion against rest", "speed [km/s]", "largest difference [deg]", "xy")
    plot.key, plot.zero = "center right", 1.0e-16
    plot.add("MuJoCo, inertial frame", paper, VERMILION)
    plot.add("speed squared", slope_line(paper, 2, 1.0), GREY, style="lines", dash=3)
    plot.add("MuJoCo, moving frame", exact, GREEN, marker=6)
    plot.add("BSM", against_rest("bsm", "inertial"), BLUE, marker=2)
    plot.extra = ticks("x", SPEEDS[1:], 0.6, 9.0)
    plots["figure-3"] = plot
    section.figure(
        "figure-3",
        "what a drift, which has no physical effect, does to the rotation of either engine",
    )


def isolated(runner: Runner, section: Section) -> None:
    speeds = runner.run("studies/torque_drift_isolated")
    still = runner.run(
        "studies/torque_drift_isolated", "torque_drift_still", ("engines.mujoco.frame=comoving",)
    )
    here, there = bias(speeds.trajectory("mujoco", 3)), bias(still.trajectory("mujoco", 3))
    for axis, paper, exact in zip("xyz", here, there):
        section.add(f"torque.bias.{axis}", paper, exact)
    axes = runner.run("studies/torque_drift_axis")
    along = [axes.trajectory("mujoco", i) for i in range(3)]
    section.add("torque.axis.bias", *[max(math.hypot(*bias(one)) for one in along)] * 2)
    section.add("torque.axis.drift", *[max(turn(axes, i) for i in range(3))] * 2)
    turns = [turn(speeds, i) for i in range(4)]
    for i in range(3):
        section.add(f"torque.speed{i}", turns[i + 1] / turns[i])
    mass = runner.run("studies/torque_drift_mass")
    section.add("torque.mass", turn(mass, 1) / turn(mass, 0))


def run(runner: Runner, plots: dict[str, Plot]) -> Section:
    section = Section(
        "Torqued rigid body",
        "The paper's way gives MuJoCo the raw inertial state and integrates MRPs in the analytic "
        "engine; the exact way evaluates MuJoCo in a frame that moves with the hub and, where the "
        "engines are compared with each other, integrates a quaternion in both. Each engine's "
        "rotation in motion is held against its own at rest by `study.compare`.",
    )
    cross_engine(runner, section)
    motion(runner, section, plots)
    at_rest(runner, section, plots)
    drift(runner, section, plots)
    isolated(runner, section)
    return section
