"""A user's script under mypy --strict."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import twincraft as tc

GOOD = '''
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, assert_type
import numpy as np
from numpy.typing import NDArray
import twincraft as tc

m = tc.load(Path("models/quickstart.yaml"), set={"simulation.step": 0.01, "hub.inertia": [1, 2, 3]})
run = m.run(engine="both", timing=False)
assert_type(run.report, dict[str, Any])
if run.bsm is not None:
    assert_type(run.bsm["q_BN"], NDArray[np.float64])
    print(run.bsm.units["t"], run.bsm.t)
sim = m.simulate(engine="mujoco")
assert_type(sim, tc.Simulation)
sim.inputs["rw_x.torque"] = "10 mN m"
sim.inputs["push.force"] = (1.0, 2.0, 3.0)


def controller(t: float, y: dict[str, Any]) -> dict[str, float]:
    return {"rw_x.torque": 2.0 * float(y["omega_BN_B"][0])}


t: float = sim.run_until(1.0, every=0.1, controller=controller, stop=lambda t, y: False)
assert_type(sim.state, NDArray[np.float64])
assert_type(sim.snapshot(), bytes)
assert_type(sim.copy(), tc.Simulation)
twin = m.twin(lead="each")
twin.run_until(1.0, controller={"bsm": controller, "mujoco": controller})
print(twin.bsm.time, twin.disagreement["attitude_deg"]["max"])
with ProcessPoolExecutor(2) as pool:
    c = m.campaign(pool, tasks=4, folder=Path("out"))
assert_type(c, tc.Campaign)
assert_type(m.campaign(jobs=2, engine="both", isa="avx2")["peak"], NDArray[np.float64])
assert_type(c.worst(3, by="peak"), list[int])
assert_type(c.member(3), tc.Model)
print(c.units["peak"], c.report["campaign"], len(c), c.verdicts[0].upper(), c.members + 1)
batch = tc.Batch(m, n=8, threads=None)
batch.u = None
batch.x = batch.x * 2.0
assert_type(batch.y, NDArray[np.float64])
try:
    tc.loads("x")
except tc.SpecError as error:
    print(error.diagnostics[0].line + 1)
except tc.NumericalError as failure:
    print(failure.time + 1.0, failure.coordinate.upper())
print(m.mass_properties().inertia @ np.ones(3), bool(m.prove()), tc.__version__)
'''

WRONG = '''
import twincraft as tc

m = tc.load("models/quickstart.yaml")
m.simulate(engine="ode")
sim = m.simulate()
sim.step("1")
sim.time = 3.0
sim.run_until(1.0, controller=3)
m.nothing
m.campaign(engine="mujoco")
m.campaign(3)
'''


def mypy(code: str, folder: Path) -> subprocess.CompletedProcess[str]:
    script = folder / "script.py"
    script.write_text(code)
    package = Path(tc.__file__).parents[1]
    environment = {**os.environ}
    if "site-packages" not in package.parts:
        environment["MYPYPATH"] = str(package)
    return subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--config-file=", "--cache-dir",
         str(folder / "cache"), str(script)],
        capture_output=True, text=True, cwd=folder, env=environment)


def test_a_users_script_is_typed(tmp_path):
    pytest.importorskip("mypy")
    done = mypy(GOOD, tmp_path)
    assert done.returncode == 0, done.stdout


def test_wrong_arguments_are_found(tmp_path):
    pytest.importorskip("mypy")
    done = mypy(WRONG, tmp_path)
    lines = [line.split(":")[1] for line in done.stdout.splitlines() if ": error:" in line]
    assert lines == ["5", "7", "8", "9", "10", "11", "12"], done.stdout
