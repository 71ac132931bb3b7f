"""What the propagation costs: Table 1, the growth with the coordinates, the ranking by integrator.
Nothing here is judged: it is of the machine that ran it."""

from __future__ import annotations

from math import log

from document import paragraph, table
from plot import BLUE, GREEN, VERMILION, Plot, ticks
from runs import Report, Runner
from sections import work_precision
from verdict import PUBLISHED_COST, Section

NAME = "cost"
CASES = {
    "orbit": "Two-body orbit (11 640 s, step 10 s)",
    "torque": "Orbiting torqued rigid body (600 s, 0.1 s)",
    "rw_panels": "Hub, 3 wheels, 2 panels, no gravity (120 s, 0.02 s)",
    "orbit_compact": "Orbiting hub, 3 wheels (one orbit, 0.1 s)",
    "orbit_extended": "Orbiting hub, 3 wheels, 2 panels (one orbit, 0.1 s)",
    "variable_mass_orbit": "Variable mass and slosh on orbit (900 s, 0.05 s)",
}
SEGMENTS = (1, 2, 4, 8, 16, 32)
# Of 600 steps, as in studies/flex_cost.
DURATIONS = ("6 s", "3.65 s", "1.29 s", "0.456 s", "0.161 s", "0.057 s")
SCALING = PUBLISHED_COST["scaling"]


def per_step(report: Report, engine: str, member: int = 0) -> float:
    """[us]"""
    return report.members[member]["timing"][engine]["us_per_step"]


def table_1(runner: Runner) -> str:
    rows = []
    for spec, words in CASES.items():
        paper = PUBLISHED_COST["table_1"]["rows"][spec]
        report = runner.run(spec, f"time_{spec}", trials=1 if runner.quick else 5)
        timing = report.members[0]["timing"]
        cells = [f"{paper['bsm_s']:.4f}", f"{paper['mujoco_s']:.4f}", f"{paper['ratio']:.2f}"]
        cells += [f"{timing[engine]['median_s']:.4f}" for engine in ("bsm", "mujoco")]
        ratio = timing.get("ratio_bsm_over_mujoco")  # absent when the trials scatter
        cells += ["-" if ratio is None else f"{ratio:.2f}"]
        rows.append([words, *cells])
    head = ["case", "paper BSM [s]", "MuJoCo [s]", "ratio", "here BSM [s]", "MuJoCo [s]", "ratio"]
    return "Table 1, seconds of propagation; a ratio below one says that the BSM is faster.\n\n" + table(
        head, rows
    )


def growth(runner: Runner, plots: dict[str, Plot]) -> str:
    trials = 1 if runner.quick else 5
    panels = runner.run("studies/flex_cost", trials=trials)
    times: dict[str, list[tuple[int, float]]] = {"panels": [], "bodies": [], "mujoco": []}
    for member, (n, duration) in enumerate(zip(SEGMENTS, DURATIONS)):
        bodies = runner.run(
            f"flex_bodies/{n:02}", f"time_flex_bodies_{n:02}",
            (f"simulation.duration={duration}", "simulation.record=1 s"), trials,
        )  # fmt: skip
        dof = 6 + 2 * n
        times["panels"].append((dof, per_step(panels, "bsm", member)))
        times["bodies"].append((dof, per_step(bodies, "bsm")))
        times["mujoco"].append((dof, per_step(panels, "mujoco", member)))
    plot = Plot("Cost of a step", "degrees of freedom", "time of one RK4 step [us]", "xy")
    for key, name, colour, marker in (
        ("panels", "BSM, panels", BLUE, 7),
        ("bodies", "BSM, bodies", GREEN, 2),
        ("mujoco", "MuJoCo", VERMILION, 4),
    ):
        plot.add(name, times[key], colour, marker=marker)
    plot.extra = ticks("x", (8, 10, 14, 22, 38, 70), 7, 80) + "set format y '%g'\n"
    plots["figure-8"] = plot
    return growth_table(times) + "\n\n" + exponents(times)


