"""Why the engines differ: Sections 6.2 to 6.5 as four runs of `scsim attribute`, and a fifth for
the law of speed, which an orbit does not let one scale."""

from document import number, table
from plot import Plot
from runs import Report, RunFailed, Runner
from verdict import Section

NAME = "why"
DRIFT = "initial.velocity=[2142.8571428571427, -3214.285714285714, 6428.571428571428]"

# Section, model, the paper's way, and what the paper finds.
RUNS = (
    ("6.2", "torque", ("engines.mujoco.frame=inertial",), "velocity_artefact"),
    (
        "6.2, drifting",
        "torque",
        (
            "engines.mujoco.frame=inertial", "environment=null", "initial.orbit=null",
            "loads.push.torque=[0, 0, 0]", "initial.rate=[0, 0, 0]", DRIFT,
        ),
        "velocity_artefact",
    ),
    ("6.3", "rw_panels", ("engines.mujoco.compensate=false",), "wheel_mass"),
    ("6.4", "orbit_extended", ("engines.bsm.gravity=system_com",), "gravity_application"),
    (
        "6.5",
        "variable_mass",
        ("engines.mujoco.bob_inertia=1.0e-4", "engines.mujoco.particle_inertia=1.0e-6"),
        "bob_inertia",
    ),
)  # fmt: skip


def rows_of(part: str, expected: str, report: Report) -> list[list[str]]:
    """One row per cause and one for what is left; another cause than the paper's is a failure."""
    causes, left = report.json["attribution"], report.json["explanation"]
    if not causes or causes[0]["cause"] != expected:
        found = causes[0]["name"] if causes else "no cause"
        raise RunFailed(f"{part}: {found} carries the difference, not {expected}")
    if left["remainder_is"] != "rounding":
        raise RunFailed(f"{part}: what remains is {left['remainder_is']}, not rounding")
    rows = []
    for cause in causes:
        law = cause["law"]["words"] if cause["law"] else cause["no_law"]
        share = f"{100 * cause['share']:.1f} %".replace("-0.0 %", "0.0 %")
        rows.append([part, cause["name"], share, number(cause["maximum_without"]), law])
        part = ""
    total, rest = number(causes[0]["maximum"]), number(left["remainder"])
    rows.append(["", f"all of them, of {total}", "", rest, "rounding"])
    return rows


def run(runner: Runner, plots: dict[str, Plot]) -> Section:
    section = Section(
        "Why they differ",
        "`scsim attribute` on the paper's way of each scenario. A share is the part of the attitude "
        "difference that goes when the cause alone is taken away, sample by sample and with its "
        "direction; a law is the exponent at which what the cause does follows its size. The last "
        "row of each run has all causes taken away.",
    )
    rows = []
    for part, model, sets, expected in RUNS:
        name = "why_" + part.replace(".", "").replace(", ", "_")
        rows += rows_of(part, expected, runner.attribute(model, name, sets))
    head = ["section", "without", "carried", "difference left [deg]", "law"]
    section.tables = [table(head, rows)]
    return section
