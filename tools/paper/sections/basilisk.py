"""Basilisk itself, flying what `sccompile --emit basilisk` writes, beside both of our engines."""

import concurrent.futures
import json
import os
import pathlib
import subprocess

from document import number, table
from plot import Plot
from runs import ROOT, RunFailed, Runner
from verdict import Section

NAME = "basilisk"
COMPARE = ROOT / "tools" / "compare-basilisk"
TITLES = {"bsm": "BSM", "mjscene": "MJScene"}
# Each with what changes it. Adaptive methods are not judged: their steps are not the same ones.
SPECS = {
    "rw_panels": ("paper/rw_panels", ()),
    "orbit": ("paper/orbit", ()),
    "torque": ("paper/torque", ()),
    "orbit_compact": ("paper/orbit_compact", ()),
    "orbit_extended": ("paper/orbit_extended", ()),
    "variable_mass": ("paper/variable_mass", ()),
    "variable_mass_orbit": ("paper/variable_mass_orbit", ()),
    **{
        f"flex, N={n}": ("paper/flex_panels", (f"panels.*.segments={n}", f"simulation.duration={t}"))
        for n, t in ((1, "8 s"), (4, "8 s"), (8, "8 s"), (16, "1 s"), (32, "0.1 s"))
    },
    "branched_arm": ("gallery/branched_arm", ()),
    "jet_damping": ("gallery/jet_damping", ()),
    "rocket": ("gallery/rocket", ()),
    "tumble": ("gallery/tumble", ("simulation.integrator=rk4", "simulation.step=0.5 s")),
    **{f"nesc_{case}": (f"nesc/case_{case}", ()) for case in ("8a", "9a", "9b", "10a")},
}
QUICK = ("rw_panels",)
RANDOM = 100  # vehicles, from seed 1; none in a quick run
RANDOM_RUN = ("simulation.integrator=rk4", "simulation.step=5 ms", "simulation.record=0.1 s")
COLUMNS = ("attitude_deg", "rate_rad_s", "position_m", "joint_rad", "travel_m", "wheel_rate_rad_s", "mass_kg")
HEADS = ("attitude [deg]", "rate [rad/s]", "hub [m]", "joint [rad]", "slide [m]", "wheel [rad/s]", "mass [kg]")


def run(runner: Runner, plots: dict[str, Plot]) -> Section:
    section = Section(
        "Basilisk",
        "Every vehicle is flown in Basilisk too, by the script that `sccompile --emit basilisk` writes: "
        "as a Spacecraft with effectors, which is its BSM, and as an MJScene. Each is held against our "
        "engine of the same formulation, set to it: MRPs, Basilisk's law of gravity, MuJoCo in the "
        "inertial frame. The number is the largest difference over its bound, of all quantities. "
        "Bounds are those of `tools/compare-basilisk`. In motion MJScene has wide ones, because its "
        "inertial velocities round, and the rounding turns the vehicle as it turns MuJoCo in section 2.",
    )
    names = QUICK if runner.quick else tuple(SPECS)
    found = {name: compare(runner, name, *SPECS[name]) for name in names}
    for name, result in found.items():
        for half, metrics in result["agreement"].items():
            section.bound(f"{name}: {TITLES[half]}", "", worst_share(metrics), 1.0)
    section.tables.append(table_of(found))
    if not runner.quick:
        section.tables.append(random_vehicles(runner, section))
    section.tables.append(refusals(found))
    return section


def compare(runner: Runner, name: str, spec: str, sets: tuple[str, ...]) -> dict:
    folder = runner.folder / "basilisk" / name.replace(", ", "_").replace("=", "")
    return compared(ROOT / "models" / f"{spec}.yaml", sets, folder)


def compared(spec: pathlib.Path, sets: tuple[str, ...], folder: pathlib.Path) -> dict:
    """comparison.json of a vehicle, whatever the verdict."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "comparison.json").unlink(missing_ok=True)
    command = [str(COMPARE), str(spec), "--no-timing", "--quiet", "-o", str(folder)]
    command += [word for change in sets for word in ("--set", change)]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    try:
        return json.loads((folder / "comparison.json").read_text())
    except (OSError, ValueError):
        raise RunFailed(f"{spec.name}: {done.stderr.strip()}") from None


def worst_share(metrics: dict) -> float:
    """Of the bound that is nearest to being exceeded."""
    judged = [entry for entry in metrics.values() if entry["tolerance"]]
    if any(entry["max"] is None for entry in judged):
        return float("inf")
    return max(entry["max"] / entry["tolerance"] for entry in judged)


def cell(metrics: dict, key: str) -> str:
    return number(metrics[key]["max"]) if key in metrics else ""


def table_of(found: dict[str, dict]) -> str:
    rows = []
    for name, result in found.items():
        for half, metrics in result["agreement"].items():
            time = f"{result['duration_s']:g} s, {result['step_s']:.3g} s"
            rows.append([f"{name} ({time})", TITLES[half], *(cell(metrics, key) for key in COLUMNS)])
    first = next(iter(found.values()))["basilisk"]
    text = (
        f"Largest differences over all samples, Basilisk {first['version']} with MuJoCo {first['mujoco']}; "
        "duration and step in brackets."
    )
    return text + "\n\n" + table(["vehicle", "half", *HEADS], rows)


def refusals(found: dict[str, dict]) -> str:
    rows = [
        [name, TITLES[half], reason]
        for name, result in found.items()
        for half, reason in result["refused"].items()
    ]
    if not rows:
        return ""
    return "What a half cannot express is refused:\n\n" + table(["vehicle", "half", "reason"], rows)


def written_vehicles(folder: pathlib.Path) -> list[pathlib.Path]:
    build = ["cmake", "--build", "--preset", "release", "--target", "random_vehicles", "--", "--quiet"]
    folder.mkdir(parents=True, exist_ok=True)
    write = [str(ROOT / "build" / "release" / "bin" / "random_vehicles"), "--write", str(folder)]
    write += ["--count", str(RANDOM), "--seed", "1"]
    for command in (build, write):
        done = subprocess.run(command, cwd=ROOT, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if done.returncode != 0:
            raise RunFailed(f"random vehicles: {done.stderr.strip() or done.stdout.strip()}")
    return sorted(folder.glob("*.yaml"))


def random_vehicles(runner: Runner, section: Section) -> str:
    folder = runner.folder / "basilisk" / "random"
    specs = written_vehicles(folder)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda spec: compared(spec, RANDOM_RUN, folder / spec.stem), specs))
    rows = []
    for half, title in TITLES.items():
        flown = [result["agreement"][half] for result in found if half in result["agreement"]]
        judged = [metrics for metrics in flown if any(entry["tolerance"] for entry in metrics.values())]
        share = max((worst_share(metrics) for metrics in judged), default=float("inf"))
        section.bound(f"{len(judged)} random vehicles: {title}", "", share, 1.0)
        worst = {
            key: {"max": max(values)}
            for key in COLUMNS
            if (values := [metrics[key]["max"] for metrics in judged if key in metrics])
        }
        refused = str(sum(half in result["refused"] for result in found))
        rows.append([title, str(len(flown)), refused, *(cell(worst, key) for key in COLUMNS)])
    text = f"{len(found)} random vehicles over the whole language, the worst of each quantity."
    return text + "\n\n" + table(["half", "flown", "refused", *HEADS], rows)
