"""The script for Basilisk of every vehicle of the repository and of 60 random ones: it flies as
ours do, in each of its halves, and what is refused is refused with a reason."""

from __future__ import annotations

from pathlib import Path

import pytest

import flights
from conftest import RANDOM

# Long runs are cut, and steps by a rule are set to whole nanoseconds, as they are in Basilisk. Of
# everything.yaml the first step of 1 s would overflow, which ends a flight in MJScene.
ENDS = {  # [s]
    "models/gallery/dispersed_burn.yaml": 20, "models/gallery/dispersed_telescope.yaml": 2,
    "models/quickstart.yaml": 60, "models/gallery/branched_arm.yaml": 5, "models/gallery/jet_damping.yaml": 10,
    "models/nesc/case_10a.yaml": 2000, "models/nesc/case_8a.yaml": 2000, "models/nesc/case_9a.yaml": 2000,
    "models/nesc/case_9b.yaml": 2000, "models/paper/orbit_compact.yaml": 200, "models/paper/orbit_extended.yaml": 200,
    "models/paper/rw_panels.yaml": 20, "models/paper/torque.yaml": 100, "models/paper/variable_mass.yaml": 60,
    "models/paper/variable_mass_orbit.yaml": 60, "models/paper/studies/rw_wheel_mass.yaml": 10,
    "models/paper/studies/torque_drift.yaml": 100, "models/paper/studies/torque_principal.yaml": 100,
    "models/paper/studies/variable_mass_rigid.yaml": 10, "tests/golden/everything.yaml": 2,
    "models/paper/flex_bodies/02.yaml": 4, "models/paper/flex_bodies/04.yaml": 2,
    "models/paper/flex_bodies/08.yaml": 0.75, "models/paper/flex_bodies/16.yaml": 0.125,
    "models/paper/flex_bodies/32.yaml": 0.018,
}  # fmt: skip
STEPS = {  # [s]
    "tests/golden/everything.yaml": 0.1, "models/paper/flex_bodies/02.yaml": 0.005,
    "models/paper/flex_bodies/04.yaml": 0.002, "models/paper/flex_bodies/08.yaml": 0.00075,
    "models/paper/flex_bodies/16.yaml": 0.00025, "models/paper/flex_bodies/32.yaml": 0.00009,
}  # fmt: skip


def settings_of(spec: str) -> list[str]:
    """A run that is cut has 20 samples, and no state to compare with after its end."""
    settings = [f"simulation.step={STEPS[spec]}"] if spec in STEPS else []
    if spec in ENDS:
        settings += [f"simulation.duration={ENDS[spec]}", f"simulation.record={ENDS[spec] / 20:.6g}", "references=[]"]
    return settings


def specs(*patterns: str) -> list[str]:
    return [str(each.relative_to(flights.ROOT)) for pattern in patterns for each in sorted(flights.ROOT.glob(pattern))]


# A study's vehicle is mostly that of the spec it extends.
WHOLE = specs("models/*.yaml", "models/gallery/*.yaml", "models/nesc/*.yaml", "models/paper/*.yaml",
              "models/paper/flex_bodies/*.yaml", "tests/golden/*.yaml")
STUDIES = specs("models/paper/studies/*.yaml")
FLOWN = WHOLE + [spec for spec in STUDIES if spec in ENDS]


def component_at(said: dict) -> str:
    line = Path(said["file"]).read_text().splitlines()[said["line"] - 1]
    assert "name: " in line, said
    return line[said["column"] - 1:said["end_column"] - 1]


def check(flight: flights.Flight) -> None:
    assert not flight.faults
    for half in flights.HALVES:
        assert (half in flight.worst) != bool(flight.emitted.reasons(half))
        for refusal in flight.emitted.about(half, "SC4004"):
            assert component_at(refusal)


@pytest.mark.parametrize("flight", [pytest.param((s, settings_of(s)), id=s) for s in FLOWN], indirect=True)
def test_a_vehicle_of_the_repository(flight):
    check(flight)


@pytest.mark.parametrize("flight", range(1, RANDOM + 1), indirect=True)
def test_a_random_vehicle(flight):
    check(flight)


def test_flake8_finds_nothing(flown, tmp_path):
    scripts = [waiting.result().emitted.script for waiting in flown.values() if not waiting.exception()]
    scripts += [flights.emit(flights.ROOT / spec, tmp_path / spec).script for spec in STUDIES if spec not in FLOWN]
    assert flights.lint(*filter(None, scripts)) == ""
