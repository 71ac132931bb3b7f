"""Reading what callgrind writes (strings and positions uncompressed)."""

from __future__ import annotations

import collections
import dataclasses
import re
import subprocess

# (object, function, address or line) -> instructions executed there, calls excluded
Costs = collections.Counter

COST = re.compile(r"(0x[0-9a-f]+|\d+) (\d+)")
CALLS = re.compile(r"calls=(\d+)")
HEAP = re.compile(r"(malloc|calloc|realloc|free|cfree|operator (new|delete).*)$")


@dataclasses.dataclass(frozen=True)
class Profile:
    costs: Costs
    heap_calls: int  # of the heap's functions: how long these take depends on what was done before


def read(path: str) -> Profile:
    costs: Costs = collections.Counter()
    heap_calls = 0
    where = function = callee = ""
    is_call = False  # the next cost is the callee's
    with open(path) as file:
        for line in file:
            if line.startswith("ob="):
                where = line[3:].strip()
            elif line.startswith("fn="):
                function = line[3:].strip()
            elif line.startswith("cfn="):
                callee = line[4:].strip()
            elif calls := CALLS.match(line):
                is_call = True
                if HEAP.match(callee):
                    heap_calls += int(calls[1])
            elif match := COST.match(line):
                if not is_call:
                    costs[where, function, match[1]] += int(match[2])
                is_call = False
    return Profile(costs, heap_calls)


def total(profile: Profile) -> int:
    return sum(profile.costs.values())


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
