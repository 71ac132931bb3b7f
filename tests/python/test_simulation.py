"""A simulation, and what a twin has in common with it."""

from __future__ import annotations

import copy
import math

import numpy as np
import pytest
from conftest import ROOT, pushed, python

import twincraft as tc


def bytes_of(flyer) -> bytes:
    return flyer.state.tobytes()


# --- time and steps


def test_a_step_goes_to_the_next_grid_point(flyer):
    assert flyer.time == 0.0
    flyer.step()
    assert flyer.time == 0.02
    flyer.run_until(0.05)
    flyer.step()
    assert flyer.time == 0.06
    flyer.step(n=4)
    assert flyer.time == 0.14


def test_run_until_ends_exactly_there(flyer):
    assert flyer.run_until(0.333) == 0.333 == flyer.time
    before = bytes_of(flyer)
    assert flyer.run_until(0.333) == 0.333
    assert bytes_of(flyer) == before


def test_a_time_off_the_grid_moves_no_grid_point(flyer):
    flyer.run_until(0.333)
    flyer.step(1)
    assert flyer.time == 0.34


@pytest.mark.parametrize("n", [0, -1])
def test_no_steps_are_refused(flyer, n):
    with pytest.raises(ValueError, match="> 0"):
        flyer.step(n)


@pytest.mark.parametrize("n", [1.0, "1", None])
def test_a_number_of_steps_is_an_integer(flyer, n):
    with pytest.raises(TypeError):
        flyer.step(n)


def test_an_integer_of_numpy_is_one(flyer):
    flyer.step(np.int64(3))
    assert flyer.time == 0.06


@pytest.mark.parametrize("t", [0.05, -1.0, math.nan, math.inf])
def test_a_time_that_is_over_or_none_is_refused(flyer, t):
    flyer.run_until(0.1)
    before = bytes_of(flyer)
    with pytest.raises(ValueError) as caught:
        flyer.run_until(t)
    assert not isinstance(caught.value, KeyError)
    assert (flyer.time, bytes_of(flyer)) == (0.1, before)


@pytest.mark.parametrize("every", [0, 0.0, -0.1, math.nan, math.inf])
def test_a_period_that_is_none_is_refused(flyer, every):
    with pytest.raises(ValueError, match="every"):
        flyer.run_until(1.0, every=every)
    assert flyer.time == 0.0


# --- what is seen


def test_observe_gives_the_columns_in_their_order(m, flyer):
    y = flyer.observe()
    assert list(y)[:4] == ["r_BN_N", "v_BN_N", "q_BN", "omega_BN_B"]
    flat = np.concatenate([np.atleast_1d(value) for value in y.values()])
    assert len(flat) == len(m.outputs)
    assert list(y)[-1] == "mass" and type(y["mass"]) is float
    assert y["omega_BN_B"].dtype == np.float64 and y["omega_BN_B"].shape == (3,)
    assert y["q_BN"].tolist() == [1.0, 0.0, 0.0, 0.0]
    assert flyer.observe() is not y


def test_what_was_observed_stays(flyer):
    y = flyer.observe()
    kept = y["omega_BN_B"].copy()
    flyer.step(100)
    assert np.array_equal(y["omega_BN_B"], kept)
    assert not np.array_equal(flyer.observe()["omega_BN_B"], kept)


def test_observe_gives_the_samples_of_the_run(m, engine):
    sim = m.simulate(engine)
    sim.run_until(10.0)
    trajectory = getattr(m.run(engine=engine), engine)
    i = trajectory.t.tolist().index(10.0)
    for name, value in sim.observe().items():
        assert np.array_equal(trajectory[name][i], value), name


def test_the_state_is_a_read_only_copy(m, flyer):
    x = flyer.state
    assert x.shape == (len(m.states),) and x.dtype == np.float64
    with pytest.raises(ValueError):
        x[0] = 1.0
    kept = x.copy()
    flyer.step(10)
    assert np.array_equal(x, kept)


def test_both_engines_have_one_layout(m):
    bsm, mujoco = m.simulate("bsm"), m.simulate("mujoco")
    assert np.array_equal(bsm.state, mujoco.state)
    bsm.step(500), mujoco.step(500)
    assert np.allclose(bsm.state, mujoco.state, atol=1e-9)
    assert bsm.state[list(m.states).index("q_BN.w")] >= 0.0


