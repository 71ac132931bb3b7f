"""task.py SCRIPT ENGINE: fly a script's vehicle by the script's own loop, and twice in a task of SimulationBaseClass.

A process of its own, for a fault in there ends the interpreter. SimulationBaseClass is Basilisk's own; what it
imports beside, for plots and progress bars, stands empty here."""

from __future__ import annotations

import importlib.util
import sys
from unittest.mock import MagicMock

import numpy as np

for name in ("colorama", "matplotlib", "matplotlib.patches", "matplotlib.pyplot", "tqdm"):
    sys.modules[name] = MagicMock()
from Basilisk.utilities import SimulationBaseClass  # noqa: E402


def main(file: str, engine: str) -> None:
    spec = importlib.util.spec_from_file_location("script", file)
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    _, *rows = script.Vehicle(engine).fly(script.STEP, script.DURATION)

    sim = SimulationBaseClass.SimBaseClass()
    process = sim.CreateNewProcess("process")
    process.addTask(sim.CreateNewTask("task", round(1e9 * script.STEP)))
    vehicle = script.build(sim, "task", engine)
    for _ in range(2):
        sim.InitializeSimulation()
        sim.ConfigureStopTime(round(1e9 * script.DURATION))
        sim.ExecuteSimulation()
        end = vehicle.row(script.DURATION)
        assert np.array_equal(end, rows[-1]), np.max(np.abs(end - rows[-1]))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
