"""Hub, three wheels and two panels in deep space."""

from plot import BLUE, ORANGE, SKY, VERMILION, Plot
from runs import Runner, attitude_history
from verdict import Section

NAME = "rw_panels"


def run(runner: Runner, plots: dict[str, Plot]) -> Section:
    section = Section(
        "Reaction wheels and hinged panels",
        "The paper's way adds a token mass per wheel on top of the hub in MuJoCo; the exact way "
        "takes token mass and inertia back out of the hub. All numbers are the largest differences "
        "over 120 s.",
    )
    exact = runner.run("rw_panels")
    paper = runner.run("studies/rw_wheel_mass")
    for member, power in enumerate((6, 8, 10)):
        ours = paper.agreement("attitude_deg", member)
        section.add(f"rw.attitude{power}", ours, exact.agreement("attitude_deg"))
    for key, metric in (
        ("rate", "rate_rad_s"), ("wheel", "wheel_rate_rad_s"), ("panel", "joint_deg"),
    ):  # fmt: skip
        section.add(f"rw.{key}", paper.agreement(metric), exact.agreement(metric))

    plot = Plot("Hub attitude, wheels and panels", "time [s]", "difference [deg]", "y")
    plot.key = "outside right center"
    for member, (power, colour) in enumerate(((6, VERMILION), (8, ORANGE), (10, SKY))):
        history = attitude_history(
            paper.trajectory("bsm", member), paper.trajectory("mujoco", member)
        )
        plot.add(f"wheels of 10^{{-{power}}} kg", history, colour, style="lines")
    history = attitude_history(exact.trajectory("bsm"), exact.trajectory("mujoco"))
    plot.add("one machine", history, BLUE, style="lines")
    plots["figure-4"] = plot
    section.figure("figure-4", "hub attitude difference for three token masses and without")
    return section
