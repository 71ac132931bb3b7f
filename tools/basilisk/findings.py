"""What was found: the agreement of four trajectories, and JSON of everything."""

from __future__ import annotations

import dataclasses
import pathlib

import numpy as np
from chain import HALVES, OURS, TITLES, Emission
from differences import Metric, Trajectory, bounds, differences, read, turned_pendulums
from race import fastest, ratios


@dataclasses.dataclass
class Comparison:
    """Of two trajectories; without bounds it is not judged."""

    title: str
    times: np.ndarray
    history: dict[Metric, np.ndarray]
    bounds: dict[Metric, float]
    alone: int = 0  # samples of either that the other has not

    def largest(self, metric: Metric) -> float:
        return float(np.max(self.history[metric]))

    def time_of_largest(self, metric: Metric) -> float:
        return float(self.times[np.argmax(self.history[metric])])

    def holds(self, metric: Metric) -> bool | None:
        bound = self.bounds.get(metric)
        return None if bound is None else bool(self.largest(metric) <= bound)  # NaN does not

    @property
    def agrees(self) -> bool | None:
        verdicts = [self.holds(metric) for metric in self.history]
        judged = [verdict for verdict in verdicts if verdict is not None]
        return all(judged) if judged else None


@dataclasses.dataclass
class Findings:
    name: str
    emission: Emission
    report: dict  # of scsim
    pairs: dict[str, Comparison]  # by half: Basilisk's against ours of that formulation
    others: dict[str, Comparison]  # our MuJoCo and MJScene against our BSM
    notes: list[str]
    costs: dict | None = None

    @property
    def agrees(self) -> bool | None:
        verdicts = [pair.agrees for pair in self.pairs.values()]
        return all(v for v in verdicts if v is not None) if set(verdicts) - {None} else None

    @property
    def verdict(self) -> str:
        return {True: "agree", False: "disagree", None: "not_judged"}[self.agrees]


def compared(title: str, a: Trajectory, b: Trajectory, limits: dict, without: set[str]) -> Comparison:
    times, history = differences(a, b, without)
    return Comparison(title, times, history, limits, len(a.times) + len(b.times) - 2 * len(times))


def find(emission: Emission, report: dict, folder: pathlib.Path) -> Findings:
    ours = {half: read(folder / f"{OURS[half]}.csv") for half in HALVES}
    theirs = {half: read(folder / f"basilisk_{half}.csv") for half in emission.facts["halves"]}
    turned = turned_pendulums(ours["bsm"])
    pairs = {}
    for half, trajectory in theirs.items():
        limits = bounds(half, ours[half], emission.facts)
        without = turned if half == "bsm" else set()
        pairs[half] = compared(TITLES[half], ours[half], trajectory, limits, without)
    others = {"our_mujoco": compared("our MuJoCo", ours["bsm"], ours["mjscene"], {}, set())}
    if "mjscene" in theirs:
        others["mjscene"] = compared("MJScene", ours["bsm"], theirs["mjscene"], {}, set())
    found = Findings(report["spec"]["name"], emission, report, pairs, others, [])
    found.notes = notes_of(found, turned)
    return found


def notes_of(found: Findings, turned: set[str]) -> list[str]:
    facts, notes = found.emission.facts, []
    if found.emission.ours:
        notes.append("ours was set to Basilisk's formulation: " + ", ".join(found.emission.ours))
    if turned:
        notes.append(
            f"{', '.join(sorted(turned))} passes 45 deg, where Basilisk's BSM gives it other axes: its "
            "angles are not compared there, and the rest is judged loosely"
        )
    if facts["adaptive"]:
        notes.append("an adaptive method: step sequences differ, so nothing is judged or timed")
    if facts["drains"]:
        notes.append("v_CN_N is another quantity in Basilisk on a vehicle that drains")
    alone = max((pair.alone for pair in found.pairs.values()), default=0)
    if alone:
        notes.append(f"{alone} samples have no counterpart at their time and are not compared")
    if found.report["verdict"] not in ("agree", "not_judged"):
        notes.append(f"our own verdict on this run is `{found.report['verdict']}`")
    return notes + [text for text in found.emission.remarks if not text.startswith("not in ")]


def metric_json(comparison: Comparison) -> dict:
    return {
        metric.key: {
            "max": comparison.largest(metric) if np.isfinite(comparison.largest(metric)) else None,
            "at_s": comparison.time_of_largest(metric),
            "tolerance": comparison.bounds.get(metric),
            "pass": comparison.holds(metric),
        }
        for metric in comparison.history
    }


def to_json(found: Findings) -> dict:
    facts = found.emission.facts
    data = {
        "format": "twincraft-basilisk/1",
        "verdict": found.verdict,
        "spec": found.report["spec"],
        "provenance": found.report["provenance"],
        "basilisk": {"version": facts["basilisk"], "mujoco": facts["mujoco"]},
        "step_s": facts["step_s"],
        "duration_s": facts["duration_s"],
        "integrator": facts["integrator"],
        "settings": found.emission.ours,
        "effectors": facts["effectors"],
        "refused": facts["refused"],
        "notes": found.notes,
        "agreement": {half: metric_json(pair) for half, pair in found.pairs.items()},
        "against_our_bsm": {name: metric_json(each) for name, each in found.others.items()},
    }
    if found.costs:
        us, effector = fastest(found.costs, "bsm", facts)
        data["cost"] = found.costs | {
            "ratios": ratios(found.costs, facts),
            "bsm_fastest_us_per_step": us,
            "bsm_hinges": effector,
        }
    return data
