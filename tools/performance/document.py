"""PERFORMANCE.md."""

from __future__ import annotations

import os

import basilisk
import machine
from cases import FLEX, GATED
from claims import claims
from measure import FEWER, MORE, Results
from programs import run
from tables import (
    batch_table,
    claim_table,
    count_table,
    evaluation_table,
    exponent_table,
    history_table,
    race_table,
    recorded_table,
    set_table,
    share_table,
)


def holds(results: Results) -> bool:
    return all(claim.holds for claim in claims(results)) and basilisk.holds(results.basilisk)


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

One process, one thread, the runs of all contestants interleaved and their order reversed on alternate rounds, each
timed by the processor time of the thread, so that a trial which another process interrupts costs no more. *analytic*
({instructions} here) and *MuJoCo engine* are the two engines of `scsim`, with everything a bare run needs. *`mj_forward`* and
*sub-stages* are MuJoCo alone, on the same MJCF and with the same stepper, but with no force applied, no tank drained and no frame
changed: in MuJoCo's favour. *sub-stages* are the eight calls that free multibody motion needs. *`mj_step`* is what a user of MuJoCo
pays: its own RK4 on the same MJCF at the same step, constraints and contacts off as the MJCF says, pictures removed. A step is four forward
evaluations, of which the first also asks for sensors (there are none), and checks for numbers that are not finite. It has no gravity, no
loads and no tanks either, and lacks what our stepper does: sums with compensation, and ends of steps on a grid.

Ratios are best over best. Other work on the machine still disturbs caches and cores; the counts below it does not move.

## Instruction sets: time of one RK4 step of the analytic engine [µs, best]

{set_table(results)}

The engine takes {instructions} for one spacecraft here, and {results.batch_set} for batches: by a table of what was measured on processors
of this make (`runtime/bsm/processor.cpp`), so that the same machine always gives the same bytes. `scsim --isa` takes another.
The claims above fail when the table is wrong about this machine.

## What a user's run costs beside the bare run

{recorded_table(results)}

A recorded run takes samples as the spec says and integrates the books of energy and momentum at every stage, as `scsim` does unless it
times a run. Instructions are those of any x86-64, times best over best, the runs interleaved.

## Instructions of one RK4 step

{count_table(results)}

By callgrind: the difference of runs of {FEWER} and {MORE} steps, so that set-up is not in it. It repeats to a tenth of a percent.
`tools/check` holds {len(GATED)} of the portable engine's, bare and recorded, against `tests/bench/instructions.json`
(`tools/benchmark --counts`). callgrind has no AVX-512. *fewer* is `mj_forward` over the first column. In the last column the rows with
gravity, loads or tanks include them; the sub-stages have none.

Instructions of the portable engine after each step of the work, where they changed:

{history_table(results)}

`tools/benchmark --step TITLE` adds a row. Growth from 38 to 70 coordinates, as an exponent of their number:

{exponent_table(results)}

## Where the instructions go: flex, N=16, any x86-64

{share_table(results)}

## Many spacecraft at once [million spacecraft-steps per second and core]

{batch_table(results)}

One spacecraft per SIMD lane, whole RK4 steps, the best of five.

## One derivative evaluation

{evaluation_table(results)}

*exact A and B* are all derivatives of the rates by states and inputs, by dual numbers (`bsm::Differentiator`).

{basilisk.section(results.basilisk)}
## What can be relied on

The same program on processors of one make and with the same features gives the same bytes: the engine chooses its instruction set by a
table, the report says which and why (`provenance.instructions`, `instructions_reason`), and nothing in a step depends on time, threads or
addresses. Another instruction set may differ in the last digits, because the wider ones round a product and a sum once where x86-64
rounds twice.
"""
