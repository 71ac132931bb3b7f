"""A spec flown here and in Basilisk. Called by tools/compare-basilisk, which sees to packages first."""

from __future__ import annotations

import argparse
import contextlib
import json
import pathlib
import shutil
import sys
import tempfile

from chain import Failed, emit, fly_here, fly_there
from findings import find, to_json
from page import page
from race import race
from terminal import text_of

EXIT_FINDINGS, EXIT_INPUT_OUTPUT, EXIT_INTERRUPTED = 1, 3, 130
TRAJECTORIES = ("bsm.csv", "mujoco.csv", "basilisk_bsm.csv", "basilisk_mjscene.csv")


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="tools/compare-basilisk",
        description="Fly a spec in both our engines and in both of Basilisk's formulations; print how "
        "far they agree and what a step costs. Ours is set to Basilisk's formulation, and the notes "
        "say how.",
        epilog="Exit: 0 they agree or are not judged, 1 they do not or the spec has faults, 2 usage, "
        "3 input/output, 125 a program could not be built or installed, 130 interrupted.",
    )
    parser.add_argument("spec", metavar="SPEC")
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=pathlib.Path,
        help="also write comparison.html, comparison.json, the script and the four trajectories",
    )  # fmt: skip
    parser.add_argument(
        "--set", dest="settings", metavar="PATH=VALUE", action="append", default=[],
        help="change the spec first; repeatable",
    )  # fmt: skip
    parser.add_argument("--rounds", type=int, default=5, help="of timing; default: 5")
    parser.add_argument("--no-timing", action="store_true", help="compare only")
    parser.add_argument("--quiet", action="store_true", help="print nothing but what goes wrong")
    options = parser.parse_args()
    if options.rounds < 1:
        parser.error("--rounds: at least one")
    return options


def complain(text: str) -> None:
    print(f"compare-basilisk: {text}", file=sys.stderr, flush=True)


def deliver(found, folder: pathlib.Path, output: pathlib.Path) -> None:
    """The folder of the run, less what is for us alone, becomes the output."""
    output.mkdir(parents=True, exist_ok=True)
    for name in (found.emission.script.name, *TRAJECTORIES):
        (output / name).unlink(missing_ok=True)  # of an earlier run
        if (folder / name).exists():
            shutil.copyfile(folder / name, output / name)
    for name, text in (
        ("comparison.json", json.dumps(to_json(found), indent=1) + "\n"),
        ("comparison.html", page(found)),
    ):
        temporary = output / (name + ".new")
        temporary.write_text(text)
        temporary.replace(output / name)


def compare(options: argparse.Namespace, folder: pathlib.Path) -> int:
    emission = emit(options.spec, options.settings, folder)
    fly_there(emission, folder)
    settings = [*options.settings, *emission.ours]
    report = fly_here(options.spec, settings, 0, folder)
    found = find(emission, report, folder)
    if not options.no_timing and not emission.facts["adaptive"]:
        timed = folder / "timed"
        timed.mkdir()
        found.costs = race(emission, options.spec, settings, options.rounds, timed)
    if options.output:
        deliver(found, folder, options.output)
    if not options.quiet:
        print(text_of(found), end="", flush=True)
    return EXIT_FINDINGS if found.agrees is False else 0


def main() -> int:
    options = arguments()
    try:
        with tempfile.TemporaryDirectory(prefix="compare-basilisk.") as folder:
            return compare(options, pathlib.Path(folder))
    except Failed as failure:
        complain(str(failure))
        return failure.code
    except BrokenPipeError:
        with contextlib.suppress(OSError):
            sys.stdout.close()
        return EXIT_INPUT_OUTPUT
    except OSError as error:
        complain(str(error))
        return EXIT_INPUT_OUTPUT
    except KeyboardInterrupt:
        complain("interrupted")
        return EXIT_INTERRUPTED


sys.exit(main())
