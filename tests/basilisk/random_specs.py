"""Random vehicles as specs to fly: random_specs.py COUNT SEED flies some and says what differs.

tools/random-vehicles --basilisk builds the programs and runs this."""

from __future__ import annotations

import math
import os
import re
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import flights


def write(folder: Path, count: int, seed: int) -> None:
    folder.mkdir(parents=True)
    flights.run(flights.PROGRAMS / "random_vehicles", "--write", folder, "--count", count, "--seed", seed)
    for spec in folder.iterdir():  # Basilisk has no use for a state to compare with, at which ours have a sample
        spec.write_text(re.sub(r"^references: .*\n|^stored:\n(  .*\n)+", "", spec.read_text(), flags=re.M))


def grid(spec: Path) -> tuple[str, ...]:
    """Settings for 400 steps of whole nanoseconds, in no more than 4 s, for what swings freely soon
    makes much of its rounding. Methods that add to all that swings have less time, and adaptive ones,
    which divide their steps, fewer of them."""
    text = spec.read_text()
    duration = float(re.search(r"^  duration: (\S+)$", text, flags=re.M)[1])  # [s]
    tenths = 5 if re.search("integrator: (euler|rk2)", text) else min(40, math.ceil(10 * duration))
    steps = 40 if "integrator: rkf" in text else 400
    return (f"simulation.duration={tenths / 10}", f"simulation.step={tenths / 10 / steps:.6g}",
            f"simulation.record={tenths / 200:.6g}")


def fly(spec: Path) -> flights.Flight:
    return flights.fly(spec, spec.with_suffix(""), *grid(spec))


def main(count: int, seed: int) -> int:
    folder = flights.ROOT / "build" / "release" / "random" / "basilisk"
    shutil.rmtree(folder, ignore_errors=True)
    write(folder, count, seed)
    tally, failed = flights.Tally(), 0

    def hunt(spec: Path) -> tuple[Path, flights.Flight | None, object]:
        try:
            flight = fly(spec)
            return spec, flight, flight.faults
        except AssertionError as fault:
            return spec, None, fault

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for spec, flight, faults in pool.map(hunt, sorted(folder.iterdir())):
            if flight:
                tally.add(spec.stem, flight)
            if faults:
                failed += 1
                print(f"{spec}: {faults}", flush=True)
            else:
                spec.unlink()
                shutil.rmtree(spec.with_suffix(""))
    print(*tally.lines(), f"{count} vehicles from seed {seed}, {failed} failed", sep="\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2])))
