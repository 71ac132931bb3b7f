"""The findings as one page of HTML without scripts: tables, and every difference over time."""

from __future__ import annotations

import math
from html import escape

import numpy as np
from chain import ROOT
from differences import Metric
from findings import Comparison, Findings
from race import fastest, ratios
from terminal import bound_text, shown, us, verdict_of

STYLE = ROOT / "runtime" / "report" / "page" / "web" / "style.css"
CURVES = {"bsm": ("Basilisk's BSM to our BSM", "bsm"), "mjscene": ("MJScene to our MuJoCo", "mujoco")}
WIDTH, HEIGHT, LEFT, BOTTOM, POINTS = 460, 200, 52, 22, 300


def thinned(times: np.ndarray, values: np.ndarray) -> list[tuple[float, float]]:
    """The largest of every bucket of time, so that no peak is lost."""
    chunks = np.array_split(np.arange(len(times)), min(POINTS, len(times)))
    rows = [chunk[np.argmax(values[chunk])] for chunk in chunks]
    return [(float(times[row]), float(values[row])) for row in rows]


def decades(found: list[Comparison], metric: Metric) -> tuple[int, int]:
    """That hold every positive value and the bounds."""
    values = [each.bounds[metric] for each in found if metric in each.bounds]
    for each in found:
        good = each.history[metric][np.isfinite(each.history[metric]) & (each.history[metric] > 0)]
        values += [float(good.min()), float(good.max())] if good.size else []
    if not values:
        return -17, -15
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return max(low, high - 14), max(high, low + 1)


