"""Many at a time."""

from __future__ import annotations

import math

import numpy as np
import pytest
from conftest import pushed

import twincraft as tc


def test_shapes_and_orders(m):
    batch = tc.Batch(m, n=5)
    assert batch.x.shape == (5, len(m.states)) and batch.u.shape == (5, 3)
    assert batch.y.shape == (5, len(m.outputs)) and batch.status.shape == (5,)
    assert batch.status.dtype == np.int32 and batch.x.dtype == np.float64
    assert batch.x.flags.c_contiguous and batch.n == 5 and batch.model is m
    assert np.array_equal(batch.u[3], [0.010, -0.015, 0.008])


def test_members_fly_as_simulations(m):
    batch, sim = tc.Batch(m, n=9), m.simulate()
    batch.step(500), sim.step(500)
    assert batch.time == sim.time == 10.0
    outputs = np.concatenate([np.atleast_1d(v) for v in sim.observe().values()])
    for i in range(9):
        assert np.allclose(batch.x[i], sim.state, rtol=1e-12, atol=1e-13)
        assert np.allclose(batch.y[i], outputs, rtol=1e-12, atol=1e-12)
    assert len({row.tobytes() for row in batch.x}) == 1


@pytest.mark.parametrize("threads", [1, 2, 3, None])
def test_the_bytes_are_the_same_for_any_number_of_threads(m, threads):
    rng = np.random.default_rng(7)
    inputs = rng.normal(0.0, 0.01, (17, 3))

    def flown(count):
        batch = tc.Batch(m, n=17, threads=count)
        batch.u = inputs
        batch.step(200)
        return batch.x.tobytes() + batch.y.tobytes()

    assert flown(threads) == flown(1)


def test_arrays_are_read_only_copies(m):
    batch = tc.Batch(m, n=2)
    for array in (batch.x, batch.u, batch.y, batch.status):
        with pytest.raises(ValueError):
            array[0] = 1.0
    x, kept = batch.x, batch.x.copy()
    batch.step(10)
    assert np.array_equal(x, kept)


def test_states_are_set_at_the_batchs_time(m):
    batch = tc.Batch(m, n=3)
    batch.step(10)
    sim = m.simulate()
    sim.step(25)
    batch.x = sim.state
    assert batch.time == 0.2
    assert np.allclose(batch.x, np.tile(sim.state, (3, 1)), rtol=1e-15, atol=1e-18)
    rows = np.tile(sim.state, (3, 1))
    rows[1, list(m.states).index("omega_BN_B.x")] = 0.5
    batch.x = rows
    assert batch.x[1, list(m.states).index("omega_BN_B.x")] == 0.5


def test_inputs_are_driven_and_given_back():
    model = pushed(torque="[[0 s, 0.01 N m], [1 s, 0.02 N m]]")
    batch = tc.Batch(model, n=2)
    assert list(model.inputs)[0] == "w.torque"
    batch.u = [5, 0, 0, 0, 0, 0, 0][: len(model.inputs)]
    assert batch.u[1, 0] == 5.0
    batch.u = None
    assert batch.u[1, 0] == 0.01
    batch.step(15)
    assert batch.u[1, 0] == 0.02


@pytest.mark.parametrize(
    "rows",
    [[1.0], [[1.0, 2.0, 3.0]] * 4, np.zeros((3, 2)), [math.nan, 0, 0], [math.inf, 0, 0], "text",
     [1j, 0, 0], [[1.0], [1.0, 2.0]], 1.0, ["1 N m", "0", "0"], [None, 0, 0]],
)
def test_rows_that_do_not_fit_are_refused(m, rows):
    batch = tc.Batch(m, n=3)
    x, u = batch.x, batch.u
    with pytest.raises(tc.InputError):
        batch.u = rows
    with pytest.raises(tc.InputError):
        batch.x = rows
    assert np.array_equal(batch.x, x) and np.array_equal(batch.u, u)


def test_other_number_types_and_orders_are_converted(m):
    batch = tc.Batch(m, n=3)
    rows = np.asfortranarray(np.arange(9, dtype=np.float32).reshape(3, 3))
    batch.u = rows
    assert np.array_equal(batch.u, rows)
    batch.u = rows[::-1]
    assert np.array_equal(batch.u, rows[::-1])


def test_a_member_that_fails_ends_alone(m):
    batch, others = tc.Batch(m, n=10), tc.Batch(m, n=10)
    rows = np.tile(batch.u[0], (10, 1))
    rows[4] = 1e308
    batch.u = rows
    batch.step(200), others.step(200)
    assert batch.status.tolist() == [0] * 4 + [4] + [0] * 5
    assert np.isnan(batch.x[4]).all() and np.isnan(batch.y[4]).all()
    keep = np.arange(10) != 4
    assert batch.x[keep].tobytes() == others.x[keep].tobytes()
    assert batch.reason(4) and not batch.reason(3)
    batch.u = None
    batch.x = m.simulate().state
    assert batch.status.tolist() == [0] * 10
    batch.step(10)
    assert np.isfinite(batch.x).all()


@pytest.mark.parametrize("arguments", [{"n": 0}, {"n": -1}, {"n": 2, "threads": 0}])
def test_no_members_and_no_threads_are_refused(m, arguments):
    with pytest.raises(ValueError):
        tc.Batch(m, **arguments)


def test_no_steps_are_refused(m):
    batch = tc.Batch(m, n=2)
    for n in (0, -1):
        with pytest.raises(ValueError):
            batch.step(n)
    with pytest.raises(IndexError):
        batch.reason(2)


def test_it_shows_itself(m):
    assert "2" in repr(tc.Batch(m, n=2))
