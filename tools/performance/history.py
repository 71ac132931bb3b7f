"""What each step of the work brought: tests/bench/history.json, a list of instruction counts."""

from __future__ import annotations

import json

import gate
import machine
from programs import ROOT, run

STORED = ROOT / "tests" / "bench" / "history.json"
COMMAND = "tools/benchmark --step TITLE [--of COMMIT]"


def steps() -> list[dict]:
    """From the oldest on: title, source and instructions by row."""
    return json.loads(STORED.read_text())["steps"] if STORED.exists() else []


def stored_in(commit: str) -> dict[str, float]:
    """The counts that the commit holds the gate to."""
    path = gate.STORED.relative_to(ROOT)
    return json.loads(run(["git", "show", f"{commit}:{path}"]))["instructions"]


def append(title: str, commit: str | None) -> int:
    """Measure the working tree, or take what a commit has stored."""
    if commit is None:
        source, counts = machine.revision(), gate.measured()
    else:
        source, counts = run(["git", "rev-parse", "--short", commit]).strip(), stored_in(commit)
    step = {"title": title, "source": source, "instructions": counts}
    content = {
        "what": "instructions of one RK4 step of the portable kernel after each step of the work",
        "command": COMMAND,
        "steps": [*steps(), step],
    }
    gate.write(STORED, json.dumps(content, indent=2) + "\n")
    print(f"{STORED.relative_to(ROOT)}: `{title}` is step {len(content['steps'])}")
    return 0