def with_paper(ours: float, published: dict[str, float], dof: int) -> str:
    """Ours, and the paper's in brackets where it gives one."""
    paper = published.get(str(dof))
    return f"{ours:.2f}" + (f" ({paper:.2f})" if paper else "")


def growth_table(times: dict[str, list[tuple[int, float]]]) -> str:
    rows = []
    for (dof, panels), (_, bodies), (_, mujoco) in zip(*times.values()):
        rows.append([
            str(dof), f"{panels:.2f}", f"{bodies:.2f}", f"{mujoco:.2f}",
            with_paper(panels / mujoco, SCALING["panels_over_mujoco"], dof),
            with_paper(bodies / mujoco, SCALING["bodies_over_mujoco"], dof),
            with_paper(bodies / panels, SCALING["bodies_over_panels"], dof),
        ])  # fmt: skip
    head = ["DOF", "BSM, panels [us]", "BSM, bodies [us]", "MuJoCo [us]", "panels/MuJoCo",
            "bodies/MuJoCo", "bodies/panels"]  # fmt: skip
    text = (
        "Time of one RK4 step, medians over 600 steps; the paper's ratios, where it gives them, in "
        "brackets. Panels take the planar path of the analytic engine, bodies its general one."
    )
    return paragraph(text) + "\n\n" + table(head, rows)


def exponents(times: dict[str, list[tuple[int, float]]]) -> str:
    names = {"panels": "BSM, panels", "bodies": "BSM, bodies", "mujoco": "MuJoCo"}
    rows = []
    for key, points in times.items():
        (x1, y1), (x2, y2) = points[-2:]
        ours = log(y2 / y1) / log(x2 / x1)
        rows.append([names[key], f"{SCALING['exponents_38_to_70'][key]:.2f}", f"{ours:.2f}"])
    text = (
        "Growth of the cost from 38 to 70 coordinates, as an exponent. The paper's analytic "
        "effectors invert a dense matrix; ours eliminates one joint after another."
    )
    return paragraph(text) + "\n\n" + table(["engine", "paper", "here"], rows)


def ranking(runner: Runner) -> str:
    rows = []
    for name, count in PUBLISHED_COST["ranking"]["mujoco_faster_in"].items():
        faster = work_precision.study(runner, name).json["studies"]["work_precision"]["bsm_faster"]
        title = work_precision.STUDIES[name][1]
        rows.append([title, f"MuJoCo in {count} of {count}", f"BSM in {faster['in']} of {faster['of']}"])
    text = "Which engine is faster, configuration by configuration (Figures 9 and 10).\n\n"
    return text + table(["study", "paper", "here"], rows)


def load_words(runner: Runner) -> str:
    """How much else the machine had to do: the largest load average at the start of a timed run."""
    loads = [
        report.json["provenance"]["load_average"]
        for report in runner.done.values()
        if "timing" in report.members[0]
    ]
    known = [load for load in loads if load is not None]
    if not known:
        return ""
    cores = runner.provenance.get("cores", "?")
    return f" The load average was at most {max(known):.1f} on {cores} cores when a run began."


def run(runner: Runner, plots: dict[str, Plot]) -> Section:
    section = Section(
        "Propagation cost",
        "Of the machine named at the top: another one gives other numbers, and a busy one other "
        "ratios. Nothing here is judged. The protocol is the paper's: propagation alone, nothing "
        "recorded, one warm-up, "
        + ("one trial" if runner.quick else "the median of five trials")
        + ", the order of the engines reversed every other round. The analytic engine of "
        "the paper copies its states through maps; ours is a recursion over fixed-size structures, "
        "so its side of the ratios is another program. The vehicles are run the exact way.",
    )
    section.tables = [table_1(runner), growth(runner, plots), ranking(runner)]
    section.text += load_words(runner)
    section.figure("figure-8", "time of a step against the coordinates")
    return section
