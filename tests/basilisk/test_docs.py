"""The example of docs/basilisk.md runs: Basilisk's own flight software points a vehicle of ours."""

from __future__ import annotations

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCCOMPILE = ROOT / "build" / "release" / "bin" / "sccompile"

# SimulationBaseClass imports what draws and colours, which the lean installation lacks and no test uses.
PRELUDE = """
import sys
from unittest.mock import MagicMock
for name in ("matplotlib", "matplotlib.pyplot", "matplotlib.patches", "colorama", "tqdm"):
    sys.modules.setdefault(name, MagicMock())
"""


def test_the_example_points_the_vehicle(tmp_path):
    models = tmp_path / "models"
    spec = str(ROOT / "models" / "quickstart.yaml")
    subprocess.run([SCCOMPILE, spec, "--emit", "basilisk", "-o", models], check=True)
    page = (ROOT / "docs" / "basilisk.md").read_text()
    (code,) = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    done = subprocess.run(
        [sys.executable, "-B", "-c", PRELUDE + code], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    seen = [float(number) for number in re.findall(r"-?\d+\.\d*(?:e[-+]?\d+)?", done.stdout)]
    assert len(seen) == 6
    assert max(map(abs, seen[:3])) < 1e-3, "it does not point"
    assert max(map(abs, seen[3:])) < 1e-4, "it turns on"
