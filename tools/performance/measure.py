"""Everything that PERFORMANCE.md is made of."""

from __future__ import annotations

import dataclasses

import basilisk
import machine
import programs
from cases import ALL, FLEX, Case
from breakdown import shares

COUNTED = ("portable", "bsm", "mujoco", "forward", "minimal")
FEWER, MORE = 20, 60  # steps, of counted runs


@dataclasses.dataclass
class Results:
    trials: int
    load: tuple[float, float]  # before and after
    races: dict[str, dict]  # by case
    counts: dict[tuple[str, str], programs.Count]  # by case and engine
    shares: list[tuple[str, float]]  # of flex, N=16
    evaluations: dict[str, dict[str, float]]  # [ns] by case and engine
    batches: dict[str, dict[str, float]]  # spacecraft-steps/s by case and instruction set
    lanes: dict[str, int]  # by instruction set
    basilisk: dict[str, dict]  # comparison.json by case


def steps_of(degrees_of_freedom: int) -> int:
    """So many that building the run hardly shows, and so few that a trial often is undisturbed."""
    return max(250, 8_000 // degrees_of_freedom)


def race(case: Case, trials: int) -> dict:
    size = programs.race(case, 1, 1)["degrees_of_freedom"]
    return programs.race(case, steps_of(size), trials)


def best_evaluations() -> dict[str, dict[str, float]]:
    table: dict[str, dict[str, float]] = {}
    for record in programs.benchmarks("^evaluation/", 3):
        _, engine, case = record["name"].split("/")
        row = table.setdefault(case.replace("flex_", "flex, N="), {})
        row[engine] = min(row.get(engine, record["cpu_time"]), record["cpu_time"])
    return table


def best_batches() -> tuple[dict[str, dict[str, float]], dict[str, int]]:
    table: dict[str, dict[str, float]] = {}
    lanes: dict[str, int] = {}
    for record in programs.benchmarks("^batch/", 5):
        _, instructions, case = record["name"].split("/")
        row = table.setdefault(case.replace("flex_", "flex, N="), {})
        row[instructions] = max(row.get(instructions, 0.0), record["spacecraft_steps"])
        lanes[instructions] = int(record["lanes"])
    return table, lanes


def measure(trials: int, rounds: int, tell) -> Results:
    tell("building")
    programs.build("bench_steps", "bench_evaluations")
    before = machine.load()
    races = {}
    for case in ALL:  # timed ones alone
        tell(f"race: {case.name}")
        races[case.name] = race(case, trials)
    tell("single evaluations and batches")
    evaluations = best_evaluations()
    batches, lanes = best_batches()
    beside = basilisk.races(rounds, tell)
    after = machine.load()
    tell("counting instructions")
    counts = programs.counts([(case, engine) for case in ALL for engine in COUNTED], FEWER, MORE)
    split = shares(FLEX[16], "portable", FEWER, MORE)
    return Results(
        trials, (before, after), races, counts, split, evaluations, batches, lanes, beside
    )
