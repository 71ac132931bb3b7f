"""The script as its users run it: command line, what it says where it cannot fly, and a task of their own."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

import flights
from flights import ROOT, fly_script, run

QUICKSTART = ROOT / "models" / "quickstart.yaml"
BRANCHED = ROOT / "models" / "gallery" / "branched_arm.yaml"


@pytest.fixture(scope="module")
def quickstart(tmp_path_factory) -> Path:
    """Its script, of 2 s."""
    folder = tmp_path_factory.mktemp("quickstart")
    return flights.emit(QUICKSTART, folder, "simulation.duration=2").script


@pytest.fixture(scope="module")
def branched(tmp_path_factory) -> Path:
    """One that has no BSM half."""
    folder = tmp_path_factory.mktemp("branched")
    return flights.emit(BRANCHED, folder, "simulation.duration=0.1", "simulation.record=0.05").script


def csv_files(folder: Path) -> list[str]:
    return sorted(each.name for each in folder.iterdir())


def lines(file: Path) -> list[str]:
    return file.read_text().splitlines()


def times(file: Path) -> list[str]:
    return [line.split(",")[0] for line in lines(file)[1:]]


def test_both_halves_go_into_the_current_folder_and_say_what_a_step_took(quickstart, tmp_path):
    done = fly_script(quickstart, cwd=tmp_path)
    assert csv_files(tmp_path) == ["basilisk_bsm.csv", "basilisk_mjscene.csv"]
    assert times(tmp_path / "basilisk_bsm.csv") == ["0.0", "0.5", "1.0", "1.5", "2.0"]
    bsm, mjscene = done.stdout.splitlines()
    assert bsm.startswith("bsm: 100 steps, ") and mjscene.startswith("mjscene: 100 steps, ")
    assert done.stderr == ""


def test_its_columns_are_ours(quickstart, tmp_path):
    fly_script(quickstart, "--engine", "bsm", "-o", tmp_path)
    run(flights.PROGRAMS / "scsim", QUICKSTART, "--duration", "2 s", "--engine", "bsm", "--no-timing", "--quiet",
        "-o", tmp_path)
    assert lines(tmp_path / "basilisk_bsm.csv")[0] == lines(tmp_path / "bsm.csv")[0]


def test_step_and_duration_act_and_folders_are_made(quickstart, tmp_path):
    folder = tmp_path / "deep" / "er"
    done = fly_script(quickstart, "--engine", "mjscene", "--step", "0.1", "--duration", "0.7", "-o", folder)
    assert csv_files(folder) == ["basilisk_mjscene.csv"]
    assert done.stdout.startswith("mjscene: 7 steps, ")
    assert times(folder / "basilisk_mjscene.csv") == ["0.0", "0.5", "0.7"]


@pytest.mark.parametrize("arguments", [["--engines", "bsm"], ["--engine", "mujoco"], ["more"], ["--step", "fast"],
                                       ["--step", "0"], ["--step", "nan"], ["--duration", "-1"]])
def test_a_bad_command_line_is_refused(quickstart, tmp_path, arguments):
    done = fly_script(quickstart, *arguments, cwd=tmp_path, codes=(2,))
    assert "error: " in done.stderr.splitlines()[-1] and "Traceback" not in done.stderr
    assert csv_files(tmp_path) == []


def test_help_says_what_it_flies(quickstart):
    assert "hub, three reaction wheels" in fly_script(quickstart, "--help").stdout


def test_a_half_that_is_refused_says_why(branched, tmp_path):
    done = fly_script(branched, "--engine", "bsm", "-o", tmp_path, codes=(1,))
    assert done.stderr.startswith("bsm: ") and done.stderr.count("\n") == 1
    assert "`finger_l` and `finger_r` branch off it" in done.stderr
    assert csv_files(tmp_path) == []


def test_both_flies_the_half_there_is(branched, tmp_path):
    fly_script(branched, "--engine", "both", "-o", tmp_path)
    assert csv_files(tmp_path) == ["basilisk_mjscene.csv"]


def test_a_motion_that_is_lost_is_said_in_a_line(quickstart, tmp_path):
    """The panels' springs need shorter steps."""
    done = fly_script(quickstart, "--step", "3", "--duration", "3e4", "--engine", "bsm", "-o", tmp_path, codes=(1,))
    assert "Traceback" not in done.stderr and "finite" in done.stderr
    assert csv_files(tmp_path) == []


