"""The fixture for other people's tests."""

from __future__ import annotations

import importlib.metadata
from pathlib import Path

import pytest
from conftest import SPEC

import twincraft as tc


@pytest.fixture
def project(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("PYTHONPATH", str(Path(tc.__file__).parents[1]))
    (pytester.path / "specs").mkdir()
    (pytester.path / "specs" / "vehicle.yaml").write_text(SPEC.read_text())
    return pytester


def run(project: pytest.Pytester, body: str) -> pytest.RunResult:
    (project.path / "specs" / "test_vehicle.py").write_text(
        f"def test_vehicle(twincraft):\n    {body}\n")
    arguments = ["-p", "no:cacheprovider"]
    installed = {e.name for e in importlib.metadata.entry_points(group="pytest11")}
    if "twincraft" not in installed:
        arguments += ["-p", "twincraft.pytest_plugin"]
    return project.runpytest_subprocess(*arguments)


def test_a_spec_that_agrees_passes(project):
    run(project, 'twincraft.assert_agrees("vehicle.yaml", set={"simulation.step": "0.01 s"})'
        ).assert_outcomes(passed=1)


def test_a_spec_that_is_proved_passes(project):
    run(project, 'twincraft.assert_proves("vehicle.yaml")').assert_outcomes(passed=1)


def test_a_spec_that_disagrees_fails_with_the_terminals_text(project):
    result = run(project, 'twincraft.assert_agrees("vehicle.yaml", set={"agreement.attitude": 1e-25})')
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*attitude*EXCEEDED*"])


def test_a_spec_with_faults_fails_with_the_terminals_text(project):
    for claim in ("assert_agrees", "assert_proves"):
        result = run(project, f'twincraft.{claim}("vehicle.yaml", set={{"hub.mass": "-1 kg"}})')
        result.assert_outcomes(failed=1)
        result.stdout.fnmatch_lines(["*error[[]SC*"])


def test_not_judged_passes(project):
    spec = project.path / "specs" / "vehicle.yaml"
    spec.write_text(spec.read_text().split("# Two formulations")[0])
    run(project, 'twincraft.assert_agrees("vehicle.yaml")').assert_outcomes(passed=1)
