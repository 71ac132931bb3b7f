#!/usr/bin/env python3
"""MRP attitude feedback on the reaction wheels of models/quickstart.yaml, whose panels are flexible.

    python examples/python/mrp_feedback.py [SPEC] > trajectory.txt

The same controller is written in C and in C++ beside this one, and all three print the same bytes.
What they have to agree on:

- Vehicle: models/quickstart.yaml, as it is, flown by the analytic engine.
- Ticks every 0.1 s from t = 0, until t = 30 s.
- Law, from the outputs `q_BN` (w, x, y, z) and `omega_BN_B` [rad/s] at the tick:
      sigma_i  = q_i / (1 + q_w)                 MRPs of B relative to N, i = x, y, z
      torque_i = K * sigma_i + P * omega_i       K = 3.0 N m, P = 12.0 N m s
      u = axis_x * torque_x + axis_y * torque_y + axis_z * torque_z
  where u is what the motor puts on the wheel; the hub gets the opposite. The axes are those of the
  spec: rw_x (1, 0, 0), rw_y (0, 1, 0), rw_z (0, 0, 1). All operations are doubles, from left to
  right, none fused (a C compiler needs -ffp-contract=off).
- Output: one line per tick, before the inputs of that tick are driven, and a last one at the end:
  the time, then all states in the order of the model's states, separated by one blank, each with
  all digits as float.hex() prints it; in C that is "%.13a", but 0x0.0p+0 for zero.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import twincraft as tc

K = 3.0  # [N m]
P = 12.0  # [N m s]
EVERY = 0.1  # [s]
UNTIL = 30.0  # [s]
AXES = {"rw_x": (1.0, 0.0, 0.0), "rw_y": (0.0, 1.0, 0.0), "rw_z": (0.0, 0.0, 1.0)}


def torques(q: list[float], omega: list[float]) -> dict[str, float]:
    """Torque of every wheel's motor [N m]."""
    w, *vector = q
    torque = [K * (vector[i] / (1.0 + w)) + P * omega[i] for i in range(3)]
    return {
        f"{wheel}.torque": axis[0] * torque[0] + axis[1] * torque[1] + axis[2] * torque[2]
        for wheel, axis in AXES.items()
    }


def main(spec: str) -> None:
    sim = tc.load(spec).simulate()

    def write() -> None:
        print(*map(float.hex, [sim.time, *sim.state.tolist()]))

    def controller(t: float, y: dict[str, Any]) -> dict[str, float]:
        write()
        return torques(y["q_BN"].tolist(), y["omega_BN_B"].tolist())

    sim.run_until(UNTIL, every=EVERY, controller=controller)
    write()


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else str(Path(__file__).parents[2] / "models/quickstart.yaml"))
