"""What accuracy costs: error against cost for five integrators."""

from __future__ import annotations

from document import number, table
from plot import ENGINE_COLOUR, ENGINE_NAME, GREY, Plot
from runs import ENGINES, Report, RunFailed, Runner
from verdict import Section

NAME = "work_precision"
# [deg] a good ten times what the engines differ by in runs of this length (Figure 7)
ROUNDING = 1.0e-11
STUDIES = {"rw": ("9", "Wheels and panels", "5 s"), "flex": ("10", "Sixteen segments", "0.4 s")}
FIXED = {"euler": "Euler", "rk2": "RK2", "rk4": "RK4"}
ADAPTIVE = {"rkf45": "RKF45", "rkf78": "RKF78"}
MARKERS = {"euler": 1, "rk2": 4, "rk4": 6, "rkf45": 8, "rkf78": 12}


def study(runner: Runner, name: str) -> Report:
    """The whole study; a quick run flies a part of the horizon, once."""
    spec = f"studies/work_precision_{name}"
    if runner.quick:
        return runner.run(spec, sets=(f"simulation.duration={STUDIES[name][2]}",), trials=1)
    return runner.run(spec, trials=5)


def by_integrator(report: Report, engine: str) -> dict[str, list[dict]]:
    families: dict[str, list[dict]] = {}
    for point in report.json["studies"]["work_precision"][engine]["configurations"]:
        families.setdefault(point["settings"]["simulation.integrator"], []).append(point)
    return families


def floor_of(report: Report) -> float:
    work = report.json["studies"]["work_precision"]
    if any(engine not in work for engine in ENGINES):
        raise RunFailed(f"{report.folder.name}: a reference run did not end well")
    return max(work[engine]["floor"]["attitude_deg"] for engine in ENGINES)


def ratios(report: Report) -> dict[str, list[float]]:
    """Larger over smaller error of the two engines, configuration by configuration, where both
    stand well above the floor and above rounding, so that neither is a part of them."""
    floor = max(3 * floor_of(report), ROUNDING)
    of_bsm, of_mujoco = (by_integrator(report, engine) for engine in ENGINES)
    found: dict[str, list[float]] = {}
    for family, points in of_bsm.items():
        for a, b in zip(points, of_mujoco[family]):
            if a["diverged"] or b["diverged"]:
                continue
            pair = sorted((a["attitude_deg"], b["attitude_deg"]))
            if pair[0] > floor:
                found.setdefault(family, []).append(pair[1] / pair[0])
    return found


def shape_table(report: Report) -> str:
    found = ratios(report)
    rows = []
    for family, points in by_integrator(report, "bsm").items():
        name = (FIXED | ADAPTIVE)[family]
        diverged = [sum(p["diverged"] for p in by_integrator(report, e)[family]) for e in ENGINES]
        errors = [p["attitude_deg"] for p in points if not p["diverged"]]
        span = f"{number(max(errors))} to {number(min(errors))}" if errors else "none"
        ratio = f"{max(found[family]):.3f}" if family in found else "below the floor"
        rows.append([name, str(len(points)), f"{diverged[0]}, {diverged[1]}", span, ratio])
    head = ["integrator", "configurations", "diverged (BSM, MuJoCo)", "errors [deg]", "largest ratio"]
    return table(head, rows)


def figure(report: Report, title: str, families: dict[str, str]) -> Plot | None:
    plot = Plot(title, "time [s]", "attitude error [deg]", "xy", "outside right center")
    times = []
    for engine in ENGINES:
        for family, points in by_integrator(report, engine).items():
            good = [(p["median_s"], p["attitude_deg"]) for p in points if not p["diverged"]]
            if family not in families or not good:
                continue
            times += [t for t, _ in good]
            plot.add(
                f"{ENGINE_NAME[engine]}, {families[family]}", good, ENGINE_COLOUR[engine],
                marker=MARKERS[family],
            )  # fmt: skip
    if not times:
        return None
    floor = floor_of(report)
    plot.add("floor", [(min(times), floor), (max(times), floor)], GREY, style="lines", dash=3)
    return plot


def run(runner: Runner, plots: dict[str, Plot]) -> Section:
    section = Section(
        "Work and precision",
        "Every configuration's final attitude against the same engine's own tight run (RKF78, "
        "tolerance 1e-13). The paper finds that the engines' curves have one shape and differ in "
        "cost alone; the ratio below is of their errors in one configuration, larger over smaller, "
        "where both stand three times above the floor and above 1e-11 deg, which rounding does not "
        "reach. The costs themselves depend on the machine "
        "and stand in the last section.",
    )
    if runner.quick:
        section.text += " The quick run flies a part of the horizon."
    for name, (number_of_figure, title, _) in STUDIES.items():
        report = study(runner, name)
        found = [ratio for family in ratios(report).values() for ratio in family]
        section.add(f"work.shape.{name}", max(found) if found else None)
        text = f"{title}; floor of the references {number(floor_of(report))} deg.\n\n"
        section.tables.append(text + shape_table(report))
        for letter, kind, families in (("a", "fixed steps", FIXED), ("b", "adaptive", ADAPTIVE)):
            plot = figure(report, f"{title}, {kind}", families)
            if plot is None:
                continue
            plots[f"figure-{number_of_figure}{letter}"] = plot
            section.figure(f"figure-{number_of_figure}{letter}", f"{title.lower()}, {kind}")
    return section
