"""Both engines in lock step."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import pushed

import twincraft as tc


def test_each_engine_flies_as_alone(m):
    twin = m.twin()
    twin.run_until(3.0)
    for name in ("bsm", "mujoco"):
        alone = m.simulate(name)
        alone.run_until(3.0)
        assert np.array_equal(getattr(twin, name).state, alone.state)
        assert getattr(twin, name).engine == name


def test_disagreement_is_the_reports_agreement(m):
    twin = m.twin()
    twin.run_until(m.duration)
    report = m.run().report["members"][0]["agreement"]
    assert set(twin.disagreement) == set(report)
    for name, row in twin.disagreement.items():
        assert row["max"] >= report[name]["max"] and row["now"] <= row["max"]
        assert row["tolerance"] == report[name]["tolerance"]
        assert row["pass"] == report[name]["pass"]


def test_a_twin_moves_its_engines(m):
    twin = m.twin()
    for call in (
        lambda: twin.bsm.step(), lambda: twin.mujoco.run_until(1.0), lambda: twin.bsm.reset(),
        lambda: twin.bsm.restore(twin.bsm.snapshot()), lambda: twin.bsm.set_state(twin.bsm.state),
    ):
        with pytest.raises(RuntimeError, match="twin"):
            call()
    alone = twin.bsm.copy()
    alone.step()
    assert (alone.time, twin.time) == (0.02, 0.0)


def test_inputs_go_to_both(m):
    twin = m.twin()
    twin.inputs["rw_x.torque"] = 0.5
    assert twin.bsm.inputs["rw_x.torque"] == twin.mujoco.inputs["rw_x.torque"] == 0.5
    twin.mujoco.inputs["rw_x.torque"] = 0.25
    assert twin.inputs["rw_x.torque"] == twin.bsm.inputs["rw_x.torque"] == 0.5
    twin.inputs.release("rw_x.torque")
    assert twin.mujoco.inputs["rw_x.torque"] == 0.010


@pytest.mark.parametrize("lead", ["bsm", "mujoco"])
def test_a_controller_sees_the_lead_and_drives_both(m, lead):
    twin = m.twin(lead=lead)

    def controller(t, y):
        assert np.array_equal(y["omega_BN_B"], getattr(twin, lead).observe()["omega_BN_B"])
        return {"rw_x.torque": 2.0 * y["omega_BN_B"][0]}

    twin.run_until(2.0, every=0.1, controller=controller)
    assert twin.bsm.inputs["rw_x.torque"] == twin.mujoco.inputs["rw_x.torque"]
    assert twin.lead == lead and twin.disagreement["attitude_deg"]["max"] < 1e-9


def test_with_each_there_is_a_controller_per_engine(m):
    twin = m.twin(lead="each")
    seen = []

    def law(name):
        def controller(t, y):
            seen.append(name)
            assert np.array_equal(y["omega_BN_B"], getattr(twin, name).observe()["omega_BN_B"])
            return {"rw_x.torque": 2.0 * y["omega_BN_B"][0]}

        return controller

    twin.run_until(0.3, every=0.1, controller={"bsm": law("bsm"), "mujoco": law("mujoco")})
    assert seen == ["bsm", "mujoco"] * 3
    for name in ("bsm", "mujoco"):
        alone = m.simulate(name)
        alone.run_until(
            0.3, every=0.1, controller=lambda t, y: {"rw_x.torque": 2.0 * y["omega_BN_B"][0]})
        assert np.array_equal(getattr(twin, name).state, alone.state)


def test_with_each_one_controller_drives_its_engine_alone(m):
    twin = m.twin(lead="each")
    twin.run_until(0.2, every=0.1, controller={"mujoco": lambda t, y: {"rw_x.torque": 1.0}})
    assert (twin.bsm.inputs["rw_x.torque"], twin.mujoco.inputs["rw_x.torque"]) == (0.010, 1.0)


def test_with_each_what_a_controller_raises_comes_through(m):
    twin = m.twin(lead="each")

    def controller(t, y):
        if t > 0.15:
            raise LookupError("mine")

    for pair in ({"bsm": controller}, {"mujoco": controller}):
        twin.reset()
        with pytest.raises(LookupError, match="mine"):
            twin.run_until(1.0, every=0.1, controller=pair)
        assert twin.time == twin.bsm.time == twin.mujoco.time == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("lead", "controller", "error"),
    [
        ("each", lambda t, y: None, TypeError), ("bsm", {"bsm": lambda t, y: None}, TypeError),
        ("each", {"ode": lambda t, y: None}, ValueError), ("each", {"bsm": 3}, TypeError),
    ],
)
def test_controllers_that_do_not_fit_the_lead_are_refused(m, lead, controller, error):
    with pytest.raises(error):
        m.twin(lead=lead).run_until(1.0, controller=controller)


def test_a_lead_that_is_none_is_refused(m):
    with pytest.raises(ValueError, match="each"):
        m.twin(lead="both")


def test_its_engines_keep_it(m):
    bsm = m.twin().bsm
    assert bsm.observe()["mass"] == pytest.approx(700.0)


def test_a_model_without_an_attitude_flies_both():
    twin = pushed().twin()
    twin.step(10)
    assert all(row["now"] is not None for row in twin.disagreement.values())


def test_a_failure_leaves_both_at_one_step_end(m):
    twin = pushed().twin()
    twin.inputs["w.torque"] = 1e308
    with pytest.raises(tc.NumericalError):
        twin.step(1000)
    assert twin.bsm.time == twin.mujoco.time == twin.time
