"""tools/compare-basilisk: what it prints, writes and ends with."""

from __future__ import annotations

import json
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "basilisk"
sys.path.insert(0, str(TOOL))

import chain  # noqa: E402
import differences  # noqa: E402


def compare(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-B", TOOL, *arguments]
    return subprocess.run(list(map(str, command)), cwd=ROOT, capture_output=True, text=True)


@pytest.fixture(scope="module")
def output(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, pathlib.Path]:
    folder = tmp_path_factory.mktemp("compared")
    done = compare("models/quickstart.yaml", "--set", "simulation.duration=10 s", "--rounds", 1, "-o", folder)
    assert done.returncode == 0, done.stderr
    return done.stdout, folder


def test_quickstart_agrees_and_is_timed(output):
    text, folder = output
    data = json.loads((folder / "comparison.json").read_text())
    assert text.endswith("\n\nBasilisk and ours agree\n") and data["verdict"] == "agree"
    assert set(data["agreement"]) == {"bsm", "mjscene"}
    assert set(data["cost"]["us_per_step"]) == {"bsm", "mjscene", "special", "our_bsm", "our_mujoco"}
    assert data["effectors"] == ["ReactionWheel", "SpinningBodyNDOF"]
    assert not any(line.endswith(" ") for line in text.splitlines())


def test_numbers_are_those_of_scsim_compare(output):
    text, folder = output
    command = [chain.program("scsim"), "compare", folder / "bsm.csv", folder / "basilisk_bsm.csv"]
    theirs = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    for name in ("attitude", "body rate", "hub position", "hub velocity", "system CoM"):
        (one,) = re.findall(rf"^  {name} [a-z/]+ +(\S+)", text, re.MULTILINE)
        (other,) = re.findall(rf"^  {name} +(\S+)", theirs, re.MULTILINE)
        assert float(one) == float(other), name


def test_the_page_has_no_script_and_shows_names_as_text(tmp_path):
    spec = (ROOT / "models" / "quickstart.yaml").read_text()
    assert "name: wheels_and_panels" in spec
    path = tmp_path / "<b>&.yaml"
    path.write_text(spec)
    done = compare(path, "--set", "simulation.duration=1 s", "--no-timing", "--quiet", "-o", tmp_path / "out")
    assert (done.returncode, done.stdout) == (0, ""), done.stderr
    page = (tmp_path / "out" / "comparison.html").read_text()
    assert "<script" not in page and "<b>" not in page and "&lt;b&gt;&amp;" in page


def test_a_refused_half_is_shown_with_its_reason():
    done = compare("models/gallery/branched_arm.yaml", "--set", "simulation.duration=0.1 s", "--no-timing")
    assert done.returncode == 0, done.stderr
    assert "Basilisk's BSM does not fly it: telescope: it slides on `upper_arm`" in done.stdout


def test_ours_takes_the_law_of_gravity_that_basilisk_has():
    done = compare("models/paper/orbit_extended.yaml", "--set", "simulation.duration=60 s", "--no-timing")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "engines.bsm.gravity=system_com" in done.stdout


def test_a_step_is_made_of_whole_nanoseconds_for_all():
    changes = ("simulation.duration=0.1 s", "panels.*.segments=8")
    done = compare("models/paper/flex_panels.yaml", *chain.changes(list(changes)), "--no-timing")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "simulation.step=0.00076045" in done.stdout


def test_another_motion_disagrees():
    change = ("--set", "engines.bsm.gravity=body_com", "--set", "simulation.duration=600 s")
    done = compare("models/paper/orbit_extended.yaml", *change, "--no-timing")
    assert done.returncode == 1 and done.stdout.endswith("Basilisk and ours disagree\n"), done.stderr


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [(["no_such.yaml"], 3, "no such file"), (["models/paper/studies/flex_segments.yaml"], 1, "is a study"),
     (["models/gallery/dispersed_burn.yaml"], 1, "is a campaign"),
     ([], 2, "usage"), (["models/quickstart.yaml", "--set", "hub.mas=1 kg"], 1, "hub.mas")])
def test_faults_have_the_codes_of_scsim(arguments, code, says):
    done = compare(*arguments)
    assert done.returncode == code and says in done.stderr


def test_the_sign_of_a_quaternion_is_no_difference():
    q = np.array([[0.6, 0.8, 0.0, 0.0]])
    assert differences.principal_angle(q, -q)[0] == 0.0
    turned = np.array([[np.cos(0.01), np.sin(0.01), 0.0, 0.0]])
    assert differences.principal_angle(np.array([[1.0, 0, 0, 0]]), turned)[0] == pytest.approx(np.degrees(0.02))


def test_what_is_not_finite_does_not_hold():
    from findings import Comparison

    metric = differences.ATTITUDE
    found = Comparison("", np.zeros(1), {metric: np.array([np.nan])}, {metric: 1.0})
    assert found.agrees is False
