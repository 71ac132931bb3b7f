"""That the comparison can fail: a vehicle that is flown otherwise, a little, is found out."""

from __future__ import annotations

import numpy as np
import pytest

import comparison
import flights


def trajectory(**changes: list[float]) -> comparison.Trajectory:
    """Of a wheel and a joint, in two samples."""
    columns = ["t [s]", *(f"r_BN_N.{i} [m]" for i in "xyz"), *(f"q_BN.{i} [1]" for i in "wxyz"),
               *(f"v_CN_N.{i} [m/s]" for i in "xyz"), "a.position [rad]", "a.rate [rad/s]", "w.rate [rad/s]",
               "mass [kg]"]
    values = {column: np.zeros(2) for column in columns}
    values |= {"t [s]": np.array([0.0, 1.0]), "q_BN.w [1]": np.ones(2), "mass [kg]": np.full(2, 5.0)}
    named = {column.split(" ")[0].replace(".", "_"): column for column in columns}
    return values | {named[name]: np.array(value) for name, value in changes.items()}


def test_kinds_are_told_apart():
    moved = trajectory(a_position=[0, 1], a_rate=[0, 2], w_rate=[3, 0], mass=[5, 9], r_BN_N_y=[0, -6])
    assert comparison.differences(trajectory(), moved) == {
        "attitude [deg]": 0, "hub [m]": 6, "hub rate [m/s]": 0, "joint [rad]": 1, "joint rate [rad/s]": 2,
        "wheel [rad/s]": 3, "mass [kg]": 4}


def test_attitudes_are_compared_by_their_angle():
    half = np.radians(1e-9) / 2
    turned = trajectory(q_BN_w=[-1, -np.cos(half)], q_BN_z=[0, -np.sin(half)])
    assert comparison.differences(trajectory(), turned)["attitude [deg]"] == pytest.approx(1e-9, rel=1e-9)


def test_how_fast_the_centre_of_mass_is_counts_until_mass_is_lost():
    assert comparison.differences(trajectory(), trajectory(v_CN_N_x=[0, 1]))["hub rate [m/s]"] == 1
    drained = {"mass": [5, 4]}
    found = comparison.differences(trajectory(**drained), trajectory(**drained, v_CN_N_x=[0, 1]))
    assert "hub rate [m/s]" not in found


def test_what_is_no_number_is_an_excess():
    worst = comparison.differences(trajectory(), trajectory(w_rate=[0, np.nan]))
    assert list(comparison.excess(worst, comparison.ROUNDING)) == ["wheel [rad/s]"]


@pytest.mark.parametrize("other", [{"t": [0, 1.1]}, {"t": [0, 1, 2]}])
def test_samples_at_other_times_are_refused(other):
    with pytest.raises(AssertionError, match="samples"):
        comparison.differences(trajectory(), trajectory(**other))


def test_other_columns_are_refused():
    with pytest.raises(AssertionError, match="columns"):
        comparison.differences(trajectory(), trajectory() | {"b.rate [rad/s]": np.zeros(2)})


QUICKSTART = "models/quickstart.yaml", ["simulation.duration=2"]
ORBIT = "models/paper/orbit_extended.yaml", ["simulation.duration=20", "simulation.record=1"]
TORQUE = "wheels.rw_x.torque=[[0, 0.01], [{}, -0.01]]"
WRONG = {
    "an input one step late": (QUICKSTART, TORQUE.format(1), TORQUE.format(1.02)),
    "an input one step late in orbit": (ORBIT, TORQUE.format(5), TORQUE.format(5.1)),
    "a wheel that turns the other way": (QUICKSTART, "wheels.rw_y.torque=0.01", "wheels.rw_y.torque=-0.01"),
    "a hinge about the other axis": (QUICKSTART, "panels.wing_p.angle=[1 deg]", "panels.wing_p.angle=[-1 deg]"),
    "another method": (QUICKSTART, "simulation.integrator=rk4", "simulation.integrator=rk2"),
    "a millionth of a mass": (QUICKSTART, "hub.mass=600", "hub.mass=600.0006"),
}  # fmt: skip


@pytest.mark.parametrize("what", WRONG)
def test_a_vehicle_flown_otherwise_is_found_out(what, tmp_path):
    (spec, settings), ours, theirs = WRONG[what]
    emitted = flights.fly_theirs(flights.ROOT / spec, tmp_path / "theirs", *settings, theirs)
    flights.fly_ours(flights.ROOT / spec, tmp_path / "ours", emitted, *settings, ours)
    faults = flights.compare(emitted, tmp_path / "theirs", tmp_path / "ours").faults
    assert list(faults) == ["bsm", "mjscene"]


def test_a_pendulum_beyond_45_deg_is_left_out():
    high = {"bob.phi.position [rad]": np.zeros(2), "bob.theta.position [rad]": np.array([0.1, -0.8])}
    turned = comparison.turned_pendulums(trajectory() | high | {"low.theta.position [rad]": np.array([0.1, 0.5])})
    assert turned == ["bob."]
    assert comparison.without(trajectory() | high, turned).keys() == trajectory().keys()
