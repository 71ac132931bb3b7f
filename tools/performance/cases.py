"""What is measured: one line per vehicle. A further one is a further line."""

from __future__ import annotations

import dataclasses


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    spec: str
    settings: tuple[str, ...] = ()
    is_recorded: bool = False  # samples and books too, as in a run of scsim

    @property
    def arguments(self) -> list[str]:
        changes = [word for setting in self.settings for word in ("--set", setting)]
        return [self.spec, *changes, *(["--recorded"] if self.is_recorded else [])]

    def recorded(self) -> Case:
        return dataclasses.replace(self, name=f"{self.name}, recorded", is_recorded=True)


def paper(name: str) -> Case:
    return Case(name, f"models/paper/{name}.yaml")


def flex(segments: int) -> Case:
    return Case(
        f"flex, N={segments}", "models/paper/flex_panels.yaml", (f"panels.*.segments={segments}",)
    )


TABLE_1 = [
    paper(name)
    for name in ("orbit", "torque", "rw_panels", "orbit_compact", "orbit_extended", "variable_mass")
]
FLEX = {segments: flex(segments) for segments in (1, 2, 4, 8, 16, 32, 64)}
# Trees that take the general path: the arrays written as bodies, and an arm.
GENERAL = [
    *(
        Case(f"bodies, N={segments}", f"models/paper/flex_bodies/{segments:02}.yaml")
        for segments in (1, 2, 4, 8, 16, 32)
    ),
    Case("branched_arm", "models/gallery/branched_arm.yaml"),
]

ALL = [*TABLE_1, *FLEX.values(), *GENERAL]
# Flown bare and recorded.
RECORDED = [*(paper(name) for name in ("rw_panels", "orbit_extended", "variable_mass")), FLEX[16]]
# What tools/check counts.
GATED = [*TABLE_1, FLEX[1], FLEX[16], *(case.recorded() for case in RECORDED)]
