"""What a script says of itself, and what a step of it costs: a process of its own, as Basilisk can end
one. The first line out is a JSON object of facts; then, for each line in (a half of `races`), one
number out: seconds per step. Nothing is recorded, and no Python runs within a step.

    racer.py SCRIPT STEPS
"""

from __future__ import annotations

import importlib.util
import json
import pathlib
import re
import sys
import time

import Basilisk
import effectors
from Basilisk.architecture import sim_model, sys_model_task



class Race:
    """A vehicle as the only thing in a task, set to its initial state."""

    def __init__(self, vehicle, step: float) -> None:
        self.vehicle, self.step = vehicle, round(1e9 * step)
        self.sim, self.process = sim_model.SimModel(), sim_model.SysProcess("process")
        self.task = sys_model_task.SysModelTask(self.step, 0)
        self.task.TaskName = "task"
        self.sim.addNewProcess(self.process)
        self.process.addNewTask(self.task, -1)
        self.task.AddNewObject(vehicle.body, -1)
        modules = [*vehicle.modules, vehicle]
        for module in modules:
            module.SelfInit()
        self.sim.assignRemainingProcs()
        self.sim.ResetSimulation()
        for module in modules:
            module.Reset(0)
        vehicle.UpdateState(0)
        self.sim.StepUntilStop(0, -1)

    def seconds(self, steps: int) -> float:
        """Processor time of all steps. The run is broken where inputs change, and they are set outside
        the time. Steps run on a thread of the simulation's own, which waits for nobody."""
        total, end, now = 0.0, steps * self.step, 0
        changes = [-(-round(1e9 * at) // self.step) * self.step for at, _ in self.vehicle.coming]
        for stop in sorted({tick for tick in changes if tick < end} | {end}):
            begin = time.process_time()
            self.sim.StepUntilStop(stop, -1)
            total += time.process_time() - begin
            now = stop
            if now < end:
                self.vehicle.UpdateState(now)
        return total


def end_of(vehicle) -> list[float]:
    """Place, attitude (whose sign is open) and rate at the end of a race."""
    row = vehicle.row(0.0)
    return [*row[1:4], *(abs(x) for x in row[7:11]), *row[11:14]]


def effectors_of(module: dict) -> list[str]:
    """Basilisk's names of what the script's BSM half is made of."""
    if "bsm" not in module["HALVES"]:
        return []
    vehicle = module["Vehicle"]("bsm")
    names = [type(each).__name__ for each in [*vehicle.modules[:-1], *getattr(vehicle, "kept", [])]]
    short = [re.sub("StateEffector$", "", name) for name in names]
    wanted = [name for name in short if not re.search("Msg|Model|SpinningBody$|TranslatingBody$|Data$", name)]
    return sorted(set(wanted))


def facts(module: dict) -> dict:
    inputs = {name for _, changes in module["INPUTS"] for name in changes}
    return {
        "basilisk": Basilisk.__version__,
        "mujoco": version_of_mujoco(),
        "step_s": module["STEP"],
        "duration_s": module["DURATION"],
        "integrator": module["INTEGRATOR"].__name__.replace("svIntegrator", "").lower(),
        "adaptive": "RELATIVE" in module,
        "refused": {half: "; ".join(reasons) for half, reasons in module["REFUSED"].items()},
        "halves": module["HALVES"],
        "has_gravity": "MU" in module,
        "drains": any(name.endswith(".flow") for name in inputs),
        "is_pushed": any(re.search(r"\.(force|flow)$", name) for name in inputs),
        "is_point": "CENTER" in module,
        "effectors": effectors_of(module),
        "hinges": bool(module.get("HINGES")),
        "special_effectors": effectors.special_name(module),
    }


def load(path: str) -> dict:
    """The script's names; changing one changes it for the script."""
    spec = importlib.util.spec_from_file_location("vehicle", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules["vehicle"] = module
    spec.loader.exec_module(module)
    return vars(module)


def version_of_mujoco() -> str:
    """Of the MuJoCo inside Basilisk; its library has it in its name."""
    folders = pathlib.Path(Basilisk.__file__).parents[1].glob("bsk.libs/libmujoco*")
    found = [re.search(r"so\.(\d+\.\d+\.\d+)", each.name) for each in folders]
    return next((match[1] for match in found if match), "")


def main() -> None:
    module = load(sys.argv[1])
    print(json.dumps(facts(module)), flush=True)
    for line in sys.stdin:
        name, steps = line.split()
        vehicle = module["Vehicle"](name) if name in module["HALVES"] else effectors.special_vehicle(module)
        race = Race(vehicle, module["STEP"])
        seconds = race.seconds(int(steps)) / int(steps)
        print(json.dumps({"seconds": seconds, "end": end_of(race.vehicle)}), flush=True)


main()
