"""PERFORMANCE.md."""

from __future__ import annotations

import os

import basilisk
import machine
from cases import ALL, FLEX
from claims import claims, exponent_of_counts, exponent_of_time, wrapper
from measure import FEWER, MORE, Results
from programs import run


def holds(results: Results) -> bool:
    return all(claim.holds for claim in claims(results)) and basilisk.holds(results.basilisk)


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def claim_table(results: Results) -> str:
    rows = []
    for claim in claims(results):
        verdict = "aim" if claim.reaches_aim else "must" if claim.holds else "**MISSED**"
        rows.append([claim.what, claim.must, claim.aim, claim.reached, verdict])
    return table(["analytic engine", "must", "aim", "reached", "holds"], rows)


def race_table(results: Results) -> str:
    rows = []
    for case in ALL:
        done = results.races[case.name]
        engines = done["engines"]
        cells = [case.name, str(done["degrees_of_freedom"])]
        for name in ("bsm", "mujoco", "forward", "minimal"):
            best, median = (engines[name][f"{kind}_us_per_step"] for kind in ("best", "median"))
            cells.append(f"{best:.3g} / {median:.3g}")
        cells.append(f"{done['ratios_of_best']['forward_over_bsm']:.1f}")
        rows.append(cells)
    return table(
        ["", "DOF", "analytic", "MuJoCo engine", "`mj_forward`", "sub-stages", "times faster"], rows
    )


def count_table(results: Results) -> str:
    engines = ("portable", "bsm", "mujoco", "forward", "minimal")
    rows = []
    for case in ALL:
        each = [results.counts[case.name, engine].instructions for engine in engines]
        beyond = f"{wrapper(results, case.name):+.1f} %"
        rows.append(
            [case.name, *(f"{count:,.0f}" for count in each), f"{each[3] / each[0]:.1f}", beyond]
        )
    head = ["", "analytic, any x86-64", "analytic, AVX2", "MuJoCo engine", "`mj_forward`"]
    return table([*head, "sub-stages", "fewer", "MuJoCo engine beyond sub-stages"], rows)


def exponent_table(results: Results) -> str:
    named = [
        ("analytic, any x86-64", "portable"),
        ("analytic, best of the machine", "bsm"),
        ("MuJoCo engine", "mujoco"),
        ("`mj_forward`", "forward"),
    ]
    rows = []
    for name, engine in named:
        timed = "-" if engine == "portable" else f"{exponent_of_time(results, engine):.2f}"
        rows.append([name, f"{exponent_of_counts(results, engine):.2f}", timed])
    return table(["", "instructions", "time"], rows)


def batch_table(results: Results) -> str:
    sets = list(results.lanes)
    rows = []
    for name, row in results.batches.items():
        single = 1.0 / results.races[name]["engines"]["bsm"]["best_us_per_step"]
        rows.append([name, f"{single:.2f}", *(f"{row[one] / 1e6:.2f}" for one in sets)])
    return table(["", "one at a time", *(f"{s}, {results.lanes[s]} lanes" for s in sets)], rows)


def evaluation_table(results: Results) -> str:
    rows = [
        [name, f"{row['bsm']:.0f}", f"{row['mujoco']:.0f}", f"{row['mujoco'] / row['bsm']:.1f}"]
        for name, row in results.evaluations.items()
    ]
    return table(["", "analytic [ns]", "MuJoCo engine [ns]", "ratio"], rows)


def share_table(results: Results) -> str:
    rows = [[name, f"{100 * share:.1f} %"] for name, share in results.shares]
    return table(["instructions of a step", "share"], rows)


def machine_text(results: Results) -> str:
    model, features = machine.cpu()
    before, after = results.load
    cores = os.cpu_count()
    mujoco = run(["dpkg-query", "--show", "--showformat", "${Version}", "libmujoco-dev"])
    return "\n".join(
        [
            f"- processor: {model}, {cores} cores, a virtual machine's; {', '.join(features)}"
            if "hypervisor" in open("/proc/cpuinfo").read()
            else f"- processor: {model}, {cores} cores; {', '.join(features)}",
            f"- load average: {before:.1f} before the races, {after:.1f} after"
            + (" (**more than a race should have**)" if max(before, after) > cores else ""),
            f"- compiler: {machine.compiler()}; `{machine.flags()}`",
            f"- MuJoCo: {mujoco} of Debian",
            f"- source: {machine.revision()}",
        ]
    )


def document(results: Results) -> str:
    instructions = results.races[FLEX[1].name]["instructions"]
    return f"""# What a step costs

Made by `tools/benchmark`, which builds the release, runs everything below and writes this file; nothing in it is typed by hand.
Models are those of the paper's Table 1, its flexible arrays at N segments each as panels and, for the general recursion, as bodies, and a branched arm.

{claim_table(results)}

*must* is the bound `tools/benchmark` fails on, *aim* what was set out for. Times are best over best. The branched arm is shown below, outside the bounds.

{machine_text(results)}

## Time of one RK4 step [µs, best / median of {results.trials} trials]

{race_table(results)}

One process, one thread, the runs of the four contestants interleaved and their order reversed on alternate rounds, each
timed by the processor time of the thread, so that a trial which another process interrupts costs no more. *analytic*
({instructions} here) and *MuJoCo engine* are the two engines of `scsim`, with everything a bare run needs. *`mj_forward`* and
*sub-stages* are MuJoCo alone, on the same MJCF and with the same stepper, but with no force applied, no tank drained and no frame
changed: in MuJoCo's favour. *sub-stages* are the eight calls that free multibody motion needs. The last column is
`mj_forward` over analytic, best over best. Other work on the machine still disturbs caches and cores;
the counts below it does not move.

## Instructions of one RK4 step

{count_table(results)}

By callgrind: the difference of runs of {FEWER} and {MORE} steps, so that set-up is not in it. The same number comes out every time.
`tools/check` holds six of the first column against `tests/bench/instructions.json` (`tools/benchmark --counts`). callgrind has
no AVX-512. *fewer* is `mj_forward` over the first column. In the last column the rows with gravity, loads or tanks include them; the sub-stages have none.

Growth from 38 to 70 coordinates, as an exponent of their number:

{exponent_table(results)}

## Where the instructions go: flex, N=16, any x86-64

{share_table(results)}

## Many spacecraft at once [million spacecraft-steps per second and core]

{batch_table(results)}

One spacecraft per SIMD lane, whole RK4 steps, the best of five.

## One derivative evaluation

{evaluation_table(results)}

{basilisk.section(results.basilisk)}
## What can be relied on

The same program on a processor with the same features gives the same bytes: the engine chooses its instruction set when it starts,
the report says which (`provenance.instructions`), and nothing in a step depends on time, threads or addresses. Another
instruction set may differ in the last digits, because the wider ones round a product and a sum once where x86-64 rounds twice.
"""
