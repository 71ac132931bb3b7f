"""Runs of scsim, each a folder with report.json and the trajectories of both engines."""

from __future__ import annotations

import csv
import json
import math
import pathlib
import subprocess
import sys
import time
from dataclasses import dataclass
from functools import lru_cache

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODELS = ROOT / "models" / "paper"
SCSIM = ROOT / "build" / "release" / "bin" / "scsim"  # built once, by tools/scsim
ENGINES = ("bsm", "mujoco")


class RunFailed(Exception):
    """scsim gave no complete report; the text says of which run and why."""


@dataclass(frozen=True)
class Trajectory:
    """Columns of a trajectory file by their names without units."""

    columns: dict[str, list[float]]

    @property
    def times(self) -> list[float]:
        return self.columns["t"]

    def vector(self, name: str, axes: str = "xyz") -> list[tuple[float, ...]]:
        return list(zip(*(self.columns[f"{name}.{axis}"] for axis in axes)))

    @property
    def attitudes(self) -> list[tuple[float, ...]]:
        return self.vector("q_BN", "wxyz")


@dataclass(frozen=True)
class Report:
    folder: pathlib.Path
    json: dict

    @property
    def members(self) -> list[dict]:
        return self.json["members"]

    def trajectory(self, engine: str, member: int = 0) -> Trajectory:
        folder = self.folder if member == 0 else self.folder / f"{member:04}"
        return read_trajectory(folder / f"{engine}.csv")

    def agreement(self, metric: str, member: int = 0) -> float:
        return self.members[member]["agreement"][metric]["max"]

    def reference(self, name: str, engine: str, metric: str, member: int = 0) -> float:
        return self.members[member]["references"][name][engine][metric]["max"]

    def against(self, engine: str, metric: str, member: int) -> float:
        return self.members[member]["against"][engine][metric]["max"]

    def trend(self, kind: str, **wanted: str) -> dict:
        """The one trend of `kind` (convergence, scaling, slopes) with these entries."""
        for trend in self.json["studies"][kind]:
            if all(trend.get(key) == value for key, value in wanted.items()):
                return trend
        raise RunFailed(f"{self.folder.name}: no {kind} of {wanted} in report.json")


@lru_cache(maxsize=8)
def read_trajectory(path: pathlib.Path) -> Trajectory:
    with path.open(newline="") as file:
        rows = csv.reader(file)
        names = [head.split(" [")[0] for head in next(rows)]
        columns = zip(*([float(cell) for cell in row] for row in rows))
        return Trajectory({name: list(column) for name, column in zip(names, columns)})


def principal_angle(a: tuple[float, ...], b: tuple[float, ...]) -> float:
    """Angle [deg] of the rotation between two attitudes, as scsim's attitude metric has it."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    vector = (
        aw * bx - bw * ax - (ay * bz - az * by),
        aw * by - bw * ay - (az * bx - ax * bz),
        aw * bz - bw * az - (ax * by - ay * bx),
    )
    scalar = aw * bw + ax * bx + ay * by + az * bz
    return math.degrees(2 * math.atan2(math.hypot(*vector), abs(scalar)))


def attitude_history(a: Trajectory, b: Trajectory) -> list[tuple[float, float]]:
    """(time [s], attitude difference [deg]) at every common sample."""
    if a.times != b.times:
        raise RunFailed("two runs were not sampled at the same times")
    return [(t, principal_angle(p, q)) for t, p, q in zip(a.times, a.attitudes, b.attitudes)]


def distance_history(a: Trajectory, b: Trajectory, point: str) -> list[tuple[float, float]]:
    pairs = zip(a.times, a.vector(point), b.vector(point))
    return [(t, math.dist(p, q)) for t, p, q in pairs]


class Runner:
    def __init__(self, folder: pathlib.Path, quick: bool) -> None:
        self.folder = folder
        self.quick = quick
        self.provenance: dict = {}
        self.scenario = ""
        self.done: dict[str, Report] = {}  # by name: sections may share a run

    def run(self, spec: str, name: str = "", sets: tuple[str, ...] = (), trials: int = 0) -> Report:
        """Run models/paper/SPEC.yaml, once for each name; `trials` 0 is untimed."""
        return self._scsim(["--trials", str(trials)], spec, name or spec.split("/")[-1], sets)

    def attribute(self, spec: str, name: str, sets: tuple[str, ...] = ()) -> Report:
        """Why the engines differ on models/paper/SPEC.yaml; that they do is no failure here."""
        return self._scsim(["attribute"], spec, name, sets)

    def _scsim(self, words: list[str], spec: str, name: str, sets: tuple[str, ...]) -> Report:
        if name in self.done:
            return self.done[name]
        folder = self.folder / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "report.json").unlink(missing_ok=True)
        command = [str(SCSIM), *words, str(MODELS / f"{spec}.yaml"), "-o", str(folder), "--quiet"]
        for change in sets:
            command += ["--set", change]
        print(f"  {self.scenario}: {name} ", end="", file=sys.stderr, flush=True)
        begin = time.monotonic()
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        print(f"{time.monotonic() - begin:.1f} s", file=sys.stderr, flush=True)
        self.done[name] = self._report(folder, done)
        return self.done[name]

    def _report(self, folder: pathlib.Path, done: subprocess.CompletedProcess) -> Report:
        try:
            report = Report(folder, json.loads((folder / "report.json").read_text()))
        except (OSError, ValueError):
            raise RunFailed(f"{folder.name}: {done.stderr.strip() or 'no report'}") from None
        if done.returncode not in (0, 1) or not report.json["complete"]:
            raise RunFailed(f"{folder.name}: exit code {done.returncode}: {done.stderr.strip()}")
        if report.json["verdict"] == "disagree" and "attribution" not in report.json:
            raise RunFailed(f"{folder.name}: the engines disagree beyond the model's tolerances")
        self.provenance = self.provenance or report.json["provenance"]
        return report
