"""Measure what a step costs. Called by tools/benchmark, which sees to packages first."""

from __future__ import annotations

import argparse
import pathlib
import sys

import basilisk
import gate
import history
from document import document, holds
from measure import measure
from programs import ROOT, Failed

EXIT_FINDINGS, EXIT_INPUT_OUTPUT, EXIT_BUILD, EXIT_INTERRUPTED = 1, 3, 125, 130


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="tools/benchmark",
        description="Race the engines, count their instructions and write PERFORMANCE.md.",
        epilog="Exit: 0 every bound holds, 1 one does not, 2 usage, 3 input/output, 125 a program "
        "could not be built or run, 130 interrupted.",
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", type=pathlib.Path, default=ROOT / "PERFORMANCE.md"
    )
    parser.add_argument("--trials", type=int, default=41, help="of every race; default: 41")
    parser.add_argument(
        "--counts", action="store_true", help="only hold instruction counts against the stored ones"
    )
    parser.add_argument("--update", action="store_true", help="with --counts: store them")
    parser.add_argument(
        "--step",
        metavar="TITLE",
        help="only count, and append to tests/bench/history.json what a step of the work brought",
    )
    parser.add_argument(
        "--of",
        metavar="COMMIT",
        help="with --step: take the counts that the commit stored, instead of counting",
    )
    parser.add_argument(
        "--basilisk", action="store_true", help="only race Basilisk, and renew that section of FILE"
    )
    parser.add_argument("--rounds", type=int, default=6, help="of every race of Basilisk; default: 6")
    options = parser.parse_args()
    if sum([options.basilisk, options.counts, options.step is not None]) > 1:
        parser.error("--basilisk, --counts and --step exclude one another")
    if options.of is not None and options.step is None:
        parser.error("--of goes with --step")
    if options.rounds < 1:
        parser.error("--rounds: at least one")
    if options.update and not options.counts:
        parser.error("--update goes with --counts")
    if options.trials < 1:
        parser.error("--trials: at least one")
    return options


def complain(text: str) -> None:
    print(f"benchmark: {text}", file=sys.stderr, flush=True)


def benchmark(options: argparse.Namespace) -> int:
    if options.counts:
        return gate.update() if options.update else gate.check()
    if options.step is not None:
        return history.append(options.step, options.of)
    if options.basilisk:
        return race_basilisk(options)
    results = measure(options.trials, options.rounds, complain)
    gate.write(options.output, document(results))
    verdict = "every bound holds" if holds(results) else "NOT every bound holds"
    print(f"{options.output.name}: {verdict}")
    return 0 if holds(results) else EXIT_FINDINGS


def race_basilisk(options: argparse.Namespace) -> int:
    races = basilisk.races(options.rounds, complain)
    gate.write(options.output, basilisk.replaced(options.output.read_text(), races))
    ahead = basilisk.holds(races)
    print(f"{options.output.name}: ours is {'ahead' if ahead else 'NOT ahead'} in every row")
    return 0 if ahead else EXIT_FINDINGS


def main() -> int:
    options = arguments()
    try:
        return benchmark(options)
    except Failed as failure:
        complain(str(failure))
        return EXIT_BUILD
    except OSError as error:
        complain(str(error))
        return EXIT_INPUT_OUTPUT
    except KeyboardInterrupt:
        complain("interrupted")
        return EXIT_INTERRUPTED


sys.exit(main())
