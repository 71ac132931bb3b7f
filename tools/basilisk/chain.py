"""Emit, fly there, fly here. Every program writes into a folder of the run."""

from __future__ import annotations

import contextlib
import dataclasses
import json
import math
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOLS = ROOT / "tools"
HERE = pathlib.Path(__file__).resolve().parent
HALVES = ("bsm", "mjscene")
OURS = {"bsm": "bsm", "mjscene": "mujoco"}  # our engine of the same formulation
TITLES = {"bsm": "BSM", "mjscene": "MuJoCo"}


class Failed(Exception):
    """A program said no; its text has been shown or is in the exception."""

    def __init__(self, text: str, code: int) -> None:
        super().__init__(text)
        self.code = code


@dataclasses.dataclass
class Emission:
    script: pathlib.Path
    facts: dict
    remarks: list[str]  # of the compiler: what the script does otherwise than the spec
    ours: list[str]  # settings that give our engines Basilisk's formulation


def program(name: str) -> str:
    """Built once; a failure to build has said why."""
    done = subprocess.run([TOOLS / name, "--version"], stdout=subprocess.DEVNULL)
    if done.returncode != 0:
        raise Failed(f"{name} could not be built", 125)
    return str(ROOT / "build" / "release" / "bin" / name)


def changes(settings: list[str]) -> list[str]:
    return [word for setting in settings for word in ("--set", setting)]


def sccompile(spec: str, settings: list[str], folder: pathlib.Path) -> tuple[pathlib.Path, list[str]]:
    """@return the script, and what the compiler remarked on it"""
    command = [program("sccompile"), spec, "--emit", "basilisk,resolved", "-o", str(folder)]
    command += changes(settings)
    done = subprocess.run(
        [*command, "--diagnostics", "json"], stdin=subprocess.DEVNULL, capture_output=True, text=True
    )
    if done.returncode != 0:
        subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)  # as text
        raise Failed(f"`{spec}` has no script for Basilisk", done.returncode)
    (script,) = folder.glob("*.basilisk.py")
    (resolved,) = folder.glob("*.resolved.yaml")
    if re.search("^study:", resolved.read_text(), re.MULTILINE):
        raise Failed(f"`{spec}` is a study, which is many runs; name a spec without", 1)
    if re.search("^campaign:", resolved.read_text(), re.MULTILINE):
        nominal = "`--set campaign=null` flies the vehicle that it draws around"
        raise Failed(f"`{spec}` is a campaign, which is many runs; {nominal}", 1)
    return script, remarks_of(done.stdout)


def remarks_of(text: str) -> list[str]:
    with contextlib.suppress(ValueError):
        found = json.loads(text)
        entries = found["diagnostics"] if isinstance(found, dict) else found
        return [entry["message"] for entry in entries if entry["code"] in ("SC4004", "SC4005")]
    return []


def facts_of(script: pathlib.Path) -> dict:
    command = [sys.executable, "-B", str(HERE / "racer.py"), str(script)]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failed(f"Basilisk does not load the script: {done.stderr.strip()[-2000:]}", 125)
    return json.loads(done.stdout)


def nanoseconds(seconds: float) -> float:
    """Whole ones, as Basilisk has them; never fewer, as a run may have to reach a stored state."""
    return math.ceil(1e9 * seconds - 1e-6) / 1e9


def as_in_basilisk(emission: Emission, settings: list[str]) -> list[str]:
    """Settings of our engines, unless the caller chose."""
    found = []
    if not emission.facts["is_point"]:
        found.append("engines.bsm.attitude=mrp")
    if any("`system_com`" in remark for remark in emission.remarks):
        found.append("engines.bsm.gravity=system_com")
    found.append("engines.mujoco.frame=inertial")
    chosen = {setting.split("=")[0] for setting in settings}
    return [setting for setting in found if setting.split("=")[0] not in chosen]


def emit(spec: str, settings: list[str], folder: pathlib.Path) -> Emission:
    script, remarks = sccompile(spec, settings, folder)
    facts = facts_of(script)
    extra = []
    for key in ("step", "duration"):
        whole = nanoseconds(facts[f"{key}_s"])
        if whole != facts[f"{key}_s"]:
            extra.append(f"simulation.{key}={whole!r}")
    if extra:
        script, remarks = sccompile(spec, [*settings, *extra], folder)
        facts = facts_of(script)
    emission = Emission(script, facts, remarks, [])
    emission.ours = extra + as_in_basilisk(emission, settings)
    return emission


def fly_there(emission: Emission, folder: pathlib.Path) -> None:
    for half in emission.facts["halves"]:
        command = [sys.executable, "-B", str(emission.script), "--engine", half, "-o", str(folder)]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if done.returncode != 0:
            text = done.stderr.strip()[-2000:] or f"signal {-done.returncode}"
            raise Failed(f"Basilisk did not fly it ({half}): {text}", 1)


def fly_here(spec: str, settings: list[str], trials: int, folder: pathlib.Path) -> dict:
    """@return report.json, of a run that both engines ended; its verdict is another matter"""
    command = [program("scsim"), spec, "-o", str(folder), "--quiet", "--trials", str(trials)]
    done = subprocess.run(
        [*command, *changes(settings)], stdin=subprocess.DEVNULL, capture_output=True, text=True
    )
    try:
        report = json.loads((folder / "report.json").read_text())
    except (OSError, ValueError):
        raise Failed(done.stderr.strip() or "scsim gave no report", done.returncode or 1) from None
    if not report["complete"]:
        raise Failed(done.stderr.strip() or "an engine of ours stopped", done.returncode or 1)
    return report