def test_a_state_can_be_set(m):
    sim, other = m.simulate(), m.simulate()
    sim.step(10)
    other.set_state(sim.state)
    assert np.allclose(other.state, sim.state, rtol=1e-15, atol=1e-18)
    for wrong in (sim.state[:-1], np.full_like(sim.state, np.nan)):
        with pytest.raises(tc.InputError):
            other.set_state(wrong)


def test_an_engine_that_is_none_is_refused(m):
    with pytest.raises(ValueError, match="bsm"):
        m.simulate("ode")


# --- inputs


def test_inputs_read_what_acts(flyer):
    assert flyer.inputs["rw_x.torque"] == 0.010
    flyer.inputs["rw_x.torque"] = 0.5
    assert flyer.inputs["rw_x.torque"] == 0.5
    flyer.inputs["rw_x.torque"] = "10 mN m"
    assert flyer.inputs["rw_x.torque"] == 0.010
    flyer.inputs["rw_x.torque"] = np.float64(2)
    assert flyer.inputs["rw_x.torque"] == 2.0
    flyer.inputs.release("rw_x.torque")
    assert flyer.inputs["rw_x.torque"] == 0.010


def test_inputs_are_a_mapping(m, flyer):
    assert "rw_x.torque" in flyer.inputs
    assert "rw_q.torque" not in flyer.inputs and 3 not in flyer.inputs
    assert list(flyer.inputs) == list(m.inputs) and len(flyer.inputs) == 3
    assert dict(flyer.inputs) == {"rw_x.torque": 0.010, "rw_y.torque": -0.015, "rw_z.torque": 0.008}
    assert dict(flyer.inputs.items()) == dict(flyer.inputs)
    assert list(flyer.inputs.keys()) == list(m.inputs)
    assert list(flyer.inputs.values()) == [0.010, -0.015, 0.008]
    assert flyer.inputs.get("nothing") is None and flyer.inputs.get("nothing", 1) == 1
    import collections.abc

    assert isinstance(flyer.inputs, collections.abc.Mapping)
    assert "rw_x.torque" in repr(flyer.inputs)


def test_a_vector_is_three_numbers(engine):
    sim = pushed().simulate(engine)
    sim.inputs["push.force"] = [1, 2.0, "3 mN"]
    assert sim.inputs["push.force"].tolist() == [1.0, 2.0, 0.003]
    assert sim.inputs["push.force.y"] == 2.0
    sim.inputs["push.force"] = np.array([4.0, 5.0, 6.0])
    assert sim.inputs["push.force"].tolist() == [4.0, 5.0, 6.0]
    sim.inputs["push.force.z"] = 0
    assert sim.inputs["push.force"].tolist() == [4.0, 5.0, 0.0]
    assert "push.force" in sim.inputs and list(sim.inputs)[1] == "push.force.x"
    sim.inputs.release("push.force")
    assert sim.inputs["push.force"].tolist() == [0.0, 0.0, 0.0]
    sim.inputs["push.force"] = (1, 0, 0)
    sim.run_until(10.0)
    assert sim.observe()["v_CN_N"][0] > 0.05


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("rw_q.torque", 1.0), (3, 1.0), ("rw_x", 1.0),
        ("w.torque", math.nan), ("w.torque", math.inf), ("w.torque", "1 kg"),
        ("w.torque", "much"), ("w.torque", None), ("w.torque", [1.0, 2.0]), ("w.torque", 1j),
        ("push.force", 1.0), ("push.force", [1.0, 2.0]), ("push.force", "1 N"),
        ("push.force", [1.0, 2.0, math.nan]), ("push.force", np.ones((3, 2))),
        ("push.force", [1.0, 2.0, "3 kg"]), ("push.force", None), ("push.force", {1, 2, 3}),
    ],
)
def test_what_is_no_input_is_refused_where_it_is_set(name, value):
    sim = pushed().simulate()
    before = dict(sim.inputs)
    with pytest.raises(tc.InputError) as caught:
        sim.inputs[name] = value
    assert isinstance(caught.value, (KeyError, ValueError))
    assert isinstance(caught.value, KeyError) and isinstance(caught.value, ValueError)
    assert not str(caught.value).startswith(("'", '"'))
    assert dict(sim.inputs) == before


