"""Hub and wheels on orbit, without and with panels."""

import math

from plot import BLUE, ORANGE, SKY, VERMILION, Plot
from runs import Runner, attitude_history, distance_history
from verdict import Section

NAME = "multibody"
MU, AXIS = 3.98600436e14, 7.0e6  # [m3/s2], [m]
KEY = "outside bottom center horizontal maxcols 2"
PAPER, EXACT = 0, 1  # members of either study


def forcing_scale() -> float:
    """3 mu/a^3 m x^2 of the panels over the mean principal inertia of the system [rad/s2]."""
    x = 0.8 + 1.2 * math.cos(math.radians(12))  # [m] of a panel's centre
    z = 1.2 * math.sin(math.radians(12))
    lift = 100.0 * z / 700.0  # [m] of the system's centre
    height = 100.0 * (z - lift) ** 2 + 600.0 * lift**2  # [kg m2] of all masses above the centre
    trace = 400.16 + 380.16 + 360.16 + 2 * (30 + 20 + 12) + 2 * (100.0 * x**2 + height)
    return 3 * MU / AXIS**3 * 100.0 * x**2 / (trace / 3)


def run(runner: Runner, plots: dict[str, Plot]) -> Section:
    section = Section(
        "Orbiting multibody vehicle",
        "The paper's way pulls the analytic engine at the system's centre of mass and MuJoCo, in "
        "its inertial frame, at every body: two machines once the bodies are apart. The exact way "
        "has one law of gravity in both, body by body, in the frame that moves along; what it "
        "leaves of the compact vehicle is RK4's error in two charts of attitude.",
    )
    reports = {
        name: runner.run(f"studies/orbit_{name}_ways") for name in ("compact", "extended")
    }
    for metric, suffix in (("attitude_deg", ""), ("com_position_m", "_com")):
        for name, report in reports.items():
            both = (report.agreement(metric, member) for member in (PAPER, EXACT))
            section.add(f"multibody.{name}{suffix}", *both)
    section.add("multibody.scale", forcing_scale())

    angle = Plot("Hub attitude on orbit", "time [s]", "difference [deg]", "y", KEY)
    centre = Plot("System centre of mass", "time [s]", "distance [m]", "y", KEY)
    for name, colours in (("extended", (VERMILION, BLUE)), ("compact", (ORANGE, SKY))):
        for member, way in ((PAPER, "the paper's way"), (EXACT, "exact")):
            pair = [reports[name].trajectory(engine, member) for engine in ("bsm", "mujoco")]
            look = {"style": "lines", "dash": 1 if member == PAPER else 2}
            angle.add(f"{name}, {way}", attitude_history(*pair), colours[member], **look)
            history = distance_history(*pair, "r_CN_N")
            centre.add(f"{name}, {way}", history, colours[member], **look)
    plots["figure-5a"], plots["figure-5b"] = angle, centre
    section.figure("figure-5a", "hub attitude difference over one orbit, both vehicles, both ways")
    section.figure("figure-5b", "distance of the systems' centres of mass")
    return section
