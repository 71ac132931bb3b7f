"""Truths that nobody here computed: stored states of others, closed forms, random vehicles."""

import re
import subprocess

from document import number, table
from plot import Plot
from runs import ENGINES, ROOT, RunFailed, Runner
from verdict import Section

NAME = "truth"
NESC = {
    "8a": "orbit alone",
    "9a": "a torque for a while",
    "9b": "the same, turning with the orbit",
    "10a": "gravity gradient, turning with the orbit",
}
METRICS = ("position_m", "velocity_m_s", "attitude_deg", "rate_rad_s")
COUNT = {False: 20000, True: 500}  # of random vehicles, by `quick`


def run(runner: Runner, plots: dict[str, Plot]) -> Section:
    section = Section(
        "External truth",
        "Two engines that agree can both be wrong. NASA's orbital check cases (NESC, "
        "six-degree-of-freedom simulations) come with final states that others computed; closed "
        "forms know the motion at all times. The number is the larger of both engines' errors.",
    )
    for case, what in NESC.items():
        report = runner.run(f"../nesc/case_{case}", f"nesc_{case}")
        stored = report.members[0]["references"]["stored"]
        for metric in METRICS:
            ours = max(stored[engine][metric]["max"] for engine in ENGINES)
            name, unit = metric.split("_", 1)
            bound = stored["bsm"][metric]["tolerance"]
            section.bound(f"check case {case.upper()}, {what}: {name}", unit, ours, bound)
    tumble = runner.run("../gallery/tumble", "tumble")
    rocket = runner.run("../gallery/rocket", "rocket")
    section.bound(
        "torque-free tumble of an unsymmetric body, 1000 s: rate (elliptic functions)",
        "rad_s",
        max(tumble.reference("torque_free", engine, "rate_rad_s") for engine in ENGINES),
        1.0e-11,
    )
    section.bound(
        "rocket equation: speed gained, relative",
        "",
        max(relative_gain(rocket, engine) for engine in ENGINES),
        1.0e-12,
    )
    section.tables.append(random_vehicles(runner.quick))
    section.tables.append(balances(runner))
    return section


def relative_gain(rocket, engine: str) -> float:
    return rocket.reference("tsiolkovsky", engine, "delta_v_relative")


def random_vehicles(quick: bool) -> str:
    """The last lines that tools/random-vehicles prints, as a table."""
    command = [str(ROOT / "tools" / "random-vehicles"), str(COUNT[quick])]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    lines = done.stdout.strip().splitlines()
    if done.returncode != 0 or not lines:
        raise RunFailed(f"random vehicles: {done.stderr.strip() or ' '.join(lines[-1:])}")
    found = [re.match(r"(.+?)  +(\S+)", line) for line in lines[:-1]]
    head = ["worst of all random vehicles", "number"]
    return f"Random vehicles over the whole language: {lines[-1]}.\n\n" + table(
        head, [list(match.groups()) for match in found if match]
    )


def balances(runner: Runner) -> str:
    """Of every run of this document: the books that no engine may break."""
    keys = ("energy_relative", "momentum_relative", "angular_momentum_relative")
    rows = []
    for name, report in runner.done.items():
        first = report.members[0]["engines"]
        if not all("conservation" in first.get(engine, {}) for engine in ENGINES):
            continue
        worst = [max(first[engine]["conservation"][key] for engine in ENGINES) for key in keys]
        rows.append([name, *map(number, worst)])
    head = ["run", "energy", "momentum", "angular momentum"]
    text = (
        "Balances of every run above, work and what leaves accounted, relative; the larger of "
        "both engines. They are of the order of the integrator's error, or rounding."
    )
    return text + "\n\n" + table(head, rows)
