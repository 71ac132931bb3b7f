"""What the analytic engine must reach, and what it reached."""

from __future__ import annotations

import dataclasses
import math

from cases import ALL, FLEX, GENERAL, TABLE_1
from measure import Results

PAPER = [case.name for case in (*TABLE_1, *FLEX.values())]
BODIES = [case.name for case in GENERAL if case.name.startswith("bodies")]
SMALL, LARGE = FLEX[16].name, FLEX[32].name  # 38 and 70 coordinates


@dataclasses.dataclass(frozen=True)
class Claim:
    what: str
    must: str
    aim: str
    reached: str
    holds: bool
    reaches_aim: bool


def at_most(what: str, value: float, must: float, aim: float, form: str, note: str = "") -> Claim:
    show = form.format
    return Claim(
        what, f"≤ {show(must)}", f"≤ {show(aim)}", show(value) + note, value <= must, value <= aim
    )


def speed(results: Results, name: str) -> float:
    return results.races[name]["ratios_of_best"]["forward_over_bsm"]


def slowest(
    results: Results, names: list[str], must: float, aim: float | None, what: str
) -> Claim:
    worst = min(names, key=lambda name: speed(results, name))
    value = speed(results, worst)
    reached = f"{value:.1f}" + (f" ({worst})" if len(names) > 1 else "")
    aimed = "" if aim is None else f"≥ {aim:g}"
    reaches = aim is not None and value >= aim
    return Claim(what, f"≥ {must:g}", aimed, reached, value >= must, reaches)


def exponent(small: float, large: float) -> float:
    """Of growth from 38 to 70 coordinates."""
    return math.log(large / small) / math.log(70 / 38)


def exponent_of_counts(results: Results, engine: str) -> float:
    small, large = (results.counts[name, engine].instructions for name in (SMALL, LARGE))
    return exponent(small, large)


def exponent_of_time(results: Results, engine: str) -> float:
    small, large = (
        results.races[name]["engines"][engine]["best_us_per_step"] for name in (SMALL, LARGE)
    )
    return exponent(small, large)


def wrapper(results: Results, name: str) -> float:
    """Instructions of our MuJoCo engine beyond the bare sub-stages, in percent."""
    ours, bare = (results.counts[name, engine].instructions for engine in ("mujoco", "minimal"))
    return 100.0 * (ours / bare - 1.0)


def heap(results: Results) -> float:
    engines = ("portable", "bsm", "mujoco")
    return max(results.counts[case.name, engine].heap for case in ALL for engine in engines)


def claims(results: Results) -> list[Claim]:
    overhead = max(PAPER, key=lambda name: wrapper(results, name))
    against = "times faster than MuJoCo's own `mj_forward` loop, "
    in_heap = heap(results)
    return [
        slowest(results, PAPER, 4, None, against + "worst row of the paper's"),
        slowest(results, [FLEX[n].name for n in (1, 2, 4, 8)], 4, 15, against + "flex, N ≤ 8"),
        slowest(results, [SMALL], 4, 20, against + "flex, N=16"),
        slowest(results, [LARGE], 4, 30, against + "flex, N=32"),
        slowest(results, BODIES, 3, 5, against + "the same vehicle as bodies, any N"),
        at_most(
            "instructions per step, flex, N=32, any x86-64",
            results.counts[LARGE, "portable"].instructions,
            230_000,
            60_000,
            "{:,.0f}",
        ),
        at_most(
            "growth exponent, 38 to 70 coordinates, instructions",
            exponent_of_counts(results, "portable"),
            1.2,
            1.05,
            "{:.2f}",
        ),
        at_most(
            "growth exponent, 38 to 70 coordinates, time",
            exponent_of_time(results, "bsm"),
            1.2,
            1.05,
            "{:.2f}",
        ),
        at_most(
            "our MuJoCo engine beyond MuJoCo's bare sub-stages, instructions",
            wrapper(results, overhead),
            10,
            3,
            "{:.1f} %",
            f" ({overhead})",
        ),
        Claim(
            "instructions in the heap's functions within a step, either engine",
            "0",
            "0",
            f"{in_heap:g}",
            in_heap == 0,
            in_heap == 0,
        ),
        throughput(results),
    ]


def throughput(results: Results) -> Claim:
    """Of a batch of N=16, one core; the aim is that of the widest set of this machine."""
    steps = results.batches[SMALL]
    best = max(steps, key=steps.__getitem__)
    aim = 1.5 if "AVX-512" in steps else 0.9
    reached = steps[best] / 1e6
    return Claim(
        "million spacecraft-steps a second, one core, batch of flex, N=16",
        "≥ 0.5",
        f"≥ {aim:g}",
        f"{reached:.2f} ({best})",
        reached >= 0.5,
        reached >= aim,
    )
