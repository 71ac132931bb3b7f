"""Segmented arrays, as panels and as general bodies."""

from plot import BLUE, GREEN, VERMILION, Plot, ticks
from runs import Report, Runner, attitude_history
from verdict import Section

NAME = "flex"


def segments(runner: Runner) -> tuple[int, ...]:
    return (1, 2, 4, 8) if runner.quick else (1, 2, 4, 8, 16, 32)


def panels_run(runner: Runner) -> Report:
    """The sweep; its steps for the long chains are short, so a quick run stops at 8."""
    if not runner.quick:
        return runner.run("studies/flex_segments")
    sweep = f"study={{sweep: [{{set: panels.*.segments, values: {list(segments(runner))}}}]}}"
    return runner.run("studies/flex_segments", "flex_segments", (sweep,))


def run(runner: Runner, plots: dict[str, Plot]) -> Section:
    section = Section(
        "Segmented flexible panels",
        "Two arrays of N segments, 8 to 70 coordinates, three times: as `panels`, which the "
        "analytic engine eliminates in their plane, in the place of the paper's "
        "nHingedRigidBody; as `bodies`, which take its general recursion, in the place of "
        "spinningBodyNDOF; and as MuJoCo's tree.",
    )
    panels = panels_run(runner)
    largest: dict[str, list[tuple[float, float]]] = {"mujoco": [], "bodies_mujoco": [], "bodies": []}
    for member, n in enumerate(segments(runner)):
        bodies = runner.run(f"flex_bodies/{n:02}", f"flex_bodies_{n:02}")
        between = attitude_history(panels.trajectory("bsm", member), bodies.trajectory("bsm"))
        dof = 6 + 2 * n
        largest["mujoco"].append((dof, panels.agreement("attitude_deg", member)))
        largest["bodies_mujoco"].append((dof, bodies.agreement("attitude_deg")))
        largest["bodies"].append((dof, max(angle for _, angle in between)))
    for key, points in largest.items():
        worst = max(y for _, y in points)
        section.add(f"flex.{key}", worst, worst)
    if runner.quick:
        section.text += " The quick run stops at N = 8."

    plot = Plot("Segmented panels", "degrees of freedom", "largest difference [deg]", "xy")
    for key, name, colour, marker in (
        ("mujoco", "panels, MuJoCo", BLUE, 7),
        ("bodies_mujoco", "bodies, MuJoCo", VERMILION, 4),
        ("bodies", "panels, bodies", GREEN, 2),
    ):
        plot.add(name, largest[key], colour, marker=marker)
    plot.zero = 1.0e-15
    plot.extra = ticks("x", (8, 10, 14, 22, 38, 70), 7, 80)
    plots["figure-7"] = plot
    section.figure("figure-7", "largest attitude difference of every pair against the coordinates")
    return section
