"""The script of a spec, and the vehicle flown by it and by us."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import comparison

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = ROOT / "build" / "release" / "bin"
HALVES = {"bsm": "Basilisk's BSM", "mjscene": "Basilisk's MJScene"}
OURS = {"bsm": "bsm", "mjscene": "mujoco"}
# Of adaptive methods, in all flights: near rounding, and above what the distance of an orbit rounds to.
TOLERANCE = 1e-12
# Of methods where a pendulum is counted about other axes: their own error at our steps.
TURNED = 1e-10


def run(*command: object, codes: tuple[int, ...] = (0,), **more) -> subprocess.CompletedProcess:
    """A command that exits with one of `codes`."""
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, **more)
    said = f"{command} exits with {done.returncode}\n{done.stdout}{done.stderr}"
    assert done.returncode in codes, said
    return done


def fly_script(script: Path, *arguments: object, **more) -> subprocess.CompletedProcess:
    return run(sys.executable, "-B", script, *arguments, **more)


def sets(settings: tuple[str, ...]) -> list[str]:
    return [word for setting in settings for word in ("--set", setting)]


@dataclass
class Emitted:
    """What sccompile made of a spec."""

    said: list[dict]  # diagnostics
    script: Path | None  # None: both halves are refused

    def about(self, half: str, code: str) -> list[dict]:
        return [each for each in self.said if each["code"] == code and HALVES[half] in each["message"]]

    def reasons(self, half: str) -> list[str]:
        """Why a half is refused; empty: it is not."""
        return [each["message"].split(": ", 1)[1] for each in self.about(half, "SC4004")]

    def halves(self) -> list[str]:
        return [half for half in HALVES if not self.reasons(half)]


def emit(spec: Path, folder: Path, *settings: str) -> Emitted:
    command = [PROGRAMS / "sccompile", spec, "--emit", "basilisk", "-o", folder, "--diagnostics", "json"]
    done = run(*command, *sets(settings), codes=(0, 1))
    said = json.loads(done.stdout)["diagnostics"]
    assert not [each for each in said if each["severity"] == "error"], done.stdout
    scripts = [*folder.glob("*")]
    assert len(scripts) == (done.returncode == 0), done.stderr
    return Emitted(said, scripts[0] if scripts else None)


def lint(*scripts: Path) -> str:
    """What flake8 says. Its `noqa` for one code of a file is one for the whole file in some versions, so
    none counts here but that for long lines, which data have."""
    command = [sys.executable, "-B", "-m", "flake8", "--disable-noqa", "--extend-ignore", "E501", *scripts]
    return run(*command, codes=(0, 1)).stdout


@dataclass
class Flight:
    """A vehicle in every half that it has."""

    emitted: Emitted
    worst: dict[str, dict[str, float]] = field(default_factory=dict)  # by half, by kind of column
    faults: dict[str, dict[str, str]] = field(default_factory=dict)


def fly_theirs(spec: Path, folder: Path, *settings: str) -> Emitted:
    emitted = emit(spec, folder, *settings)
    if emitted.script:
        fly_script(emitted.script, "-o", folder, cwd=folder)
    return emitted


def fly_ours(spec: Path, folder: Path, emitted: Emitted, *settings: str) -> None:
    """With what Basilisk has otherwise than the spec: of a campaign the vehicle that it draws around."""
    as_theirs = ["engines.bsm.attitude=mrp", "engines.mujoco.frame=inertial", "simulation.resolution=report"]
    if any("`system_com`" in each["message"] for each in emitted.about("bsm", "SC4005")):
        as_theirs.append("engines.bsm.gravity=system_com")
    if re.search("^campaign:", spec.read_text(), re.MULTILINE):
        as_theirs.append("campaign=null")
    run(PROGRAMS / "scsim", spec, "--no-timing", "--quiet", "-o", folder, *sets((*settings, *as_theirs)), codes=(0, 1))


def compare(emitted: Emitted, theirs: Path, ours: Path) -> Flight:
    flight = Flight(emitted)
    is_adaptive = "svIntegratorRKF" in emitted.script.read_text()
    for half in emitted.halves():
        mine = comparison.read(ours / f"{OURS[half]}.csv")
        turned = comparison.turned_pendulums(mine) if half == "bsm" else []
        pair = comparison.read(theirs / f"basilisk_{half}.csv"), mine
        flight.worst[half] = comparison.differences(*(comparison.without(each, turned) for each in pair))
        tolerance = TURNED if turned else TOLERANCE if is_adaptive else 0
        limits = comparison.allowed(half, comparison.distance(mine), tolerance)
        if excess := comparison.excess(flight.worst[half], limits):
            flight.faults[half] = excess
    return flight


def fly(spec: Path, folder: Path, *settings: str) -> Flight:
    """Emit the script and run it, fly ours, and compare."""
    settings = (*settings, f"simulation.tolerance={TOLERANCE}")
    emitted = fly_theirs(spec, folder / "theirs", *settings)
    if not emitted.script:
        return Flight(emitted)
    fly_ours(spec, folder / "ours", emitted, *settings)
    return compare(emitted, folder / "theirs", folder / "ours")


class Tally:
    """Of many flights: the worst differences, and what was refused how often."""

    def __init__(self):
        self.worst: dict[tuple[str, str], tuple[float, str]] = {}
        self.refused: Counter[tuple[str, str]] = Counter()
        self.flown: Counter[str] = Counter()
        self.vehicles = 0

    def add(self, name: str, flight: Flight) -> None:
        self.vehicles += 1
        self.flown.update(list(flight.worst))
        for half, worst in flight.worst.items():
            for kind, value in worst.items():
                self.worst[half, kind] = max((value, name), self.worst.get((half, kind), (0.0, "")))
        for half in HALVES:
            reasons = {re.sub(r"`[^`]+`((,| and) `[^`]+`)*", "`..`", why) for why in flight.emitted.reasons(half)}
            self.refused.update((half, why) for why in reasons)

    def lines(self) -> list[str]:
        lines = [f"{self.vehicles} vehicles; " + ", ".join(f"{n} in {half}" for half, n in sorted(self.flown.items()))]
        lines += [f"  {half:<9}{kind:<20}{value:8.1e}   {name}"
                  for (half, kind), (value, name) in sorted(self.worst.items())]
        lines += [f"  {half} refused {count:4}: {why}" for (half, why), count in self.refused.most_common()]
        return lines
