"""What the engines must reach, and what they reached."""

from __future__ import annotations

import dataclasses
import math

from cases import ALL, FLEX, GENERAL, RECORDED, TABLE_1, Case
from measure import Results

FORWARD = "times faster than MuJoCo's own `mj_forward` loop: "
SMALL, LARGE = FLEX[16].name, FLEX[32].name  # 38 and 70 coordinates
PAPER = [case.name for case in (*TABLE_1, *FLEX.values())]

# Per row: what it must be at least, and the aim.
FASTER = {
    "orbit": (15, 20),
    "torque": (20, 22),
    "orbit_compact": (47, 50),
    "rw_panels": (11, 14),
    "orbit_extended": (10, 12),
    "variable_mass": (5.5, 7),
    FLEX[1].name: (7, 15),
    FLEX[2].name: (10, 15),
    FLEX[4].name: (10, 15),
    FLEX[8].name: (10, 15),
    FLEX[16].name: (19, 20),
    FLEX[32].name: (28, 30),
    "bodies, N=4": (6.5, 9),
    "bodies, N=16": (7.5, 9),
}


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


def at_least(what: str, value: float, must: float, aim: float, form: str, note: str = "") -> Claim:
    return Claim(
        what, f"≥ {must:g}", f"≥ {aim:g}", form.format(value) + note, value >= must, value >= aim
    )


def best(race: dict, engine: str) -> float:
    return race["engines"][engine]["best_us_per_step"]


def faster(results: Results, name: str, than: str = "forward") -> float:
    """Times faster than another contestant, best over best."""
    race = results.races[name]
    return best(race, than) / best(race, "bsm")


def exponent(small: float, large: float) -> float:
    """Of growth from 38 to 70 coordinates."""
    return math.log(large / small) / math.log(70 / 38)


def exponent_of_counts(results: Results, engine: str) -> float:
    small, large = (results.counts[name, engine].instructions for name in (SMALL, LARGE))
    return exponent(small, large)


def exponent_of_time(results: Results, engine: str) -> float:
    small, large = (best(results.races[name], engine) for name in (SMALL, LARGE))
    return exponent(small, large)


def wrapper(results: Results, name: str) -> float:
    """Instructions of our MuJoCo engine beyond the bare sub-stages, in percent."""
    ours, bare = (results.counts[name, engine].instructions for engine in ("mujoco", "minimal"))
    return 100.0 * (ours / bare - 1.0)


def recorded_instructions(results: Results, case: Case, engine: str) -> float:
    """Of a recorded run over the bare one."""
    names = (case.recorded().name, case.name)
    recorded, bare = (results.counts[name, engine].instructions for name in names)
    return recorded / bare


def recorded_time(results: Results, case: Case, engine: str) -> float:
    race = results.recorded[case.name]
    return best(race, f"{engine}_recorded") / best(race, engine)


def heap_calls(results: Results) -> float:
    engines = ("portable", "bsm", "mujoco")
    return max(results.counts[case.name, engine].heap_calls for case in ALL for engine in engines)


def set_times(race: dict) -> dict[str, float]:
    """Best time of each instruction set that raced."""
    return {name: best(race, contestant) for name, contestant in race["sets"].items()}


def loss_of_choice(ratios: list[float]) -> float:
    """Geometric mean of chosen over best: single rows are noisier than what is asked."""
    return math.exp(sum(map(math.log, ratios)) / len(ratios))


def loss_of_one(results: Results) -> float:
    races = results.races.values()
    return loss_of_choice([best(race, "bsm") / min(set_times(race).values()) for race in races])


def loss_of_batches(results: Results) -> float:
    rows = results.batches.values()
    return loss_of_choice([max(row.values()) / row[results.batch_set] for row in rows])


def speeds(results: Results) -> list[Claim]:
    return [
        at_least(f"{FORWARD}{name}", faster(results, name), must, aim, "{:.1f}")
        for name, (must, aim) in FASTER.items()
    ]


def growth(results: Results) -> list[Claim]:
    what = "growth exponent, 38 to 70 coordinates, "
    counted, timed = exponent_of_counts(results, "portable"), exponent_of_time(results, "bsm")
    return [
        at_most(f"{what}instructions", counted, 1.2, 1.05, "{:.2f}"),
        at_most(f"{what}time", timed, 1.2, 1.05, "{:.2f}"),
    ]


def recordings(results: Results) -> list[Claim]:
    claims = []
    for case in RECORDED:
        counted = recorded_instructions(results, case, "portable")
        timed = recorded_time(results, case, "bsm")
        what = f"recorded run over bare run, {case.name}, "
        claims.append(at_most(f"{what}instructions", counted, 1.5, 1.2, "{:.2f}"))
        claims.append(at_most(f"{what}time", timed, 1.3, 1.15, "{:.2f}"))
    return claims


def throughput(results: Results) -> Claim:
    """Of a batch of N=16, one core."""
    steps = results.batches[SMALL]
    fastest = max(steps, key=steps.__getitem__)
    what = "million spacecraft-steps a second, one core, batch of flex, N=16"
    return at_least(what, steps[fastest] / 1e6, 1.6, 2.5, "{:.2f}", f" ({fastest})")


def choices(results: Results) -> list[Claim]:
    what = "time with the chosen instruction set over that with the fastest, mean of all rows, "
    return [
        at_most(f"{what}one spacecraft", loss_of_one(results), 1.05, 1.02, "{:.2f}"),
        at_most(f"{what}batches", loss_of_batches(results), 1.05, 1.02, "{:.2f}"),
    ]


def claims(results: Results) -> list[Claim]:
    overhead = max(PAPER, key=lambda name: wrapper(results, name))
    in_heap = heap_calls(results)
    return [
        *speeds(results),
        *growth(results),
        *recordings(results),
        Claim(
            "calls of the heap's functions in a step, either engine",
            "0",
            "0",
            f"{in_heap:g}",
            in_heap == 0,
            in_heap == 0,
        ),
        throughput(results),
        at_most(
            "exact A and B of rw_panels [µs]", results.jacobians["rw_panels"], 10, 6, "{:.1f}"
        ),
        at_most(
            "our MuJoCo engine beyond MuJoCo's bare sub-stages, instructions",
            wrapper(results, overhead),
            2,
            2,
            "{:.1f} %",
            f" ({overhead})",
        ),
        *choices(results),
    ]
