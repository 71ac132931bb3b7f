"""What the tests of the Python package share. They run against the package that PYTHONPATH or the
environment has: tools/check takes the one of the build tree."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import twincraft as tc

ROOT = Path(__file__).resolve().parents[2]
SPEC = ROOT / "models" / "quickstart.yaml"

pytest_plugins = ["pytester"]


@pytest.fixture(autouse=True)
def in_the_root(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)


@pytest.fixture(scope="session")
def m() -> tc.Model:
    return tc.load(SPEC)


@pytest.fixture(params=["bsm", "mujoco"])
def engine(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture(params=["simulation", "twin"])
def flyer(request: pytest.FixtureRequest, m: tc.Model) -> tc.Simulation | tc.Twin:
    return m.simulate() if request.param == "simulation" else m.twin()


def program(name: str) -> str:
    """One of the package's programs."""
    return str(Path(tc.__file__).parent / "bin" / name)


def python(code: str, *arguments: str, **options: object) -> subprocess.CompletedProcess[str]:
    """Another process of this Python with the same package."""
    environment = {**os.environ, "PYTHONPATH": str(Path(tc.__file__).parents[1])}
    return subprocess.run(
        [sys.executable, "-c", code, *arguments],
        capture_output=True, text=True, env=environment, cwd=ROOT, **options,
    )


PUSHED = """
format: spacecraft/1
name: pushed
hub: {mass: 100 kg, inertia: [10, 20, 15]}
wheels:
  - {name: w, axis: [1, 0, 0], spin_inertia: 0.1, transverse_inertia: 0.05, torque: TORQUE}
loads:
  - {name: push, position: [1, 0, 0], force: FORCE}
simulation: {step: 0.1 s, duration: 10 s}
"""


def pushed(torque: str = "0 N m", force: str = "[0, 0, 0]") -> tc.Model:
    """A hub with a wheel and a load."""
    return tc.loads(PUSHED.replace("TORQUE", torque).replace("FORCE", force))
