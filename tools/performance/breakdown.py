"""Where the time goes: instructions of a step by what they are for."""

from __future__ import annotations

import collections
import re

import callgrind
from cases import Case
from programs import STEPS, counted_run

# The first that matches an instruction's functions, innermost first, is what it is for.
PHASES = [
    ("sines and cosines", r"sincos|trigo_reducer|sine_cosine"),
    ("chains: angles, rates, places", r"::Chain<.*>::move\("),
    ("chains: elimination, leaf to root", r"::Chain<.*>::(law_about_root|contribute)\b"),
    ("chains: accelerations, root to leaf", r"::Chain<.*>::recover\("),
    ("limbs: their laws moved to the hub", r"::Limb<|::Law<.*>::add_moved\("),
    ("attitude chart", r"::(Mrp|Quaternion)<"),
    ("hub: its equation and solution", r"::Vehicle<|VehicleKernel<"),
    ("integrator", r"RungeKutta::"),
    ("engine and run loop", r"BsmEngine|Landings|::Run::|propagate_bare|EngineOde"),
]
OTHER = "other"


def phase(functions: list[str]) -> str:
    for function in functions:
        for name, pattern in PHASES:
            if re.search(pattern, function):
                return name
    return OTHER


def shares(case: Case, engine: str, fewer: int, more: int) -> list[tuple[str, float]]:
    """Per phase its share of a step's instructions, largest first."""
    ours = str(STEPS)
    costs = counted_run(case, engine, more, by_instruction=True).costs
    costs.subtract(counted_run(case, engine, fewer, by_instruction=True).costs)
    stacks = callgrind.inlined(ours, [at for where, _, at in costs if where == ours])
    by_phase: collections.Counter = collections.Counter()
    for (where, function, at), cost in costs.items():
        stack = stacks[hex(int(at, 16))] if where == ours else []
        by_phase[phase([*stack, function])] += cost
    total = sum(by_phase.values())
    return [(name, cost / total) for name, cost in by_phase.most_common() if cost > 0]
