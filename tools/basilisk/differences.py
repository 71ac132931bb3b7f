"""How far two trajectories are apart, over time, and how far they may be."""

from __future__ import annotations

import csv
import dataclasses
import pathlib
import re

import numpy as np

QUARTER = np.pi / 4


@dataclasses.dataclass(frozen=True)
class Metric:
    name: str  # as in the table
    key: str  # as in the JSON
    unit: str


ATTITUDE = Metric("attitude", "attitude_deg", "deg")
RATE = Metric("body rate", "rate_rad_s", "rad/s")
POSITION = Metric("hub position", "position_m", "m")
VELOCITY = Metric("hub velocity", "velocity_m_s", "m/s")
COM = Metric("system CoM", "com_position_m", "m")
JOINT = Metric("joint angle", "joint_rad", "rad")
TRAVEL = Metric("displacement", "travel_m", "m")
WHEEL = Metric("wheel rate", "wheel_rate_rad_s", "rad/s")
MASS = Metric("mass", "mass_kg", "kg")


@dataclasses.dataclass(frozen=True)
class Trajectory:
    columns: dict[str, np.ndarray]  # by their names without units
    units: dict[str, str]

    @property
    def times(self) -> np.ndarray:
        return np.rint(self.columns["t"] * 1e9) / 1e9

    def vector(self, name: str, axes: str = "xyz") -> np.ndarray:
        return np.column_stack([self.columns[f"{name}.{axis}"] for axis in axes])

    def at(self, rows: np.ndarray) -> Trajectory:
        return Trajectory({name: column[rows] for name, column in self.columns.items()}, self.units)


def read(path: pathlib.Path) -> Trajectory:
    with path.open(newline="") as file:
        rows = csv.reader(file)
        heads = [re.fullmatch(r"(\S+) \[(.*)\]", head) for head in next(rows)]
        values = np.array([[float(cell) for cell in row] for row in rows])
    names = [head[1] for head in heads]
    return Trajectory(dict(zip(names, values.T)), {head[1]: head[2] for head in heads})


def turned_pendulums(ours: Trajectory) -> set[str]:
    """Pendulums that Basilisk gives new axes on the way: those past 45 deg."""
    return {
        name.removesuffix(".theta.position")
        for name, column in ours.columns.items()
        if name.endswith(".theta.position") and np.abs(column).max() > QUARTER
    }


def coordinates(a: Trajectory, unit: str, without: set[str]) -> list[str]:
    return [
        name
        for name in a.columns
        if name.endswith(".position")
        and a.units[name] == unit
        and name.rsplit(".", 2)[0] not in without
    ]


def principal_angle(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Between quaternions, scalar first [deg]; either sign, and any length."""
    vector = a[:, :1] * b[:, 1:] - b[:, :1] * a[:, 1:] - np.cross(a[:, 1:], b[:, 1:])
    angle = 2 * np.arctan2(np.linalg.norm(vector, axis=1), np.abs(np.sum(a * b, axis=1)))
    return np.degrees(angle)


def differences(
    a: Trajectory, b: Trajectory, without: set[str]
) -> tuple[np.ndarray, dict[Metric, np.ndarray]]:
    """Common times and every metric over them. Coordinates of `without` are left out."""
    times, rows_a, rows_b = np.intersect1d(a.times, b.times, return_indices=True)
    a, b = a.at(rows_a), b.at(rows_b)

    def distance(name: str) -> np.ndarray:
        return np.linalg.norm(a.vector(name) - b.vector(name), axis=1)

    def largest(names: list[str]) -> np.ndarray:
        return np.max([np.abs(a.columns[name] - b.columns[name]) for name in names], axis=0)

    found = {
        ATTITUDE: principal_angle(a.vector("q_BN", "wxyz"), b.vector("q_BN", "wxyz")),
        RATE: distance("omega_BN_B"),
        POSITION: distance("r_BN_N"),
        VELOCITY: distance("v_BN_N"),
        COM: distance("r_CN_N"),
    }
    wheels = [
        name
        for name in a.columns
        if name.endswith(".rate") and name.removesuffix("rate") + "position" not in a.columns
    ]
    groups = {
        JOINT: coordinates(a, "rad", without),
        TRAVEL: coordinates(a, "m", without),
        WHEEL: wheels,
        MASS: ["mass"],
    }
    found |= {metric: largest(names) for metric, names in groups.items() if names}
    return times, found


AT_REST = {
    ATTITUDE: 1e-11, RATE: 1e-13, POSITION: 1e-11, COM: 1e-11,
    JOINT: 1e-12, TRAVEL: 1e-11, WHEEL: 1e-10, MASS: 1e-8,
}  # fmt: skip
# Rounding of the place, and of what turns with it.
IN_MOTION = AT_REST | {ATTITUDE: 1e-8, POSITION: 1e-5, COM: 1e-5}
ORBIT = 6000.0  # [s]
# MJScene's velocities are those of the inertial frame, and their rounding acts as a torque: this much
# in an orbit, and with the square of the time.
SCENE_IN_MOTION = IN_MOTION | {ATTITUDE: 0.1, RATE: 1e-6, JOINT: 1e-6, TRAVEL: 1e-6, WHEEL: 1e-6}
SCENE_PUSHED = SCENE_IN_MOTION | {POSITION: 1.0, COM: 1.0}
# Another chart: the integrator's own error.
TURNED = {ATTITUDE: 1e-5, RATE: 1e-7, POSITION: 1e-5, COM: 1e-5, JOINT: 1e-7, TRAVEL: 1e-7}


def is_in_motion(ours: Trajectory) -> bool:
    places, speeds = (np.linalg.norm(ours.vector(name), axis=1) for name in ("r_BN_N", "v_BN_N"))
    return places.max() > 100.0 or speeds.max() > 1.0


def bounds(half: str, ours: Trajectory, facts: dict) -> dict[Metric, float]:
    """What rounding may do, with a decade or more to spare. None of an adaptive method, whose step
    sequences differ."""
    if facts["adaptive"]:
        return {}
    if not is_in_motion(ours):
        found = AT_REST
    elif half == "bsm":
        found = IN_MOTION
    else:
        orbits = max(1.0, facts["duration_s"] / ORBIT)
        found = dict(SCENE_PUSHED if facts["is_pushed"] else SCENE_IN_MOTION)
        found |= {metric: found[metric] * orbits**2 for metric in (ATTITUDE, RATE)}
    if half == "bsm" and turned_pendulums(ours):
        found = {metric: max(bound, TURNED.get(metric, 0)) for metric, bound in found.items()}
    return found
