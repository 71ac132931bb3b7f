"""How far apart two trajectories are, and how far they may be.

A trajectory is a CSV file in our columns. Of each kind of column the largest difference over all
samples counts; of attitudes the angle between them, for q and -q are one attitude."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

Trajectory = dict[str, np.ndarray]  # by column

KINDS = {
    "r_BN_N": "hub [m]", "r_CN_N": "hub [m]", "v_BN_N": "hub rate [m/s]", "v_CN_N": "hub rate [m/s]",
    "omega_BN_B": "rate [rad/s]", "mass": "mass [kg]",
}  # fmt: skip


def read(file: Path) -> Trajectory:
    with file.open() as lines:
        columns, *rows = csv.reader(lines)
    return dict(zip(columns, np.array(rows, float).T, strict=True))


def distance(trajectory: Trajectory) -> float:
    """The largest from N [m]."""
    return float(np.max(np.linalg.norm([trajectory[f"r_BN_N.{i} [m]"] for i in "xyz"], axis=0)))


def kind_of(column: str, columns: Trajectory) -> str:
    """A joint has a position and a rate, a wheel a rate alone."""
    for start, kind in KINDS.items():
        if column.startswith(start):
            return kind
    unit = column[column.index("["):]
    if column.endswith(f".position {unit}"):
        return f"joint {unit}"
    has_position = column.replace(".rate ", ".position ").replace("/s]", "]") in columns
    return f"joint rate {unit}" if has_position else f"wheel {unit}"


def turn_deg(a: Trajectory, b: Trajectory) -> np.ndarray:
    """From one attitude to the other; exact for small angles, where arccos would not be."""
    p, q = (np.array([each[f"q_BN.{i} [1]"] for i in "wxyz"]) for each in (a, b))
    vector = p[0] * q[1:] - q[0] * p[1:] - np.cross(p[1:], q[1:], axis=0)
    return np.degrees(2 * np.arcsin(np.minimum(np.linalg.norm(vector, axis=0), 1)))


def turned_pendulums(ours: Trajectory) -> list[str]:
    """Those that go beyond 45 deg, where Basilisk's BSM gives them new axes to count angles about."""
    return [column.removesuffix("theta.position [rad]") for column, values in ours.items()
            if column.endswith(".theta.position [rad]") and np.max(np.abs(values)) > np.pi / 4 - 0.05]


def without(trajectory: Trajectory, starts: list[str]) -> Trajectory:
    return {column: values for column, values in trajectory.items() if not column.startswith(tuple(starts))}


def differences(a: Trajectory, b: Trajectory) -> dict[str, float]:
    """The largest of each kind; NaN where one is. Of a vehicle that drains v_CN_N is left out: for
    Basilisk it is how fast that point moves, for us momentum by mass."""
    assert list(a) == list(b), "the columns differ"
    times = a["t [s]"], b["t [s]"]
    assert len(times[0]) == len(times[1]), f"there are {len(times[0])} and {len(times[1])} samples"
    assert np.allclose(*times, rtol=0, atol=1e-9), "the times of samples differ"
    drains = np.ptp(a["mass [kg]"]) > 0
    worst = {"attitude [deg]": float(np.max(turn_deg(a, b)))}
    for column in a:
        if column.startswith(("t ", "q_BN")) or (drains and column.startswith("v_CN_N")):
            continue
        kind = kind_of(column, a)
        worst[kind] = float(np.maximum(worst.get(kind, 0), np.max(np.abs(a[column] - b[column]))))
    return worst


# Two formulations of one machine, by one method at one step, differ by rounding.
ROUNDING = {
    "attitude [deg]": 1e-11, "rate [rad/s]": 1e-13, "hub [m]": 1e-11, "hub rate [m/s]": 1e-12,
    "joint [rad]": 1e-12, "joint [m]": 1e-12, "joint rate [rad/s]": 1e-11, "joint rate [m/s]": 1e-12,
    "wheel [rad/s]": 1e-10, "mass [kg]": 1e-8,
}  # fmt: skip
# And by that of the distance from N, 1e-16 of it in each step. MJScene has all places as numbers
# from N, so its arms of forces have that error too, and with them its torques.
PER_METRE = {
    "bsm": {"attitude [deg]": 1e-15, "hub [m]": 1e-12, "hub rate [m/s]": 1e-15},
    "mjscene": {
        "attitude [deg]": 1e-9, "rate [rad/s]": 1e-13, "hub [m]": 1e-7, "hub rate [m/s]": 1e-10,
        "joint [rad]": 1e-12, "joint [m]": 1e-12, "joint rate [rad/s]": 1e-11,
        "joint rate [m/s]": 1e-12, "wheel [rad/s]": 1e-12,
    },
}  # fmt: skip
# Adaptive methods take other steps: ours have a tolerance for each quantity and go on with the last
# step after an event, Basilisk's have one for each vector of states and begin anew in each step of
# the grid. The error of a rate is what it is of a position by the fastest spring, 100 rad/s or so.
PER_TOLERANCE = dict.fromkeys(ROUNDING, 1e4) | {"attitude [deg]": 1e5, "joint rate [rad/s]": 1e6}


def allowed(half: str, distance: float, tolerance: float) -> dict[str, float]:
    """@param distance  from N [m]   @param tolerance  of the method; 0: its steps are all alike"""
    return {kind: least + distance * PER_METRE[half].get(kind, 0) + tolerance * PER_TOLERANCE[kind]
            for kind, least in ROUNDING.items()}


def excess(worst: dict[str, float], limits: dict[str, float]) -> dict[str, str]:
    """What is too far apart, and by how much."""
    return {kind: f"{value:.1e}, and {limits[kind]:.0e} is allowed"
            for kind, value in worst.items() if not value <= limits[kind]}
