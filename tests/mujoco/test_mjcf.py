"""The MJCF in the MuJoCo that users have today: every vehicle of the repository and 200 random ones
accelerate there as in our analytic engine, and one flies the same trajectory, in Basilisk too.

tools/check mujoco builds the programs and runs this. What is compared is the MJCF alone, see
tests/support/accelerations.cpp. The bound of every acceleration comes with it: 1e-10 of the largest
of its kind, as in the proof of our own engines, and what MuJoCo's sums may round to. Measured: 4e-11 of
the largest for 32 segments in a row, 1.3e-11 for all others, and at most 2 % of the bound."""

from __future__ import annotations

import csv
import json
import re
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = ROOT / "build" / "release" / "bin"


def run(program: str, *arguments: object) -> str:
    done = subprocess.run(
        [PROGRAMS / program, *map(str, arguments)], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stderr
    return done.stdout


def vehicles_of(specs: list[Path]) -> list[dict]:
    return json.loads(run("accelerations", *specs))


def set_state(model: mujoco.MjModel, data: mujoco.MjData, vehicle: dict, state: dict) -> None:
    mujoco.mj_resetDataKeyframe(model, data, model.key("initial").id)
    if not vehicle["translation"]:
        data.qpos[3:7] = state["attitude"]
        data.qvel[3:6] = state["rate"]
    for name, position, rate in zip(
            vehicle["joints"], state["joint_position"], state["joint_rate"], strict=True):
        data.joint(name).qpos[0] = position
        data.joint(name).qvel[0] = rate
    for name, rate in zip(vehicle["wheels"], state["wheel_rate"], strict=True):
        data.joint(name).qvel[0] = rate
    for i in range(model.nu):
        data.ctrl[i] = state["effort"][model.actuator(i).name]


def excess(vehicle: dict, mjcf: str | None = None) -> float:
    """How many times its bound the worst acceleration is off by."""
    model = mujoco.MjModel.from_xml_string(mjcf or vehicle["mjcf"])
    data = mujoco.MjData(model)
    entries = list(range(3 if vehicle["translation"] else 6))
    entries += [model.joint(n).dofadr[0] for n in vehicle["joints"] + vehicle["wheels"]]
    assert model.nv == len(entries)
    worst = []
    for state in vehicle["states"]:
        set_state(model, data, vehicle, state)
        mujoco.mj_forward(model, data)
        off = np.abs(data.qacc[entries] - state["acceleration"]) / state["bound"]
        worst.append(np.max(off))  # NaN where one is
    return float(np.max(worst))


def files(pattern: str) -> list[Path]:
    return sorted(ROOT.glob(pattern))


@pytest.mark.parametrize(
    "pattern",
    ["tests/golden/*.yaml", "models/**/*.yaml", "tests/components/vehicles/*.yaml",
     "tests/random/findings/*.yaml"])
def test_vehicles_of_the_repository_accelerate_as_in_our_analytic_engine(pattern):
    vehicles = vehicles_of(files(pattern))
    assert len(vehicles) >= 5
    assert {v["spec"]: e for v in vehicles if not (e := excess(v)) <= 1.0} == {}


def test_random_vehicles_accelerate_as_in_our_analytic_engine(tmp_path):
    run("random_vehicles", "--write", tmp_path, "--count", 200, "--seed", 1)
    vehicles = vehicles_of(sorted(tmp_path.iterdir()))
    assert len(vehicles) == 200
    assert {v["spec"]: e for v in vehicles if not (e := excess(v)) <= 1.0} == {}


# Offsets and turns of inertials that MuJoCo 3 and later take for none. TURNED has its principal
# axes 7e-7 rad off the body's.
TURNED = "[[350, 1e-5, 0], [1e-5, 380, -2e-5], [0, -2e-5, 410]]"
SMALL = {
    "offset": "hub: {mass: 600, inertia: [400, 380, 350], center_of_mass: [3e-7, -9e-7, 0]}",
    "turn": f"hub: {{mass: 600, inertia: {TURNED}}}",
    "offset and turn": f"hub: {{mass: 600, inertia: {TURNED}, center_of_mass: [0, 5e-7, 0]}}",
    "turn far out": f"hub: {{mass: 600, inertia: {TURNED}, center_of_mass: [0.1, 0, 0.3]}}",
    "body": f"""hub: {{mass: 600, inertia: [400, 380, 350]}}
bodies:
  - {{name: arm, joint: {{type: revolute, axis: [0, 1, 0], position: [1e-7, 1, 0]}}, mass: 300,
     inertia: {TURNED}, center_of_mass: [0, 0, 4e-7]}}""",
}  # fmt: skip
MOVING = """
format: spacecraft/1
name: small
wheels:
  - {name: w, axis: [0, 0, 1], position: [1, 0.2, 0], spin_inertia: 0.1, transverse_inertia: 0.06,
     speed: 1000 rpm}
initial: {rate: [0.02, 0.05, -0.03]}
simulation: {step: 0.1 s, duration: 10 s}
"""


def named_like_the_body(inertial: re.Match) -> str:
    """The inertial with its principal axes in the order and sense of the body's, as near as can be."""
    matrix, quat = np.zeros(9), np.zeros(4)
    mujoco.mju_quat2Mat(matrix, np.array(inertial[1].split(), float))
    axes, moments = matrix.reshape(3, 3), np.array(inertial[2].split(), float)
    order = [int(np.argmax(np.abs(axes[row]))) for row in range(3)]
    near = axes[:, order] * np.sign(np.diag(axes[:, order]))
    mujoco.mju_mat2Quat(quat, near.ravel())
    texts = [" ".join(map(repr, v.tolist())) for v in (quat, moments[order])]
    return f'quat="{texts[0]}" diaginertia="{texts[1]}"'


@pytest.mark.parametrize("what", SMALL)
def test_no_small_offset_or_turn_is_lost(what, tmp_path):
    spec = tmp_path / "small.yaml"
    spec.write_text(MOVING + SMALL[what] + "\n")
    [vehicle] = vehicles_of([spec])
    assert excess(vehicle) <= 1.0
    body = f'<body name="{"arm" if what == "body" else "hub"}"'
    head, tail = vehicle["mjcf"].split(body)
    tail = re.sub('quat="([^"]*)" diaginertia="([^"]*)"', named_like_the_body, tail, count=1)
    assert excess(vehicle, head + body + tail) > 10.0, "MuJoCo has ceased to ignore it"


def test_a_token_on_top_is_the_machine_that_was_asked_for(tmp_path):
    spec = tmp_path / "token.yaml"
    spec.write_text(MOVING + "hub: {mass: 600, inertia: [400, 380, 350]}\n"
                    "engines: {mujoco: {compensate: false, wheel_mass: 0.01}}\n")
    [vehicle] = vehicles_of([spec])
    assert 'mass="0.01"' in vehicle["mjcf"]
    assert excess(vehicle) <= 1.0


def test_a_millimetre_ten_thousandth_is_seen():
    [vehicle] = vehicles_of([ROOT / "models" / "quickstart.yaml"])
    moved = vehicle["mjcf"].replace('<inertial pos="0 0 0"', '<inertial pos="1.1e-6 0 0"', 1)
    assert moved != vehicle["mjcf"]
    assert excess(vehicle, moved) > 1000.0


@pytest.fixture(scope="module")
def flown(tmp_path_factory) -> tuple[Path, np.ndarray]:
    """The MJCF of the quick start with a wheel out of the centre, and its q_BN after 10 s in our
    analytic engine."""
    folder = tmp_path_factory.mktemp("flown")
    wheel = ["models/quickstart.yaml", "--set", "wheels.rw_x.position=[1,0.2,0]"]
    run("sccompile", *wheel, "--emit", "mjcf", "-o", folder)
    run("scsim", *wheel, "--duration", "10 s", "--engine", "bsm", "--no-timing", "--quiet", "-o", folder)
    with (folder / "bsm.csv").open() as file:
        last = list(csv.DictReader(file))[-1]
    assert last["t [s]"] == "10"
    return folder / "wheels_and_panels.xml", np.array([float(last[f"q_BN.{c} [1]"]) for c in "wxyz"])


def angle_deg(a: np.ndarray, b: np.ndarray) -> float:
    back, turn = np.zeros(4), np.zeros(4)
    mujoco.mju_negQuat(back, a)
    mujoco.mju_mulQuat(turn, back, b)
    return float(np.degrees(2.0 * np.linalg.norm(turn[1:])))


# 500 steps of two formulations: rounding is at 3e-14 deg.
def test_a_wheel_out_of_the_centre_flies_the_same(flown):
    file, q_BN = flown
    model = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    assert model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4
    for _ in range(500):
        mujoco.mj_step(model, data)
    assert angle_deg(q_BN, data.qpos[3:7]) <= 1e-11


def test_a_wheel_out_of_the_centre_flies_in_basilisk(flown):
    file, q_BN = flown
    done = subprocess.run(
        [sys.executable, "-B", Path(__file__).with_name("scene.py"), file, "500", "0.02"],
        capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert angle_deg(q_BN, np.array(json.loads(done.stdout.splitlines()[-1])[3:7])) <= 1e-11