def test_an_unknown_name_has_the_near_miss(flyer):
    with pytest.raises(KeyError, match="rw_x.torque"):
        flyer.inputs["rw_x.torqe"]
    with pytest.raises(tc.InputError, match="rw_x.torque"):
        flyer.inputs.release("rw_x.torqe")


def test_an_update_is_all_or_none(flyer):
    with pytest.raises(tc.InputError):
        flyer.inputs.update({"rw_x.torque": 1.0, "rw_y.torque": math.nan})
    assert flyer.inputs["rw_x.torque"] == 0.010
    flyer.inputs.update({"rw_x.torque": 1.0, "rw_y.torque": 2.0})
    assert list(flyer.inputs.values()) == [1.0, 2.0, 0.008]


def test_inputs_keep_their_simulation(m):
    inputs = m.simulate().inputs
    assert inputs["rw_x.torque"] == 0.010


# --- control


def test_ticks_are_start_plus_k_every(flyer):
    flyer.run_until(0.01)
    seen, asked = [], []
    flyer.run_until(
        0.5, every=0.15, controller=lambda t, y: seen.append(t),
        stop=lambda t, y: asked.append(t),
    )
    assert seen == pytest.approx([0.01, 0.16, 0.31, 0.46], abs=1e-15)
    assert asked == [*seen, 0.5]


def test_without_a_period_ticks_are_step_ends(flyer):
    seen = []
    flyer.run_until(0.1, controller=lambda t, y: seen.append(t))
    assert seen == [0.0, 0.02, 0.04, 0.06, 0.08]


def test_stop_is_asked_first_and_ends(flyer):
    calls = []
    reached = flyer.run_until(
        1.0, every=0.1, controller=lambda t, y: calls.append(("controller", t)),
        stop=lambda t, y: calls.append(("stop", t)) or t >= 0.2,
    )
    assert reached == flyer.time == pytest.approx(0.2)
    assert [name for name, _ in calls] == ["stop", "controller", "stop", "controller", "stop"]


def test_a_stop_may_be_of_numpy(flyer):
    assert flyer.run_until(1.0, every=0.1, stop=lambda t, y: y["omega_BN_B"][0] > -1.0) == 0.0


def test_a_controller_drives_what_it_answers(flyer):
    flyer.run_until(0.1, every=0.05, controller=lambda t, y: {"rw_x.torque": t + 1.0})
    assert dict(flyer.inputs) == {"rw_x.torque": 1.05, "rw_y.torque": -0.015, "rw_z.torque": 0.008}
    flyer.run_until(0.2, every=0.05, controller=lambda t, y: None)
    flyer.run_until(0.3, every=0.05, controller=lambda t, y: {})
    assert flyer.inputs["rw_x.torque"] == 1.05


def test_a_controller_sees_what_observe_gives(flyer):
    def controller(t, y):
        other = flyer.observe()
        assert t == flyer.time and list(y) == list(other)
        assert all(np.array_equal(y[name], other[name]) for name in y)

    flyer.run_until(0.1, controller=controller)


def test_an_answer_may_have_texts_and_vectors():
    sim = pushed().simulate()
    sim.run_until(1.0, every=0.5, controller=lambda t, y: {
        "w.torque": "1 mN m", "push.force": y["r_BN_N"] + 1.0})
    assert sim.inputs["w.torque"] == 0.001
    assert sim.inputs["push.force"].shape == (3,)


@pytest.mark.parametrize(
    ("answer", "error"),
    [
        ({"rw_x.torque": 1.0, "rw_q.torque": 1.0}, tc.InputError),
        ({"rw_x.torque": 1.0, "rw_y.torque": math.nan}, tc.InputError),
        ({"rw_x.torque": 1.0, 7: 1.0}, tc.InputError),
        ([1.0], TypeError),
        (1.0, TypeError),
    ],
)
def test_an_answer_is_checked_before_anything_is_driven(flyer, answer, error):
    with pytest.raises(error):
        flyer.run_until(1.0, every=0.1, controller=lambda t, y: answer if t > 0.15 else None)
    assert flyer.time == pytest.approx(0.2)
    assert flyer.inputs["rw_x.torque"] == 0.010
    flyer.run_until(0.3)


