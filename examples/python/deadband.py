#!/usr/bin/env python3
"""A phase-plane controller that holds an attitude about z with thrusters, from a tank that drains.

    python examples/python/deadband.py

The error is angle + T * rate. Outside the deadband the pair of thrusters that turns it back fires at
full thrust until the next tick; inside, all are off, and the vehicle drifts.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import twincraft as tc

SPEC = Path(__file__).with_name("deadband.yaml")
THRUST = 1.0  # [N]
DEADBAND = math.radians(0.5)  # [rad]
LEAD = 20.0  # [s] T
EVERY = 0.25  # [s]
SETTLED, UNTIL = 150.0, 600.0  # [s]


def angle_about_z(q: Any) -> float:
    """Of a quaternion (w, x, y, z) [rad]."""
    return 2.0 * math.atan2(q[3], q[0])


def controller(t: float, y: dict[str, Any]) -> dict[str, float]:
    error = angle_about_z(y["q_BN"]) + LEAD * y["omega_BN_B"][2]
    plus = THRUST if error < -DEADBAND else 0.0
    minus = THRUST if error > DEADBAND else 0.0
    return {
        "plus_a.thrust": plus, "plus_b.thrust": plus,
        "minus_a.thrust": minus, "minus_b.thrust": minus,
    }


def main() -> None:
    sim = tc.load(SPEC).simulate()
    full = sim.observe()["mass"]
    sim.run_until(SETTLED, every=EVERY, controller=controller)
    print(f"settled with {full - sim.observe()['mass']:.4f} kg of propellant")
    worst = 0.0

    def watched(t: float, y: dict[str, Any]) -> dict[str, float]:
        nonlocal worst
        worst = max(worst, abs(angle_about_z(y["q_BN"])))
        return controller(t, y)

    sim.run_until(UNTIL, every=EVERY, controller=watched)
    print(f"{full - sim.observe()['mass']:.4f} kg after {UNTIL:.0f} s")
    print(f"held within {math.degrees(worst):.2f} deg of 0")


if __name__ == "__main__":
    main()
