"""The findings as text, in the manner of scsim's report."""

from __future__ import annotations

import textwrap

from differences import Metric
from findings import Comparison, Findings
from race import fastest, ratios


def shown(value: float) -> str:
    """Two digits, an exponent without padding."""
    if value == 0:
        return "0"
    digits, exponent = f"{value:.1e}".split("e")
    return f"{digits}e{int(exponent):+03d}"


def bound_text(value: float) -> str:
    digits, exponent = f"{value:.0e}".split("e")
    return f"{digits}e{int(exponent):+03d}" if value < 0.01 else f"{value:g}"


def judged(comparison: Comparison | None, metric: Metric) -> list[str]:
    if comparison is None or metric not in comparison.history:
        return ["-", "", ""]
    verdict = {True: "ok", False: "EXCEEDED", None: ""}[comparison.holds(metric)]
    bound = comparison.bounds.get(metric)
    return [shown(comparison.largest(metric)), "-" if bound is None else bound_text(bound), verdict]


def reported(comparison: Comparison | None, metric: Metric) -> str:
    known = comparison is not None and metric in comparison.history
    return shown(comparison.largest(metric)) if known else "-"


def agreement_lines(found: Findings) -> list[str]:
    bsm, scene = (found.pairs.get(half) for half in ("bsm", "mjscene"))
    mujoco, scene_too = (found.others.get(name) for name in ("our_mujoco", "mjscene"))
    form = "{:<21}{:<10}{:<8}{:<10}{:<10}{:<8}{:<10}{:<13}{}"
    lines = [
        "                     Basilisk's BSM              MJScene                     our MuJoCo   MJScene",
        "agreement            to our BSM                  to our MuJoCo               to our BSM   "
        "to our BSM",
    ]
    metrics = list(found.others["our_mujoco"].history)
    for metric in metrics:
        cells = [*judged(bsm, metric), *judged(scene, metric)]
        cells += [reported(mujoco, metric), reported(scene_too, metric)]
        lines.append(form.format(f"  {metric.name} {metric.unit}", *cells))
    return lines


def us(value: float | None) -> str:
    return "-" if value is None else f"{value:.3g}"


def cost_lines(found: Findings) -> list[str]:
    if found.costs is None:
        return []
    costs, facts = found.costs, found.emission.facts
    each = {name: cost["best"] for name, cost in costs["us_per_step"].items()}
    factors = ratios(costs, facts)
    form = "{:<21}{:<12}{:<12}{:<10}{}"
    lines = [form.format("cost, us per step", "Basilisk", "ours", "", "").rstrip()]
    for title, half, ours, ratio in (
        ("BSM", "bsm", "our_bsm", "bsm_over_our_bsm"),
        ("MuJoCo", "mjscene", "our_mujoco", "mjscene_over_our_mujoco"),
    ):
        theirs, effector = fastest(costs, half, facts)
        factor = f"{factors[ratio]:.3g}x" if ratio in factors else ""
        remark = f"hinges by {effector}" if effector else ""
        lines.append(form.format(f"  {title}", us(theirs), us(each[ours]), factor, remark).rstrip())
    lines.append(
        f"  best of {costs['rounds']} rounds in turns, nothing recorded; load average "
        f"{costs['load_average']:.1f}"
    )
    return lines


def text_of(found: Findings) -> str:
    facts = found.emission.facts
    mujoco = f" with MuJoCo {facts['mujoco']}" if facts["mujoco"] else ""
    ours = found.report["provenance"]
    lines = [
        f"{found.name}   {facts['duration_s']:g} s, {facts['integrator']} at {facts['step_s']:g} s",
        f"Basilisk {facts['basilisk']}{mujoco}; {ours['program']} with MuJoCo {ours['mujoco']}",
    ]
    if facts["effectors"]:
        lines.append(f"Basilisk's BSM is made of {', '.join(facts['effectors'])}")
    lines += ["", *agreement_lines(found), *cost_lines(found)]
    for half, reason in facts["refused"].items():
        title = {"bsm": "Basilisk's BSM", "mjscene": "MJScene"}[half]
        lines += textwrap.wrap(f"{title} does not fly it: {reason}", 100, subsequent_indent="  ")
    lines += [
        line
        for note in found.notes
        for line in textwrap.wrap(f"note: {note}", 100, subsequent_indent="  ", break_on_hyphens=False)
    ]
    lines += ["", verdict_of(found)]
    return "\n".join(lines) + "\n"


def verdict_of(found: Findings) -> str:
    if found.agrees is None:
        return "not judged"
    return "Basilisk and ours agree" if found.agrees else "Basilisk and ours disagree"
