"""VALIDATION.md: the summary, then one section per scenario."""

from __future__ import annotations

import textwrap

from verdict import (
    DIFFERS, EXCEEDED, HOLDS, NOT_JUDGED, REPRODUCED, SMALLER, Row, Section,
)  # fmt: skip

HEAD = """\
# Validation

Every number published in *Comparing Backsubstitution and MuJoCo-Based Spacecraft Dynamics in
Basilisk*, beside ours. "Ours, the paper's way" sets up the two engines as the paper did, with the
differences of their machines left in; "ours, exact" compiles one machine for both. The models are
in `models/paper`, the published numbers in `tools/paper/published.json`. Then both engines beside
truths computed elsewhere.
"""

RULES = """\
| verdict | means |
|---|---|
| reproduced | ours, the paper's way, is within 10 % of the published number; orders within 0.02 and ratios of turns within 0.001; where rounding makes the number, within a factor of ten; a published bound holds |
| smaller | rounding makes the published number, and ours is more than ten times smaller |
| not judged | the number is of one processor and one build of MuJoCo, or the paper gives none |
| **differs** | none of these |
| holds | ours, exact, is within its bound |
"""


def number(value: float | None) -> str:
    """Three digits, in the plainest form."""
    if value is None:
        return "-"
    if value == 0:
        return "0"
    if 1e-2 <= abs(value) < 1e5:
        return f"{value:.4g}"
    digits, exponent = f"{value:.2e}".split("e")
    return f"{digits}e{int(exponent)}"


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def cells_of(row: Row, mark: str) -> list[str]:
    unit = f" [{row.unit}]" if row.unit else ""

    def shown(value: float | None) -> str:
        if value is None or row.decimals is None:
            return number(value)
        return f"{value:.{row.decimals}f}"

    published = row.says or ("at most " if row.less else "") + shown(row.published)
    bound = "" if row.bound is None else number(row.bound)
    exact = shown(row.exact) if row.exact is not None else ""
    ours = shown(row.paper)
    return [row.what + unit + mark, published, ours, row.verdict, exact, bound, row.bound_verdict]


def bounds_of(section: Section) -> str:
    lines = []
    for row in section.rows:
        unit = f" [{row.unit}]" if row.unit else ""
        lines.append([row.what + unit, number(row.exact), number(row.bound), row.bound_verdict])
    return table(["quantity", "ours", "bound", ""], lines)


def rows_of(section: Section) -> str:
    """The table, and below it what there is to say of its rows, each remark once."""
    if all(row.published is None and not row.says for row in section.rows):
        return bounds_of(section)
    notes: list[str] = []
    lines = []
    for row in section.rows:
        mark = ""
        if row.note:
            if row.note not in notes:
                notes.append(row.note)
            mark = f" ({notes.index(row.note) + 1})"
        lines.append(cells_of(row, mark))
    head = ["quantity", "published", "ours, the paper's way", "verdict", "ours, exact", "bound", ""]
    text = table(head, lines)
    if notes:
        text += "\n\n" + "\n".join(
            paragraph(f"({i}) {note[0].upper()}{note[1:]}.") + "\n"
            for i, note in enumerate(notes, 1)
        )
    return text.rstrip()


def paragraph(text: str) -> str:
    return textwrap.fill(text, 100, break_long_words=False, break_on_hyphens=False)


def section_of(section: Section, index: int) -> str:
    blocks = [f"## {index} {section.title}", paragraph(section.text)]
    if section.failure:
        blocks.append(f"**Failed to run**: {' '.join(section.failure.split())}")
    if section.rows:
        blocks.append(rows_of(section))
    blocks += section.tables
    if section.figures:
        blocks.append("\n".join(f"- `figures/{f.file}`: {f.caption}" for f in section.figures))
    return "\n\n".join(block for block in blocks if block)


def summary_of(sections: list[Section]) -> str:
    verdicts = (REPRODUCED, SMALLER, NOT_JUDGED, DIFFERS)
    rows = []
    totals = [0] * (len(verdicts) + 2)
    for index, section in enumerate(sections, 1):
        if not section.rows and not section.failure:
            continue  # nothing in it is judged
        counts = [section.count(verdict) for verdict in verdicts]
        counts += [section.count_bounds(verdict) for verdict in (HOLDS, EXCEEDED)]
        totals = [a + b for a, b in zip(totals, counts)]
        name = f"{index} {section.title}" + (" (**failed to run**)" if section.failure else "")
        rows.append([name, *(str(count) for count in counts)])
    rows.append(["all", *(str(count) for count in totals)])
    head = ["section", "reproduced", "smaller", "not judged", "differs", "bound holds", "exceeded"]
    return table(head, rows) + "\n\n" + paragraph(sentence_of(totals))


def sentence_of(totals: list[int]) -> str:
    reproduced, smaller, unjudged, differs, holds, exceeded = totals
    return (
        f"Of {sum(totals[:4])} published numbers {reproduced} are reproduced, {smaller} are smaller "
        f"here, {unjudged} are not judged and {differs} differ. Of {holds + exceeded} bounds on one "
        f"exact machine {holds} hold."
    )


def provenance_of(provenance: dict, command: str) -> str:
    engines = f"MuJoCo {provenance.get('mujoco', '?')}, Eigen {provenance.get('eigen', '?')}"
    return "\n".join(
        (
            "| | |",
            "|---|---|",
            f"| made by | `{command}` |",
            f"| program | {provenance.get('program', '?')}; {engines} |",
            f"| compiler | {provenance.get('compiler', '?')}, `{provenance.get('flags', '?')}` |",
            f"| machine | {provenance.get('cpu', '?')}, {provenance.get('cores', '?')} cores |",
        )
    )


def document(sections: list[Section], provenance: dict, command: str, quick: bool) -> str:
    blocks = [HEAD.rstrip()]
    if quick:
        blocks.append("**This is a quick run**: shorter sets of runs, and single trials of cost.")
    blocks += [provenance_of(provenance, command), "## Summary", summary_of(sections), RULES.rstrip()]
    blocks += [section_of(section, index) for index, section in enumerate(sections, 1)]
    return "\n\n".join(blocks) + "\n"
