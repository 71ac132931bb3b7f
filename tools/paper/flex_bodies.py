"""Write models/paper/flex_bodies/: the paper's flexible arrays with every segment a body.

`bodies` has no key that makes many of one, so the files are generated: tools/update-goldens writes
them and its --check shows when they are not fresh.

    python3 tools/paper/flex_bodies.py FOLDER
"""

import math
import pathlib
import sys

SEGMENTS = (1, 2, 4, 8, 16, 32)
ARRAY_MASS = 60.0  # [kg] of one array
ARRAY_LENGTH = 3.0  # [m]
STIFFNESS = 600.0  # [N m/rad] of every hinge

HEAD = """\
# yaml-language-server: $schema=../../../schemas/spacecraft.schema.json
# The machine of ../flex_panels.yaml with {n} segment{s} on either side, every segment a body.
# Generated: tools/paper/flex_bodies.py says how.
format: spacecraft/1
name: flex_bodies_{n:02}
extends: ../flex_panels.yaml
description: the flexible arrays as {dof} coordinates of general bodies
drop: [wing_p, wing_m]

bodies:
"""

ROOT = """\
  - name: {name}
    joint: {{type: revolute, axis: [0, 1, 0], position: [{x}, 0, 0], {hinge}, angle: 8 deg}}
    orientation: {{quaternion: {turn}}}
"""

LINK = """\
  - name: {name}
    parent: {parent}
    joint: {{type: revolute, axis: [0, 1, 0], position: [{length!r}, 0, 0], {hinge}}}
"""

MASS = """\
    mass: {mass!r} kg
    center_of_mass: [{half!r}, 0, 0]
    inertia: [{axial!r}, {across!r}, {across!r}]
"""


def model(n: int) -> str:
    mass = ARRAY_MASS / n
    half = ARRAY_LENGTH / (2 * n)
    length = 2 * half
    across = mass * length * length / 12
    numbers = dict(mass=mass, half=half, axial=max(0.05 * across, 1.0e-4), across=across)
    # The shortest period of a single segment, as the step rule of `panels` has it.
    period = 2 * math.pi * math.sqrt((across + mass * half * half) / STIFFNESS)
    hinge = f"stiffness: {STIFFNESS:g}, damping: 5"
    text = HEAD.format(n=n, s="s" if n > 1 else "", dof=6 + 2 * n)
    # Body axes are (outboard, hinge, normal): the +x array is turned about x, the other about y.
    for side, x, turn in (("p", 0.8, "[0, 1, 0, 0]"), ("m", -0.8, "[0, 0, 1, 0]")):
        for i in range(1, n + 1):
            if i == 1:
                text += ROOT.format(name=f"{side}1", x=x, hinge=hinge, turn=turn)
            else:
                text += LINK.format(
                    name=f"{side}{i}", parent=f"{side}{i - 1}", length=length, hinge=hinge
                )
            text += MASS.format(**numbers)
    # Bodies stand for the paper's general effector, so they take the general recursion.
    text += "\nengines:\n  bsm: {chains: general}\n"
    return text + f"\nsimulation: {{step: {min(0.01, period / 200)!r} s}}\n"


def main() -> None:
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for n in SEGMENTS:
        (folder / f"{n:02}.yaml").write_text(model(n))


if __name__ == "__main__":
    main()
