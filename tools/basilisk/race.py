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


class Racer:
    """The process that has Basilisk."""

    def __init__(self, script: pathlib.Path, steps: int) -> None:
        command = [sys.executable, "-B", str(HERE / "racer.py"), str(script), str(steps)]
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )
        self.process.stdout.readline()

    def __enter__(self) -> Racer:
        return self

    def __exit__(self, *_) -> None:
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()

    def race(self, half: str) -> dict:
        self.process.stdin.write(half + "\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise Failed(f"Basilisk ended while {half} was timed", 1)
        return json.loads(line)


def steps_of(emission: Emission, half: str) -> int:
    """So many that starting does not show, and none beyond the run's end."""
    whole = max(1, int(emission.facts["duration_s"] / emission.facts["step_s"] + 1e-9))
    with Racer(emission.script, min(whole, 200)) as racer:
        one = racer.race(half)["seconds"]
    return max(1, min(whole, int(SECONDS / one)))


def same_motion(a: list[float], b: list[float]) -> bool:
    return np.allclose(a, b, rtol=1e-9, atol=1e-9)


def race(emission: Emission, spec: str, settings: list[str], rounds: int, folder: pathlib.Path) -> dict:
    """@return seconds per step, by contestant: best, median and the rounds"""
    contestants = list(emission.facts["halves"])
    if emission.facts["special_effectors"]:
        contestants.append("special")
    steps = {half: steps_of(emission, half) for half in contestants}
    if "special" in steps:
        steps["special"] = steps["bsm"] = min(steps["special"], steps["bsm"])
    racers = {half: Racer(emission.script, steps[half]) for half in contestants}
    times: dict[str, list[float]] = {name: [] for name in (*contestants, "our_bsm", "our_mujoco")}
    ends: dict[str, list[float]] = {}
    try:
        for _ in range(rounds):
            for half in contestants:
                found = racers[half].race(half)
                times[half].append(found["seconds"])
                ends[half] = found["end"]
            report = fly_here(spec, settings, 3, folder)
            member = report["members"][0]
            for engine in OURS.values():
                trials = member["timing"][engine]["trials_s"]
                times[f"our_{engine}"].append(min(trials) / member["engines"][engine]["steps"])
    finally:
        for racer in racers.values():
            racer.__exit__()
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
