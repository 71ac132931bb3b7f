"""Everything that PERFORMANCE.md is made of."""

from __future__ import annotations

import dataclasses

import basilisk
import history
import machine
import programs
from cases import ALL, FLEX, RECORDED, Case
from breakdown import shares

COUNTED = ("portable", "bsm", "mujoco", "forward", "minimal", "step")
COUNTED_RECORDED = ("portable", "bsm", "mujoco")
FEWER, MORE = 20, 60  # steps, of counted runs


@dataclasses.dataclass
class Results:
    trials: int
    load: tuple[float, float]  # before and after
    races: dict[str, dict]  # by case
    recorded: dict[str, dict]  # races of bare and recorded runs, by case
    counts: dict[tuple[str, str], programs.Count]  # by case and engine
    shares: list[tuple[str, float]]  # of flex, N=16
    evaluations: dict[str, dict[str, float]]  # [ns] by case and engine
    jacobians: dict[str, float]  # [us] exact A and B, by case
    batches: dict[str, dict[str, float]]  # spacecraft-steps/s by case and instruction set
    lanes: dict[str, int]  # by instruction set
    batch_set: str  # the instruction set that a batch chooses
    history: list[dict]  # steps of the work; see history.py
    basilisk: dict[str, dict]  # comparison.json by case


def steps_of(degrees_of_freedom: int) -> int:
    """So many that building the run hardly shows, and so few that a trial often is undisturbed."""
    return max(250, 8_000 // degrees_of_freedom)


def race(case: Case, trials: int) -> dict:
    """Of a recorded case: bare and recorded runs."""
    size = programs.race(case, 1, 1)["degrees_of_freedom"]
    return programs.race(case, steps_of(size), trials)


def row_name(case: str) -> str:
    """Of a case of bench_evaluations."""
    return case.replace("flex_", "flex, N=")


def best_evaluations() -> dict[str, dict[str, float]]:
    table: dict[str, dict[str, float]] = {}
    for record in programs.benchmarks("^evaluation/", 3):
        _, engine, case = record["name"].split("/")
        row = table.setdefault(row_name(case), {})
        row[engine] = min(row.get(engine, record["cpu_time"]), record["cpu_time"])
    return table


def best_jacobians() -> dict[str, float]:
    table: dict[str, float] = {}
    for record in programs.benchmarks("^jacobian/", 3):
        name, time = row_name(record["name"].split("/")[1]), 1.0e-3 * record["cpu_time"]
        table[name] = min(table.get(name, time), time)
    return table


def best_batches() -> tuple[dict[str, dict[str, float]], dict[str, int], str]:
    """Rows, lanes by instruction set, and the set that a batch chooses."""
    table: dict[str, dict[str, float]] = {}
    lanes: dict[str, int] = {}
    chosen = ""
    for record in programs.benchmarks("^batch/", 5):
        _, instructions, case = record["name"].split("/")
        row = table.setdefault(row_name(case), {})
        row[instructions] = max(row.get(instructions, 0.0), record["spacecraft_steps"])
        lanes[instructions] = int(record["lanes"])
        chosen = instructions if record["is_chosen"] else chosen
    return table, lanes, chosen


def measure(trials: int, rounds: int, tell) -> Results:
    tell("building")
    programs.build("bench_steps", "bench_evaluations")
    before = machine.load()
    races = {}
    for case in ALL:  # timed ones alone
        tell(f"race: {case.name}")
        races[case.name] = race(case, trials)
    recorded = {}
    for case in RECORDED:
        tell(f"race: {case.name}, bare and recorded")
        recorded[case.name] = race(case.recorded(), trials)
    tell("single evaluations, Jacobians and batches")
    evaluations, jacobians = best_evaluations(), best_jacobians()
    batches, lanes, batch_set = best_batches()
    beside = basilisk.races(rounds, tell)
    after = machine.load()
    tell("counting instructions")
    jobs = [(case, engine) for case in ALL for engine in COUNTED]
    jobs += [(case.recorded(), engine) for case in RECORDED for engine in COUNTED_RECORDED]
    counts = programs.counts(jobs, FEWER, MORE)
    split = shares(FLEX[16], "portable", FEWER, MORE)
    return Results(
        trials=trials,
        load=(before, after),
        races=races,
        recorded=recorded,
        counts=counts,
        shares=split,
        evaluations=evaluations,
        jacobians=jacobians,
        batches=batches,
        lanes=lanes,
        batch_set=batch_set,
        history=history.steps(),
        basilisk=beside,
    )
