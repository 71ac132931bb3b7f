"""Published numbers beside ours, and what to say of them. The numbers are in published.json."""

from __future__ import annotations

import json
import math
import pathlib
from dataclasses import dataclass, field

_DATA = json.loads((pathlib.Path(__file__).parent / "published.json").read_text())
PUBLISHED = _DATA["numbers"]
PUBLISHED_COST = _DATA["cost"]  # of the paper's machine: shown, never judged

REPRODUCED = "reproduced"
SMALLER = "smaller"
NOT_JUDGED = "not judged"
DIFFERS = "**differs**"
HOLDS = "holds"
EXCEEDED = "**exceeded**"
VERDICTS = (REPRODUCED, SMALLER, NOT_JUDGED, DIFFERS)


def within(ours: float, published: float, tolerance: float = 0.1) -> str:
    return REPRODUCED if abs(ours - published) <= tolerance * abs(published) else DIFFERS


def near(ours: float, published: float, tolerance: float) -> str:
    return REPRODUCED if abs(ours - published) <= tolerance else DIFFERS


def magnitude(ours: float, published: float) -> str:
    """Of rounding: within a factor of ten, or smaller still."""
    if not ours <= 10 * published:
        return DIFFERS
    return REPRODUCED if ours >= published / 10 else SMALLER


def below(ours: float, published: float) -> str:
    return REPRODUCED if ours <= published else DIFFERS


def exact(ours: float, published: float) -> str:
    return REPRODUCED if ours == published else DIFFERS


def unjudged(ours: float, published: float) -> str:
    return NOT_JUDGED


RULES = {
    "within": within,
    "near": near,
    "magnitude": magnitude,
    "below": below,
    "exact": exact,
    "build": unjudged,
}


@dataclass
class Row:
    what: str
    unit: str
    published: float | None  # None: not published
    paper: float | None  # ours, the paper's way
    exact: float | None  # ours, the exact way
    verdict: str
    bound: float | None = None  # of the exact way
    bound_verdict: str = ""
    note: str = ""
    less: bool = False  # the published number is a bound
    says: str = ""  # in words, where the paper gives no number
    decimals: int | None = None  # written so, where the usual digits would hide it


@dataclass
class Figure:
    file: str
    caption: str


@dataclass
class Section:
    title: str
    text: str = ""
    rows: list[Row] = field(default_factory=list)
    figures: list[Figure] = field(default_factory=list)
    tables: list[str] = field(default_factory=list)  # Markdown, below the rows
    failure: str = ""  # why there is no result

    def add(self, key: str, paper: float | None, exact: float | None = None) -> None:
        """The published number `key` beside ours."""
        entry = PUBLISHED[key]
        options = [entry["tolerance"]] if "tolerance" in entry else []
        published = entry["published"]
        ours = exact if paper is None else paper
        finite = ours is not None and math.isfinite(ours)
        verdict = RULES[entry["rule"]](ours, published, *options) if finite else DIFFERS
        row = Row(entry["what"], entry["unit"], published, paper, exact, verdict)
        row.less = entry["rule"] == "below"
        row.says = entry.get("says", "")
        row.decimals = entry.get("decimals")
        row.note = entry.get("note", "")
        if "bound" in entry and exact is not None:
            row.bound = entry["bound"]
            row.bound_verdict = HOLDS if exact <= row.bound else EXCEEDED
        self.rows.append(row)

    def bound(self, what: str, unit: str, ours: float, bound: float) -> None:
        """A number of ours that was not published, below its bound."""
        row = Row(what, unit.replace("_", "/"), None, None, ours, "", bound)
        row.bound_verdict = HOLDS if ours <= bound else EXCEEDED
        self.rows.append(row)

    def figure(self, name: str, caption: str) -> None:
        self.figures.append(Figure(f"{name}.svg", caption))

    def count(self, verdict: str) -> int:
        return sum(row.verdict == verdict for row in self.rows)

    def count_bounds(self, verdict: str) -> int:
        return sum(row.bound_verdict == verdict for row in self.rows)

    @property
    def fails(self) -> bool:
        return bool(self.failure) or self.count(DIFFERS) > 0 or self.count_bounds(EXCEEDED) > 0
