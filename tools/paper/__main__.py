"""Reproduce the paper: run every study, judge every published number, draw every figure.

Called by tools/reproduce-paper, which sees to packages first.
"""

from __future__ import annotations

import argparse
import pathlib
import subprocess
import sys

from document import document
from plot import Plot, draw
from runs import ROOT, RunFailed, Runner
from sections import SECTIONS
from verdict import Section

EXIT_FINDINGS, EXIT_INPUT_OUTPUT, EXIT_BUILD, EXIT_INTERRUPTED = 1, 3, 125, 130


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="tools/reproduce-paper",
        description="Run the paper's scenarios and write VALIDATION.md, figures/*.svg and the "
        "runs behind them.",
        epilog="Exit: 0 every verdict holds, 1 one does not or a scenario failed, 2 usage, "
        "3 input/output, 125 scsim could not be built, 130 interrupted.",
    )
    parser.add_argument("-o", "--output", metavar="DIR", default="out", help="default: out")
    parser.add_argument(
        "--quick", action="store_true", help="shorter sets, single trials: a few minutes"
    )
    return parser.parse_args()


def complain(text: str) -> None:
    print(f"reproduce-paper: {text}", file=sys.stderr, flush=True)


def build() -> bool:
    done = subprocess.run([str(ROOT / "tools" / "scsim"), "--version"], stdout=subprocess.DEVNULL)
    return done.returncode == 0


def run_section(module, runner: Runner, plots: dict[str, Plot]) -> Section:
    """A section that cannot be run says so in the document; the rest goes on."""
    runner.scenario = module.NAME
    try:
        return module.run(runner, plots)
    except (RunFailed, KeyError, IndexError) as failure:
        reason = failure if isinstance(failure, RunFailed) else f"nothing is called {failure}"
        complain(f"{module.NAME} failed: {reason}")
        return Section(module.NAME.replace("_", " ").capitalize(), failure=str(reason))


def draw_all(plots: dict[str, Plot], folder: pathlib.Path, quick: bool) -> bool:
    good = True
    for name, plot in plots.items():
        if quick:
            plot.title += " (quick run)"
        try:
            draw(plot, folder / f"{name}.svg")
        except RunFailed as failure:
            complain(str(failure))
            good = False
    return good


def write(path: pathlib.Path, text: str) -> None:
    temporary = path.with_suffix(".tmp")
    temporary.write_text(text)
    temporary.replace(path)


def reproduce(options: argparse.Namespace) -> int:
    folder = pathlib.Path(options.output)
    folder.mkdir(parents=True, exist_ok=True)
    if not build():
        complain("scsim could not be built; the reason is above")
        return EXIT_BUILD
    runner = Runner(folder / "runs", options.quick)
    plots: dict[str, Plot] = {}
    sections = [run_section(module, runner, plots) for module in SECTIONS]
    drawn = draw_all(plots, folder / "figures", options.quick)
    command = "tools/reproduce-paper" + (" --quick" if options.quick else "")
    write(folder / "VALIDATION.md", document(sections, runner.provenance, command, options.quick))
    for section in sections:
        for row in section.rows:
            if row.verdict.startswith("**") or row.bound_verdict.startswith("**"):
                complain(f"{section.title}: {row.what}: does not hold")
    failed = not drawn or any(section.fails for section in sections)
    print(f"{folder / 'VALIDATION.md'}: {'NOT every' if failed else 'every'} verdict holds")
    return EXIT_FINDINGS if failed else 0


def main() -> int:
    options = arguments()
    try:
        return reproduce(options)
    except OSError as error:
        complain(str(error))
        return EXIT_INPUT_OUTPUT
    except KeyboardInterrupt:
        complain("interrupted")
        return EXIT_INTERRUPTED


sys.exit(main())