HOSTILE = (r'''"5 % {0} 3 %(prog)d %s \"\"\" \nraise SystemExit('run')\n\t\"\"\" and \\ and \\N{x} '''
           r"""'#' \u00e9 \u65e5\u672c \U0001F680 \u202e \u2028 """ + "x" * 300 + '"')


def test_a_description_is_text_alone(tmp_path):
    text = QUICKSTART.read_text().replace("\ndescription: ", f"\ndescription: {HOSTILE} #")
    (tmp_path / "spec.yaml").write_text(text)
    script = flights.emit(tmp_path / "spec.yaml", tmp_path / "out", "simulation.duration=0.02").script
    assert script.read_bytes().isascii()
    assert flights.lint(script) == ""
    assert "5 % {0} 3 %(prog)d %s" in fly_script(script, "--help").stdout
    fly_script(script, "-o", tmp_path / "flown")
    assert len(csv_files(tmp_path / "flown")) == 2


LADDER = """format: spacecraft/1
name: ladder
hub: {mass: 600, inertia: [400, 380, 360]}
panels:
  - {name: wing, hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: [1, 0, 0]}, segments: 96,
     mass: 50, length: 9.6, inertia: {shape: bar, axial_ratio: 0.05, axial_minimum: 1.0e-4}, stiffness: 10}
loads: [{name: push, force: [1, 0, 0], position: com}]
simulation: {integrator: rk4, step: 0.1, duration: 1, record: 0.5}
"""


def test_a_vehicle_of_neither_half_has_no_script(tmp_path):
    (tmp_path / "ladder.yaml").write_text(LADDER)
    emitted = flights.emit(tmp_path / "ladder.yaml", tmp_path / "out")
    assert emitted.script is None
    assert emitted.reasons("bsm") == ["it acts at the centre of mass, which moves in this vehicle"]
    [why] = emitted.reasons("mjscene")
    assert "96" in why


def without_basilisk(script: Path, path: Path) -> str:
    """What the script says in another Python, which has no Basilisk but what is in `path`."""
    environment = {**os.environ, "PYTHONPATH": str(path)}
    done = run("/usr/bin/python3", "-B", script, cwd=path, env=environment, codes=(1,))
    assert done.stdout == ""
    return done.stderr


def test_without_basilisk_it_says_what_to_install(quickstart, tmp_path):
    said = without_basilisk(quickstart, tmp_path)
    assert said.count("\n") == 1 and "pip install bsk" in said and "No module named" in said


def test_an_old_basilisk_is_refused(quickstart, tmp_path):
    for module in ("Basilisk", "Basilisk/architecture", "Basilisk/simulation", "numpy"):
        (tmp_path / module).mkdir()
        (tmp_path / module / "__init__.py").write_text("__version__ = '2.11.0'\n__getattr__ = lambda name: None\n")
    said = without_basilisk(quickstart, tmp_path)
    assert said.count("\n") == 1 and "pip install bsk" in said and "2.11.0" in said


def test_a_basilisk_without_mujoco_flies_the_other_half(quickstart, tmp_path):
    """With the real one but for its word that it has MuJoCo."""
    program = ("import runpy, sys, Basilisk; Basilisk.hasBuildFeature = lambda name: False; "
               "sys.argv = sys.argv[1:]; runpy.run_path(sys.argv[0], run_name='__main__')")
    python = [sys.executable, "-B", "-c", program, quickstart, "-o", tmp_path]
    run(*python)
    assert csv_files(tmp_path) == ["basilisk_bsm.csv"]
    assert "MuJoCo" in run(*python, "--engine", "mjscene", codes=(1,)).stderr


@pytest.mark.parametrize("engine", flights.HALVES)
def test_in_a_task_it_flies_the_same_bits_again_and_again(engine, tmp_path):
    """Where steps and inputs are at ticks."""
    settings = ["simulation.duration=2", "wheels.rw_x.torque=[[0, 0.01], [0.5, -0.02], [1.1, 0]]"]
    script = flights.emit(QUICKSTART, tmp_path, *settings).script
    run(sys.executable, "-B", Path(__file__).with_name("task.py"), script, engine)
