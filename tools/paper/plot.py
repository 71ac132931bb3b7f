"""Figures by gnuplot: dark on white, colours that the colour-blind can tell apart."""

from __future__ import annotations

import pathlib
import subprocess
from dataclasses import dataclass, field

from runs import RunFailed

# Okabe and Ito's palette.
BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY, GREY = (
    "#0072B2", "#D55E00", "#009E73", "#E69F00", "#CC79A7", "#56B4E9", "#777777",
)  # fmt: skip
ENGINE_COLOUR = {"bsm": BLUE, "mujoco": VERMILION}
ENGINE_NAME = {"bsm": "BSM", "mujoco": "MuJoCo"}

PREAMBLE = """\
set terminal svg size 760,480 dynamic enhanced font "Helvetica,15" background rgb "white"
set border 3 linewidth 1.2 linecolor rgb "#222222"
set tics nomirror textcolor rgb "#222222"
set grid linetype 1 linewidth 0.6 linecolor rgb "#dddddd"
set key textcolor rgb "#222222" samplen 2.5 spacing 1.2
set title font "Helvetica,16" textcolor rgb "#111111"
set lmargin 11
set rmargin 3
"""


@dataclass
class Curve:
    title: str
    points: list[tuple[float, float]]
    colour: str
    style: str = "linespoints"  # lines, points
    marker: int = 7
    dash: int = 1


@dataclass
class Plot:
    title: str
    x: str
    y: str
    log: str = ""  # x, y or xy
    key: str = "top left"  # as gnuplot has it; `outside right center` beside the plot
    zero: float | None = None  # where a logarithmic axis shows an exact zero
    curves: list[Curve] = field(default_factory=list)
    extra: str = ""  # further commands

    def add(self, title: str, points: list[tuple[float, float]], colour: str, **style) -> None:
        self.curves.append(Curve(title, points, colour, **style))


def _drawable(curve: Curve, plot: Plot) -> list[tuple[float, float]]:
    """A logarithmic axis has no place for zero but the one that the plot gives it."""
    points = []
    for x, y in curve.points:
        if y == 0 and plot.zero is not None:
            y = plot.zero
        if ("x" not in plot.log or x > 0) and ("y" not in plot.log or y > 0):
            points.append((x, y))
    return points


def script_of(plot: Plot) -> str:
    text = PREAMBLE + f'set title "{plot.title}"\nset xlabel "{plot.x}"\nset ylabel "{plot.y}"\n'
    text += f"set key {plot.key}\n"
    for axis in plot.log:
        text += f'set logscale {axis}\nset format {axis} "10^{{%L}}"\n'
    if "outside right" in plot.key:
        text += "set rmargin -1\n"
    if plot.zero is not None and any(y == 0 for curve in plot.curves for _, y in curve.points):
        text += f'set yrange [{plot.zero / 3!r}:]\nset ytics add ("exactly 0" {plot.zero!r})\n'
        text += "set lmargin 15\n"  # room for the words
    text += plot.extra
    parts = []
    for number, curve in enumerate(plot.curves):
        points = _drawable(curve, plot)
        if not points:
            continue
        text += f"$d{number} << EOD\n" + "".join(f"{x!r} {y!r}\n" for x, y in points) + "EOD\n"
        look = f'linecolor rgb "{curve.colour}" linewidth 2 dashtype {curve.dash}'
        if "points" in curve.style:
            look += f" pointtype {curve.marker} pointsize 0.8"
        title = f'title "{curve.title}"' if curve.title else "notitle"
        parts.append(f"$d{number} with {curve.style} {look} {title}")
    if not parts:
        raise RunFailed(f"figure `{plot.title}` has nothing to draw")
    return text + "plot " + ", \\\n  ".join(parts) + "\n"


def draw(plot: Plot, path: pathlib.Path) -> None:
    """Write an SVG; the whole file or nothing."""
    done = subprocess.run(["gnuplot"], input=script_of(plot), capture_output=True, text=True)
    if done.returncode != 0 or not done.stdout.startswith("<?xml"):
        raise RunFailed(f"gnuplot on {path.name}: {done.stderr.strip()}")
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_suffix(".tmp")
    temporary.write_text(done.stdout)
    temporary.replace(path)


def ticks(axis: str, values: tuple[float, ...], low: float, high: float) -> str:
    """Ticks of a logarithmic axis at these values alone."""
    marks = ", ".join(f'"{value:g}" {value!r}' for value in values)
    return f"set {axis}tics ({marks})\nset {axis}range [{low!r}:{high!r}]\n"


def slope_line(points: list[tuple[float, float]], order: float, factor: float = 0.3) -> list:
    """A line of this order below the points, from their first to their last x."""
    (x0, y0), (x1, _) = points[0], points[-1]
    return [(x, factor * y0 * (x / x0) ** order) for x in (x0, x1)]
