"""The race against Basilisk, by tools/compare-basilisk: same spec, same step, nothing recorded."""

from __future__ import annotations

import dataclasses
import json
import pathlib
import re
import tempfile

import programs
from cases import FLEX, Case, paper

HEADING = "## Beside Basilisk [µs per RK4 step]"


def shorter(case: Case, duration: str) -> Case:
    """Long chains take Basilisk milliseconds a step."""
    return dataclasses.replace(case, settings=(*case.settings, f"simulation.duration={duration}"))


ROWS = [
    *(paper(name) for name in ("orbit", "torque", "rw_panels", "orbit_compact", "orbit_extended")),
    *(paper(name) for name in ("variable_mass", "variable_mass_orbit")),
    FLEX[1],
    FLEX[4],
    FLEX[8],
    shorter(FLEX[16], "0.1 s"),
    shorter(FLEX[32], "0.02 s"),
]


def race(case: Case, rounds: int) -> dict:
    """comparison.json; that the trajectories do not agree fails, as another vehicle is no contestant."""
    with tempfile.TemporaryDirectory() as folder:
        command = [str(programs.ROOT / "tools" / "compare-basilisk"), *case.arguments]
        programs.run([*command, "--quiet", "--rounds", str(rounds), "-o", folder])
        return json.loads((pathlib.Path(folder) / "comparison.json").read_text())


def races(rounds: int, tell) -> dict[str, dict]:
    found = {}
    for case in ROWS:
        tell(f"beside Basilisk: {case.name}")
        found[case.name] = race(case, rounds)
    return found


def holds(found: dict[str, dict]) -> bool:
    """Ours is ahead in every row."""
    return all(factor > 1.0 for row in found.values() for factor in row["cost"]["ratios"].values())


def cells(name: str, row: dict) -> list[str]:
    cost, ratios = row["cost"], row["cost"]["ratios"]
    us = {engine: each["best"] for engine, each in cost["us_per_step"].items()}
    effector = f" ({cost['bsm_hinges']})" if cost["bsm_hinges"] else ""
    numbers = [f"{cost['bsm_fastest_us_per_step']:.3g}{effector}", f"{us['mjscene']:.3g}"]
    numbers += [f"{us['our_bsm']:.3g}", f"{us['our_mujoco']:.3g}"]
    keys = ("bsm_over_our_bsm", "mjscene_over_our_mujoco", "mjscene_over_our_bsm")
    return [name, *numbers, *(f"{ratios[key]:.3g}" for key in keys)]


def table(found: dict[str, dict]) -> str:
    head = ["", "Basilisk's BSM (hinges by)", "MJScene", "our BSM", "our MuJoCo", "BSM over our BSM"]
    head += ["MJScene over our MuJoCo", "MJScene over our BSM"]
    lines = [head, ["---", *["---:"] * 7], *(cells(name, row) for name, row in found.items())]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def section(found: dict[str, dict]) -> str:
    first = next(iter(found.values()))
    loads = [row["cost"]["load_average"] for row in found.values()]
    crowded = " (**more than a race should have**)" if max(loads) > first["provenance"]["cores"] else ""
    verdict = "Ours is ahead in every row." if holds(found) else "**Ours is NOT ahead in every row.**"
    return f"""{HEADING}

{table(found)}

{verdict} Basilisk {first["basilisk"]["version"]} with MuJoCo {first["basilisk"]["mujoco"]}, the wheel from PyPI, against
{first["provenance"]["program"]} with MuJoCo {first["provenance"]["mujoco"]}, {first["cost"]["instructions"]}. Load average {min(loads):.1f} to {max(loads):.1f}{crowded}.

Best of {first["cost"]["rounds"]} rounds, in which all take turns. Basilisk flies the script of `sccompile --emit basilisk`, which agreed
with ours before it was timed: one call for many steps, no recording and no Python inside. Of hinges it may use HingedRigidBody or
NHingedRigidBody where they fly the same motion, in place of SpinningBodyNDOF which the script has; the faster one is shown. MJScene
integrates attitude at high order, as ours does. Ours is set to Basilisk's formulation: MRPs, the gravity law of its BSM, and
MuJoCo in the inertial frame.
"""


def replaced(text: str, found: dict[str, dict]) -> str:
    """The document with this section alone made anew."""
    pattern = re.compile(rf"{re.escape(HEADING)}\n.*?(?=^## )", re.DOTALL | re.MULTILINE)
    if not pattern.search(text):
        raise programs.Failed("the document has no section about Basilisk: run all of tools/benchmark")
    return pattern.sub(lambda _: section(found) + "\n", text)
