"""The tables of PERFORMANCE.md."""

from __future__ import annotations

from cases import ALL, GATED, RECORDED
from claims import (
    best,
    claims,
    exponent_of_counts,
    exponent_of_time,
    faster,
    recorded_instructions,
    recorded_time,
    set_times,
    wrapper,
)
from measure import COUNTED, Results

ENGINES = {"bsm": "analytic", "mujoco": "MuJoCo engine"}
CHANGED = 0.002  # of a count; less is not shown


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def claim_table(results: Results) -> str:
    rows = []
    for claim in claims(results):
        verdict = "aim" if claim.reaches_aim else "must" if claim.holds else "**MISSED**"
        rows.append([claim.what, claim.must, claim.aim, claim.reached, verdict])
    return table(["claim", "must", "aim", "reached", "holds"], rows)


def race_table(results: Results) -> str:
    rows = []
    for case in ALL:
        done = results.races[case.name]
        cells = [case.name, str(done["degrees_of_freedom"])]
        for name in ("bsm", "mujoco", "forward", "minimal", "step"):
            times = done["engines"][name]
            cells.append(f"{times['best_us_per_step']:.3g} / {times['median_us_per_step']:.3g}")
        cells += [f"{faster(results, case.name, than):.1f}" for than in ("forward", "step")]
        rows.append(cells)
    head = ["", "DOF", "analytic", "MuJoCo engine", "`mj_forward`", "sub-stages", "`mj_step`"]
    return table([*head, "times faster than `mj_forward`", "than `mj_step`"], rows)


def set_table(results: Results) -> str:
    sets = list(results.races[ALL[0].name]["sets"])
    rows = []
    for case in ALL:
        times = set_times(results.races[case.name])
        first = times[sets[0]]
        rows.append(
            [
                case.name,
                *(f"{times[name]:.3g}" for name in sets),
                *(f"{times[name] / first:.2f}" for name in sets[1:]),
            ]
        )
    return table(["", *sets, *(f"{name} over {sets[0]}" for name in sets[1:])], rows)


def recorded_table(results: Results) -> str:
    rows = []
    for case in RECORDED:
        cells = [case.name]
        for engine in ENGINES:
            counted = "portable" if engine == "bsm" else engine
            cells.append(f"{recorded_instructions(results, case, counted):.2f}")
            cells.append(f"{recorded_time(results, case, engine):.2f}")
        rows.append(cells)
    head = [f"{name}, {what}" for name in ENGINES.values() for what in ("instructions", "time")]
    return table(["recorded over bare", *head], rows)


def count_table(results: Results) -> str:
    rows = []
    for case in ALL:
        each = {engine: results.counts[case.name, engine].instructions for engine in COUNTED}
        times = f"{each['forward'] / each['portable']:.1f}"
        beyond = f"{wrapper(results, case.name):+.1f} %"
        rows.append([case.name, *(f"{count:,.0f}" for count in each.values()), times, beyond])
    head = ["", "analytic, any x86-64", "analytic, AVX2", "MuJoCo engine", "`mj_forward`"]
    more = ["sub-stages", "`mj_step`", "fewer", "MuJoCo engine beyond sub-stages"]
    return table([*head, *more], rows)


def history_table(results: Results) -> str:
    """A row a step: the first has counts, the others what changed and by how much."""
    rows = []
    before: dict[str, float] = {}
    for step in results.history:
        counts = step["instructions"]
        rows.append(
            [
                f"{step['title']} ({step['source']})",
                *(history_cell(before.get(case.name), counts.get(case.name)) for case in GATED),
            ]
        )
        before |= counts
    first = results.history[0]["instructions"] if results.history else {}
    rows.append(["in all", *(change(first.get(case.name), before.get(case.name)) for case in GATED)])
    return table(["after", *(case.name for case in GATED)], rows)


def history_cell(before: float | None, after: float | None) -> str:
    if after is None or (before is not None and abs(after / before - 1.0) < CHANGED):
        return ""
    return f"{after:,.0f}" if before is None else f"{after:,.0f} ({change(before, after)})"


def change(before: float | None, after: float | None) -> str:
    if before is None or after is None:
        return ""
    return f"{100.0 * (after / before - 1.0):+.1f} %"


def exponent_table(results: Results) -> str:
    named = [
        ("analytic, any x86-64", "portable"),
        ("analytic, best of the machine", "bsm"),
        ("MuJoCo engine", "mujoco"),
        ("`mj_forward`", "forward"),
    ]
    rows = []
    for name, engine in named:
        timed = "-" if engine == "portable" else f"{exponent_of_time(results, engine):.2f}"
        rows.append([name, f"{exponent_of_counts(results, engine):.2f}", timed])
    return table(["", "instructions", "time"], rows)


def batch_table(results: Results) -> str:
    sets = list(results.lanes)
    rows = []
    for name, row in results.batches.items():
        single = 1.0 / best(results.races[name], "bsm")
        rows.append([name, f"{single:.2f}", *(f"{row[one] / 1e6:.2f}" for one in sets)])
    return table(["", "one at a time", *(f"{s}, {results.lanes[s]} lanes" for s in sets)], rows)


def evaluation_table(results: Results) -> str:
    rows = [
        [
            name,
            f"{row['bsm']:.0f}",
            f"{row['mujoco']:.0f}",
            f"{row['mujoco'] / row['bsm']:.1f}",
            f"{results.jacobians[name]:.1f}",
        ]
        for name, row in results.evaluations.items()
    ]
    return table(["", "analytic [ns]", "MuJoCo engine [ns]", "ratio", "exact A and B [µs]"], rows)


def share_table(results: Results) -> str:
    rows = [[name, f"{100 * share:.1f} %"] for name, share in results.shares]
    return table(["instructions of a step", "share"], rows)