@pytest.mark.parametrize("role", ["controller", "stop"])
def test_what_a_callback_raises_comes_through(flyer, role):
    class Own(Exception):
        pass

    def callback(t, y):
        if t > 0.15:
            raise Own("mine")

    with pytest.raises(Own, match="mine") as caught:
        flyer.run_until(1.0, every=0.1, **{role: callback})
    assert any(entry.name == "callback" for entry in caught.traceback)
    assert flyer.time == pytest.approx(0.2)
    flyer.run_until(1.0)


@pytest.mark.parametrize("role", ["controller", "stop"])
def test_a_callback_must_be_callable(flyer, role):
    with pytest.raises(TypeError):
        flyer.run_until(1.0, **{role: 3})


@pytest.mark.parametrize("move", ["step", "run_until", "reset", "restore"])
def test_a_callback_cannot_move(flyer, move):
    arguments = {"step": (1,), "run_until": (1.0,), "reset": (), "restore": (flyer.snapshot(),)}
    with pytest.raises(RuntimeError, match="on its way"):
        flyer.run_until(
            1.0, every=0.1, controller=lambda t, y: getattr(flyer, move)(*arguments[move]))
    assert flyer.time == 0.0
    flyer.step()


def test_a_callback_may_drive_by_itself(flyer):
    def controller(t, y):
        flyer.inputs["rw_x.torque"] = 0.25

    flyer.run_until(0.1, controller=controller)
    assert flyer.inputs["rw_x.torque"] == 0.25


def test_controllers_give_the_bytes_of_driving_by_hand(m, engine):
    law = lambda y: {"rw_x.torque": 2.0 * y["omega_BN_B"][0]}  # noqa: E731
    one, two = m.simulate(engine), m.simulate(engine)
    one.run_until(2.0, every=0.1, controller=lambda t, y: law(y))
    for k in range(20):
        two.inputs.update(law(two.observe()))
        two.run_until(2.0 if k == 19 else 0.0 + (k + 1) * 0.1)
    assert bytes_of(one) == bytes_of(two)


# --- schedules


def recorded(model: tc.Model, engine: str, end: float):
    """(time, inputs) at every step end, and the state at the end."""
    sim, record = model.simulate(engine), []
    sim.run_until(end, controller=lambda t, y: record.append((t, dict(sim.inputs))))
    return record, bytes_of(sim), sim.snapshot()


@pytest.mark.parametrize(
    ("name", "end"),
    [
        ("quickstart", 5.0), ("paper/torque", 30.0), ("paper/rw_panels", 5.0),
        ("paper/variable_mass", 20.0), ("nesc/case_9a", 30.0), ("gallery/branched_arm", 2.0),
    ],
)
def test_a_schedule_fed_live_gives_the_bytes_of_the_scheduled_run(name, end, engine):
    model = tc.load(ROOT / "models" / f"{name}.yaml")
    record, expected, _ = recorded(model, engine, end)
    sim = model.simulate(engine)
    acting = {}
    for t, inputs in record:
        if inputs == acting:
            continue
        sim.run_until(t)
        sim.inputs.update(inputs)
        acting = inputs
    sim.run_until(end)
    assert bytes_of(sim) == expected


def test_a_schedule_that_the_model_lacks_is_fed_live_off_the_grid(engine):
    times = [(0.0, 0.01), (0.333, -0.02), (1.05, 0.03), (7.0, 0.0)]
    scheduled = pushed(torque="[" + ", ".join(f"[{t} s, {u} N m]" for t, u in times) + "]")
    one, two = scheduled.simulate(engine), pushed().simulate(engine)
    one.run_until(10.0)
    for t, u in times:
        two.run_until(t)
        two.inputs["w.torque"] = u
    two.run_until(10.0)
    assert bytes_of(one) == bytes_of(two)


def test_released_it_follows_the_schedule_as_it_stands_by_then():
    sim = pushed(torque="[[0 s, 0.01 N m], [1 s, 0.02 N m]]").simulate()
    sim.inputs["w.torque"] = 0.0
    sim.run_until(2.0)
    assert sim.inputs["w.torque"] == 0.0
    sim.inputs.release("w.torque")
    assert sim.inputs["w.torque"] == 0.02


# --- snapshots and copies


