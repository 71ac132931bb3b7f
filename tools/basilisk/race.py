"""What a step costs, in rounds: Basilisk's halves and ours take turns, and the best of each counts."""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
import sys

import numpy as np
from chain import HERE, OURS, Emission, Failed, fly_here

SECONDS = 0.25  # that a timed run of Basilisk takes, about
TRIALS = 11  # of ours in every round


class Racer:
    """The process that has Basilisk."""

    def __init__(self, script: pathlib.Path) -> None:
        command = [sys.executable, "-B", str(HERE / "racer.py"), str(script)]
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )

    def __enter__(self) -> Racer:
        self.process.stdout.readline()  # facts, known by now
        return self

    def __exit__(self, kind, *_) -> None:
        if kind is not None:
            self.process.kill()
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()

    def race(self, contestant: str, steps: int) -> dict:
        self.process.stdin.write(f"{contestant} {steps}\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise Failed(f"Basilisk ended while {contestant} was timed", 1)
        return json.loads(line)


def steps_of(racer: Racer, contestants: list[str], facts: dict) -> dict[str, int]:
    """So many that starting does not show, and none beyond the run's end."""
    whole = max(1, int(facts["duration_s"] / facts["step_s"] + 1e-9))
    found = {}
    for each in contestants:
        one = racer.race(each, min(whole, 100))["seconds"]
        found[each] = max(1, min(whole, int(SECONDS / one)))
    if "special" in found:  # they end alike, if they fly alike
        found["special"] = found["bsm"] = min(found["special"], found["bsm"])
    return found


def same_motion(a: list[float], b: list[float]) -> bool:
    return np.allclose(a, b, rtol=1e-9, atol=1e-9)


def race(emission: Emission, spec: str, settings: list[str], rounds: int, folder: pathlib.Path) -> dict:
    """@return seconds per step, by contestant: best, median and the rounds"""
    contestants = list(emission.facts["halves"])
    if emission.facts["special_effectors"]:
        contestants.append("special")
    times: dict[str, list[float]] = {name: [] for name in (*contestants, "our_bsm", "our_mujoco")}
    ends: dict[str, list[float]] = {}
    with Racer(emission.script) as racer:
        steps = steps_of(racer, contestants, emission.facts)
        for _ in range(rounds):
            for each in contestants:
                found = racer.race(each, steps[each])
                times[each].append(found["seconds"])
                ends[each] = found["end"]
            report = fly_here(spec, settings, TRIALS, folder)
            member = report["members"][0]
            for engine in OURS.values():
                trials = member["timing"][engine]["trials_s"]
                times[f"our_{engine}"].append(min(trials) / member["engines"][engine]["steps"])
    if "special" in ends and not same_motion(ends["special"], ends["bsm"]):
        times.pop("special")  # another vehicle is no contestant
    return {
        "rounds": rounds,
        "load_average": os.getloadavg()[0],
        "instructions": report["provenance"]["instructions"],
        "us_per_step": {
            name: {"best": 1e6 * min(found), "median": 1e6 * float(np.median(found))}
            for name, found in times.items()
        },
        "steps_timed": steps,
    }


def fastest(costs: dict, half: str, facts: dict) -> tuple[float | None, str]:
    """A step of Basilisk's half [us], the BSM with the fastest of its effectors for the hinges, and
    which that is."""
    found = {name: each["best"] for name, each in costs["us_per_step"].items()}
    if half not in found:
        return None, ""
    if half != "bsm" or not facts["hinges"]:
        return found[half], ""
    if found.get("special", found["bsm"]) < found["bsm"]:
        return found["special"], facts["special_effectors"]
    return found["bsm"], "SpinningBodyNDOF"


def ratios(costs: dict, facts: dict) -> dict[str, float]:
    """How many times longer a step of Basilisk's takes."""
    us = {name: each["best"] for name, each in costs["us_per_step"].items()}
    pairs = {
        "bsm_over_our_bsm": ("bsm", "our_bsm"),
        "mjscene_over_our_mujoco": ("mjscene", "our_mujoco"),
        "mjscene_over_our_bsm": ("mjscene", "our_bsm"),
    }
    theirs = {half: fastest(costs, half, facts)[0] for half in facts["halves"]}
    return {name: theirs[a] / us[b] for name, (a, b) in pairs.items() if a in theirs}
