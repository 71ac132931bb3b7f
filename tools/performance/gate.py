"""The instruction counts that must not grow unseen: tests/bench/instructions.json."""

from __future__ import annotations

import json

import machine
from cases import GATED
from programs import ROOT, build, counts

STORED = ROOT / "tests" / "bench" / "instructions.json"
UPDATE = "tools/benchmark --counts --update"
ALLOWED = 0.02  # growth that a compiler's mood may cause
FEWER, MORE = 500, 2500  # steps


def measured() -> dict[str, float]:
    build("bench_steps")
    done = counts([(case, "portable") for case in GATED], FEWER, MORE)
    return {case.name: round(done[case.name, "portable"].instructions, 1) for case in GATED}


def write(path, text: str) -> None:
    temporary = path.with_suffix(".tmp")
    temporary.write_text(text)
    temporary.replace(path)


def update() -> int:
    content = {
        "what": "instructions of one RK4 step of the portable kernel, by callgrind",
        "command": UPDATE,
        "compiler": machine.compiler(),
        "instructions": measured(),
    }
    write(STORED, json.dumps(content, indent=2) + "\n")
    print(f"{STORED.relative_to(ROOT)} written")
    return 0


def check() -> int:
    stored = json.loads(STORED.read_text())
    now = measured()
    print(f"{'instructions per RK4 step':28}{'stored':>10}{'now':>10}{'':>4}change")
    grown = False
    for name, count in now.items():
        before = stored["instructions"].get(name)
        if before is None:
            print(f"{name:28}{'-':>10}{count:10.1f}    not stored")
            grown = True
            continue
        change = count / before - 1.0
        grown = grown or change > ALLOWED
        verdict = "  MORE THAN ALLOWED" if change > ALLOWED else ""
        print(f"{name:28}{before:10.1f}{count:10.1f}    {100 * change:+.2f} %{verdict}")
    if not grown:
        return 0
    if stored["compiler"] != machine.compiler():
        print(f"stored by {stored['compiler']}, this is {machine.compiler()}")
    print(f"a step costs more than {100 * ALLOWED:.0f} % above what is stored; if it must: {UPDATE}")
    return 1
