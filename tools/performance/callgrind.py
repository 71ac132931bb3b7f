"""Reading what callgrind writes (strings and positions uncompressed)."""

from __future__ import annotations

import collections
import re
import subprocess

# (object, function, address or line) -> instructions executed there, calls excluded
Costs = collections.Counter

COST = re.compile(r"(0x[0-9a-f]+|\d+) (\d+)")
HEAP = re.compile(r"(malloc|calloc|realloc|free|_int_\w+|cfree|operator (new|delete).*)$")


def read(path: str) -> Costs:
    costs: Costs = collections.Counter()
    where = function = ""
    is_call = False  # the next cost is the callee's
    with open(path) as file:
        for line in file:
            if line.startswith("ob="):
                where = line[3:].strip()
            elif line.startswith("fn="):
                function = line[3:].strip()
            elif line.startswith("calls="):
                is_call = True
            elif match := COST.match(line):
                if not is_call:
                    costs[where, function, match[1]] += int(match[2])
                is_call = False
    return costs


def total(costs: Costs) -> int:
    return sum(costs.values())


def heap(costs: Costs) -> int:
    return sum(cost for (_, function, _), cost in costs.items() if HEAP.match(function))


def inlined(program: str, addresses: list[str]) -> dict[str, list[str]]:
    """Per address the functions it belongs to, innermost first, by the line tables."""
    command = ["addr2line", "-e", program, "-a", "-i", "-f", "-C"]
    done = subprocess.run(
        command, input="\n".join(addresses), capture_output=True, text=True, check=True
    )
    functions: dict[str, list[str]] = {}
    lines = iter(done.stdout.splitlines())
    for line in lines:
        if line.startswith("0x"):
            address = hex(int(line, 16))
            functions[address] = []
        else:
            functions[address].append(line)
            next(lines)  # file and line
    return functions