def test_a_snapshot_resumes_to_the_bit(flyer):
    flyer.inputs["rw_x.torque"] = 0.05
    flyer.run_until(1.234)
    taken = flyer.snapshot()
    assert type(taken) is bytes
    flyer.run_until(3.0)
    expected = bytes_of(flyer)
    flyer.inputs.release("rw_x.torque")
    flyer.restore(taken)
    assert flyer.time == 1.234 and flyer.inputs["rw_x.torque"] == 0.05
    flyer.run_until(3.0)
    assert bytes_of(flyer) == expected


@pytest.mark.parametrize("name", ["quickstart", "paper/variable_mass", "gallery/tumble"])
def test_a_snapshot_resumes_in_another_process(name, engine, tmp_path):
    path = ROOT / "models" / f"{name}.yaml"
    sim = tc.load(path).simulate(engine)
    sim.step(33)
    (tmp_path / "snapshot").write_bytes(sim.snapshot())
    sim.step(44)
    done = python(
        "import sys, twincraft as tc; s = tc.load(sys.argv[1]).simulate(sys.argv[2]); "
        "s.restore(open(sys.argv[3], 'rb').read()); s.step(44); print(s.state.tobytes().hex())",
        str(path), engine, str(tmp_path / "snapshot"), check=True,
    )
    assert done.stdout.strip() == bytes_of(sim).hex()


def test_a_foreign_snapshot_is_refused_and_changes_nothing(m):
    sim = m.simulate()
    sim.step(10)
    before = sim.snapshot()
    damaged = bytearray(before)
    damaged[len(damaged) // 2] ^= 1
    for wrong in (
        b"", b"twincraft", before[:-1], bytes(damaged), m.simulate("mujoco").snapshot(),
        pushed().simulate().snapshot(), m.twin().snapshot(),
    ):
        with pytest.raises(tc.SnapshotError):
            sim.restore(wrong)
        assert sim.snapshot() == before
    with pytest.raises(TypeError):
        sim.restore("text")


@pytest.mark.parametrize("copier", [lambda s: s.copy(), copy.copy, copy.deepcopy])
def test_a_copy_goes_on_by_itself(flyer, copier):
    flyer.inputs["rw_y.torque"] = 0.1
    flyer.run_until(0.5)
    other = copier(flyer)
    assert type(other) is type(flyer) and other.model is flyer.model
    assert other.time == 0.5 and other.inputs["rw_y.torque"] == 0.1
    other.run_until(1.0)
    assert flyer.time == 0.5
    flyer.run_until(1.0)
    assert bytes_of(other) == bytes_of(flyer)


def test_a_reset_is_as_just_made(m, flyer):
    fresh = flyer.copy()
    flyer.inputs["rw_x.torque"] = 1.0
    flyer.step(50)
    flyer.reset()
    assert flyer.time == 0.0 and flyer.inputs["rw_x.torque"] == 0.010
    flyer.step(50), fresh.step(50)
    assert bytes_of(flyer) == bytes_of(fresh)


def test_it_outlives_its_model():
    sim = pushed().simulate()
    sim.step(10)
    assert sim.model.name == "pushed"


# --- failures


def failing() -> tc.Model:
    return pushed(torque="1 N m")


def test_a_numerical_failure_says_when_and_what(engine):
    sim = pushed().simulate(engine)
    sim.step(5)
    sim.inputs["w.torque"] = 1e308
    with pytest.raises(tc.NumericalError) as caught:
        sim.step(1000)
    error = caught.value
    assert isinstance(error, (tc.Error, ArithmeticError))
    assert error.time == sim.time >= 0.5
    assert isinstance(error.coordinate, str)
    assert np.isfinite(sim.state).all()
    sim.reset()
    sim.step(5)


def test_an_engine_stops_where_its_tank_is_empty():
    sim = tc.load(ROOT / "models" / "gallery" / "rocket.yaml").simulate()
    name = next(name for name in sim.inputs if name.endswith(".thrust"))
    sim.inputs[name] = sim.inputs[name] or 100.0
    sim.run_until(sim.model.duration * 50.0)
    assert sim.inputs[name] == 0.0
    assert np.isfinite(sim.state).all()


def test_it_shows_itself(flyer):
    assert "wheels_and_panels" in repr(flyer) and "t = 0.0 s" in repr(flyer)
