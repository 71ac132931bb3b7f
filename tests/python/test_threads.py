"""Other threads of Python, signals, and memory."""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
import threading
import time

import pytest
from conftest import ROOT, SPEC, python

import twincraft as tc

LONG = 3_000_000  # steps: some seconds


def moves(m):
    """Calls that take a while, and what ends them early from another thread: nothing."""
    big = tc.load(SPEC, set={"simulation.duration": "2000 s"})
    return {
        "step": lambda: m.simulate().step(300_000),
        "run_until": lambda: m.simulate().run_until(6_000.0),
        "mujoco": lambda: m.simulate("mujoco").step(30_000),
        "twin": lambda: m.twin().run_until(500.0),
        "batch": lambda: tc.Batch(m, n=256, threads=1).step(2_000),
        "run": lambda: big.run(),
        "controller": lambda: m.simulate().run_until(
            2_000.0, every=1.0, controller=lambda t, y: None),
    }


@pytest.mark.parametrize(
    "name", ["step", "run_until", "mujoco", "twin", "batch", "run", "controller"])
def test_other_threads_go_on(m, name):
    move = moves(m)[name]
    ticks, done = 0, threading.Event()
    thread = threading.Thread(target=lambda: (move(), done.set()))
    thread.start()
    while not done.wait(0.001):
        ticks += 1
    thread.join()
    assert ticks >= 5


def test_in_use_by_another_thread_is_refused(m):
    sim, twin, batch = m.simulate(), m.twin(), tc.Batch(m, n=64, threads=1)
    for busy, move, calls in (
        (sim, lambda: sim.step(LONG // 3), [
            lambda: sim.step(), lambda: sim.run_until(1e9), lambda: sim.observe(),
            lambda: sim.state, lambda: sim.time, lambda: sim.snapshot(), lambda: sim.reset(),
            lambda: sim.copy(), lambda: sim.inputs["rw_x.torque"],
            lambda: sim.inputs.update({"rw_x.torque": 1.0})]),
        (twin, lambda: twin.step(100_000), [
            lambda: twin.step(), lambda: twin.disagreement, lambda: twin.bsm.observe(),
            lambda: twin.time]),
        (batch, lambda: batch.step(30_000), [lambda: batch.step(), lambda: batch.x]),
    ):
        thread = threading.Thread(target=move)
        thread.start()
        time.sleep(0.05)
        assert thread.is_alive()
        for call in calls:
            with pytest.raises(RuntimeError):
                call()
        thread.join()
        assert busy.time > 0.0


def test_a_model_is_shared_by_threads(m):
    results = []

    def fly():
        sim = m.simulate()
        sim.step(20_000)
        results.append(sim.state.tobytes())

    threads = [threading.Thread(target=fly) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 4 and len(set(results)) == 1


INTERRUPTED = """
import os, signal, sys, threading, time
import twincraft as tc
m = tc.load("models/quickstart.yaml", set={"simulation.duration": "1e6 s", "simulation.record": "1e4 s"})
sim, twin, batch = m.simulate(), m.twin(), tc.Batch(m, n=64)
mujoco = m.simulate("mujoco")
moves = {
    "step": lambda: sim.step(10**9),
    "run_until": lambda: sim.run_until(1e9),
    "controller": lambda: sim.run_until(1e9, every=100.0, controller=lambda t, y: None),
    "mujoco": lambda: mujoco.step(10**9),
    "twin": lambda: twin.run_until(1e9),
    "batch": lambda: batch.step(10**9),
    "run": lambda: m.run(),
}
def interrupt():
    time.sleep(0.3)
    os.kill(os.getpid(), signal.SIGINT)
signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job begins without
threading.Thread(target=interrupt).start()
begin = time.monotonic()
try:
    moves[sys.argv[1]]()
except KeyboardInterrupt:
    print("interrupted", time.monotonic() - begin < 20)
used = {"mujoco": mujoco, "twin": twin, "batch": batch}.get(sys.argv[1], sim)
before = used.time
used.step(1)
print("usable", used.time > before or before == 0, (before > 0) == (sys.argv[1] != "run"))
"""


@pytest.mark.parametrize(
    "name", ["step", "run_until", "controller", "mujoco", "twin", "batch", "run"])
def test_ctrl_c_ends_at_a_step_end(name):
    done = python(INTERRUPTED, name, timeout=120)
    assert done.stdout == "interrupted True\nusable True True\n", done.stderr


def test_a_handler_that_raises_comes_through(m):
    class Alarm(Exception):
        pass

    def handler(number, frame):
        raise Alarm

    previous = signal.signal(signal.SIGALRM, handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        with pytest.raises(Alarm):
            m.simulate().step(10**9)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)


# --- memory


def resident() -> int:
    """Kilobytes."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") // 1024


MANY = int(os.environ.get("TWINCRAFT_MANY", "1"))


def grows(work, count: int) -> int:
    """Kilobytes by which the process grows over `count` times `work`, once it is warm."""
    for _ in range(max(count // 5, 3)):
        work()
    gc.collect()
    before = resident()
    for _ in range(count):
        work()
    gc.collect()
    return resident() - before


@pytest.mark.parametrize("name", ["bsm", "mujoco", "twin"])
def test_resets_leak_nothing(m, name):
    flyer = m.twin() if name == "twin" else m.simulate(name)

    def work():
        flyer.inputs["rw_x.torque"] = 0.1
        flyer.step(2)
        flyer.reset()

    assert grows(work, (5_000 if name == "twin" else 100_000 if name == "bsm" else 10_000) * MANY) < 1_000


def test_calls_leak_nothing(m):
    sim, twin, batch = m.simulate(), m.twin(), tc.Batch(m, n=4)

    def raising(t, y):
        raise LookupError

    def work():
        sim.observe(), sim.state, dict(sim.inputs), twin.disagreement, twin.bsm.observe()
        sim.restore(sim.snapshot()), sim.copy(), twin.copy()
        sim.run_until(sim.time + 0.1, controller=lambda t, y: {"rw_x.torque": "1 mN m"})
        for wrong in (
            lambda: sim.inputs.update({"nothing": 1.0}), lambda: sim.step(0),
            lambda: sim.run_until(1e9, controller=raising), lambda: sim.restore(b"no"),
        ):
            try:
                wrong()
            except Exception:
                pass
        batch.u = batch.u
        batch.x = batch.x
        batch.step(1)
        batch.y, batch.status

    assert grows(work, 1_000 * MANY) < 2_000


def test_models_leak_nothing():
    def work():
        model = tc.load(SPEC)
        model.simulate().step(1)
        model.simulate("mujoco").step(1)
        try:
            tc.loads("format: spacecraft/1\nname: x\n")
        except tc.SpecError:
            pass

    assert grows(work, 100 * MANY) < 8_000


def test_nothing_is_left_at_exit():
    done = python(
        "import twincraft as tc; m = tc.load('models/quickstart.yaml'); s = m.simulate(); "
        "t = m.twin(); b = t.bsm; i = s.inputs; s.step(3)")
    assert (done.returncode, done.stderr) == (0, "")