def figure(found: Findings, metric: Metric) -> str:
    pairs = {half: pair for half, pair in found.pairs.items() if metric in pair.history}
    if not pairs:
        return ""
    low, high = decades(list(pairs.values()), metric)
    end = max(float(pair.times[-1]) for pair in pairs.values()) or 1.0

    def x(t: float) -> float:
        return LEFT + (WIDTH - LEFT - 6) * t / end

    def y(value: float) -> float:
        exponent = min(max(math.log10(value) if value > 0 else low, low), high)
        return 8 + (HEIGHT - BOTTOM - 8) * (high - exponent) / (high - low)

    parts = []
    for exponent in range(low, high + 1, max(1, (high - low) // 5)):
        at = y(10.0**exponent)
        parts.append(f'<line class="grid" x1="{LEFT}" x2="{WIDTH - 6}" y1="{at:.1f}" y2="{at:.1f}"/>')
        parts.append(f'<text x="{LEFT - 6}" y="{at + 4:.1f}" text-anchor="end">1e{exponent}</text>')
    for t in (0.0, end):
        anchor = "start" if t == 0 else "end"
        parts.append(f'<text x="{x(t):.1f}" y="{HEIGHT - 4}" text-anchor="{anchor}">{t:g} s</text>')
    for half, pair in pairs.items():
        colour = f"var(--{CURVES[half][1]})"
        finite = np.isfinite(pair.history[metric])
        places = thinned(pair.times[finite], pair.history[metric][finite]) if finite.any() else []
        line = " ".join(f"{x(t):.1f},{y(value):.1f}" for t, value in places)
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="1.5"/>')
        if metric in pair.bounds:
            at = y(pair.bounds[metric])
            parts.append(
                f'<line x1="{LEFT}" x2="{WIDTH - 6}" y1="{at:.1f}" y2="{at:.1f}" stroke="{colour}" '
                'stroke-dasharray="6 4"/>'
            )
    title = escape(f"{metric.name} [{metric.unit}]")
    return (
        f'<figure><figcaption>{title}</figcaption><svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        f'aria-label="{title}">{"".join(parts)}</svg></figure>'
    )


def cell(comparison: Comparison | None, metric: Metric) -> str:
    if comparison is None or metric not in comparison.history:
        return '<td class="number">-</td><td></td>'
    bound = comparison.bounds.get(metric)
    kind = {True: "pass", False: "fail", None: "unjudged"}[comparison.holds(metric)]
    limit = "" if bound is None else f"at most {bound_text(bound)}"
    value = shown(comparison.largest(metric))
    return f'<td class="number {kind}">{value}</td><td class="unjudged">{limit}</td>'


def agreement_table(found: Findings) -> str:
    rows = []
    for metric in found.others["our_mujoco"].history:
        cells = [cell(found.pairs.get(half), metric) for half in CURVES]
        for name in ("our_mujoco", "mjscene"):
            other = found.others.get(name)
            cells.append(f'<td class="number">{shown(other.largest(metric)) if other else "-"}</td>')
        head = escape(f"{metric.name} [{metric.unit}]")
        rows.append(f'<tr><th scope="row">{head}</th>{"".join(cells)}</tr>')
    return (
        '<div class="scroll"><table><thead><tr><th></th>'
        '<th colspan="2" class="engine-bsm">Basilisk&#39;s BSM to our BSM</th>'
        '<th colspan="2" class="engine-mujoco">MJScene to our MuJoCo</th>'
        '<th class="number">our MuJoCo to our BSM</th><th class="number">MJScene to our BSM</th>'
        f"</tr></thead><tbody>{''.join(rows)}</tbody></table></div>"
    )


def cost_table(found: Findings) -> str:
    if found.costs is None:
        return ""
    costs, facts = found.costs, found.emission.facts
    each = {name: cost["best"] for name, cost in costs["us_per_step"].items()}
    factors = ratios(costs, facts)
    rows = []
    for title, half, ours, ratio in (
        ("BSM", "bsm", "our_bsm", "bsm_over_our_bsm"),
        ("MuJoCo", "mjscene", "our_mujoco", "mjscene_over_our_mujoco"),
    ):
        theirs, effector = fastest(costs, half, facts)
        factor = f"{factors[ratio]:.3g}" if ratio in factors else "-"
        numbers = "".join(f'<td class="number">{text}</td>' for text in (us(theirs), us(each[ours]), factor))
        rows.append(f'<tr><th scope="row">{title}</th>{numbers}<td>{escape(effector)}</td></tr>')
    return (
        "<section><h2>Cost of a step</h2><table><thead><tr><th></th>"
        '<th class="number">Basilisk [us]</th><th class="number">ours [us]</th>'
        '<th class="number">ratio</th><th>hinges by</th></tr></thead>'
        f"<tbody>{''.join(rows)}</tbody></table><p class=\"note\">Best of {costs['rounds']} rounds in "
        "turns, nothing recorded; load average "
        f"{costs['load_average']:.1f}.</p></section>"
    )


def facts_list(found: Findings) -> str:
    facts, ours = found.emission.facts, found.report["provenance"]
    entries = [
        ("Basilisk", f"{facts['basilisk']}, MuJoCo {facts['mujoco'] or 'unknown'}"),
        ("ours", f"{ours['program']}, MuJoCo {ours['mujoco']}, {ours['instructions']}"),
        ("processor", ours["cpu"]),
        ("Basilisk's BSM is made of", ", ".join(facts["effectors"]) or "nothing: it is refused"),
        *(
            ("not flown by " + {"bsm": "Basilisk's BSM", "mjscene": "MJScene"}[half], reason)
            for half, reason in facts["refused"].items()
        ),
        ("spec", f"{found.report['spec']['file']}, SHA-256 {found.report['spec']['sha256']}"),
    ]
    items = "".join(f"<dt>{escape(name)}</dt><dd>{escape(str(value))}</dd>" for name, value in entries)
    return f'<dl class="facts">{items}</dl>'


def page(found: Findings) -> str:
    facts = found.emission.facts
    lede = f"{facts['duration_s']:g} s, {facts['integrator']} at {facts['step_s']:g} s"
    notes = "".join(f"<li>{escape(note)}</li>" for note in found.notes)
    plots = "".join(figure(found, metric) for metric in found.others["our_mujoco"].history)
    key = "".join(
        f'<li class="engine-{engine}">{escape(text)}</li>'
        for half, (text, engine) in CURVES.items()
        if half in found.pairs
    )
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        '<meta http-equiv="Content-Security-Policy" '
        "content=\"default-src 'none'; style-src 'unsafe-inline'\">"
        f"<title>{escape(found.name)} in Basilisk</title><style>{STYLE.read_text()}</style></head><body>"
        f'<header class="head"><p class="eyebrow">Basilisk and Twincraft</p><h1>{escape(found.name)}</h1>'
        f'<p class="lede">{escape(lede)}</p><p class="verdict" data-verdict="{found.verdict}">'
        f'<span class="verdict-mark"></span>{escape(verdict_of(found))}</p></header><main>'
        f"<section><h2>Agreement</h2>{agreement_table(found)}"
        f'<ul class="reasons">{notes}</ul></section>{cost_table(found)}'
        "<section><h2>Differences over time</h2><p>Bounds are dashed. Of every stretch of time the "
        f'largest value is drawn.</p><ul class="legend">{key}</ul><div class="plots">{plots}</div>'
        f"</section><section><h2>Programs</h2>{facts_list(found)}</section></main></body></html>\n"
    )
