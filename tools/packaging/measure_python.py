"""What the Python package costs beside the engines, for docs/python.md. Best of several, in ns.

    PYTHONPATH=build/release/python build/venv/bin/python tools/packaging/measure_python.py [--rate X]

With --rate the batch is held against X million member-steps a second of the C++ interface.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path

import twincraft as tc

SPEC = Path(__file__).parents[2] / "models" / "quickstart.yaml"


def best(work: Callable[[], object], count: int, trials: int = 15) -> float:
    """[ns] of one of the `count` things that `work` does."""
    times = []
    for _ in range(trials):
        begin = time.perf_counter_ns()
        work()
        times.append(time.perf_counter_ns() - begin)
    return min(times) / count


def loop(call: Callable[[], object], n: int = 20_000) -> Callable[[], None]:
    def work() -> None:
        for _ in range(n):
            call()

    return work


def main() -> None:
    m = tc.load(SPEC)
    sim = m.simulate()
    step, observe = sim.step, sim.observe
    inside = best(lambda: sim.step(20_000), 20_000)
    outside = best(loop(step), 20_000)
    print(f"step in step(n)        {inside:8.0f} ns")
    print(f"step(1) beside it      {outside - inside:8.0f} ns")
    print(f"observe()              {best(loop(observe), 20_000):8.0f} ns")

    answer = {"rw_x.torque": 0.01}

    def controller(t: float, y: dict[str, object]) -> dict[str, float]:
        return answer

    def ticked() -> None:
        sim.run_until(sim.time + 400.0, controller=controller)

    print(f"tick of a controller   {best(ticked, 20_000) - inside:8.0f} ns")
    inputs = sim.inputs
    print(f"inputs[name] = value   {best(loop(lambda: inputs.__setitem__('rw_x.torque', 0.01)), 20_000):8.0f} ns")

    n, steps = 4096, 100
    batch = tc.Batch(m, n=n, threads=2)
    per_step = best(lambda: batch.step(steps), n * steps, 7)
    print(f"batch of {n}, 2 threads {1e3 / per_step:6.2f} million member-steps a second")
    if "--rate" in sys.argv:
        rate = float(sys.argv[sys.argv.index("--rate") + 1])
        print(f"of the C++ interface's {100e3 / per_step / rate:6.0f} %")


if __name__ == "__main__":
    main()
