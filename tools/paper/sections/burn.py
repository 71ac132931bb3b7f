"""A burn with a draining tank, a slosh pendulum and slosh particles, in deep space."""

import math

from plot import BLUE, GREEN, ORANGE, VERMILION, Plot
from runs import Runner, attitude_history
from verdict import Section

NAME = "variable_mass"
PAPER, EXACT = 0, 1  # members of the two ways
INERTIAS = ("1e-3", "1e-4", "1e-5", "1e-8")  # [kg m2] of the bob
STEPS = (0.05, 0.025, 0.0125)  # [s]


def step_sweep(runner: Runner, section: Section) -> list[list[float]]:
    """Attitude [deg] by inertia and step; the largest change is of the three larger inertias."""
    report = runner.run("studies/variable_mass_steps")
    rows = [
        [report.agreement("attitude_deg", 3 * i + j) for j in range(3)] for i in range(4)
    ]
    changes = [abs(fine / row[0] - 1) for row in rows[:3] for fine in row[1:]]
    section.add("burn.steps", max(changes))
    return rows


def run(runner: Runner, plots: dict[str, Plot]) -> Section:
    section = Section(
        "Variable mass and slosh",
        "The paper's way gives MuJoCo's bob 1e-4 and its particles 1e-6 kg m2 of inertia, which "
        "the analytic engine's point masses do not have, in the inertial frame; the exact way has "
        "point masses in both, in the frame that moves along.",
    )
    ways = runner.run("studies/variable_mass_ways")
    for key, metric in (
        ("attitude", "attitude_deg"), ("rate", "rate_rad_s"), ("slosh", "slosh_m"),
        ("pendulum", "pendulum_deg"), ("mass", "mass_kg"), ("com", "com_position_m"),
    ):  # fmt: skip
        section.add(f"burn.{key}", *(ways.agreement(metric, way) for way in (PAPER, EXACT)))
    final = ways.members[PAPER]["engines"]["bsm"]["final"]
    section.add("burn.velocity", math.hypot(*final["v_CN_N_m_s"]))
    bob = runner.run("studies/variable_mass_bob")
    for member, inertia in enumerate(INERTIAS):
        section.add(f"burn.bob{inertia}", bob.agreement("attitude_deg", member))
    if runner.quick:
        rows = [[bob.agreement("attitude_deg", member)] for member in range(4)]
        section.text += " The step sweep is left out of the quick run."
    else:
        rows = step_sweep(runner, section)
    rigid = runner.run("studies/variable_mass_rigid")
    section.add("burn.rigid", *(rigid.agreement("attitude_deg", way) for way in (PAPER, EXACT)))

    history = Plot("Hub attitude during the burn", "time [s]", "difference [deg]", "y", "bottom right")
    for way, name, colour in ((PAPER, "the paper's way", VERMILION), (EXACT, "one machine", BLUE)):
        pair = [ways.trajectory(engine, way) for engine in ("bsm", "mujoco")]
        history.add(name, attitude_history(*pair)[::20], colour, style="lines")
    plots["figure-6a"] = history
    section.figure("figure-6a", "hub attitude difference during the burn, both ways")
    sweep = Plot("Bob inertia and step", "bob inertia [kg m^2]", "largest difference [deg]", "xy")
    for j, (step, colour, marker) in enumerate(zip(STEPS, (BLUE, ORANGE, GREEN), (7, 4, 2))):
        if j < len(rows[0]):
            points = [(float(inertia), row[j]) for inertia, row in zip(INERTIAS, rows)]
            sweep.add(f"step {step:g} s", points, colour, marker=marker, dash=j + 1)
    plots["figure-6b"] = sweep
    section.figure("figure-6b", "largest attitude difference against bob inertia, at each step")
    return section
