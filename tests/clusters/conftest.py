"""What the tests on clusters share: a node, and a program that flies campaigns on it."""

from __future__ import annotations

import csv
import os
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from slurm_node import Slurm, slurm_node, want_of

ROOT = Path(__file__).resolve().parents[2]
SCSIM = Path(os.environ.get("TWINCRAFT_SCSIM", ROOT / "build" / "release" / "bin" / "scsim"))

SPEC = """
format: spacecraft/1
name: cluster
extends: quickstart.yaml
simulation: {{duration: 600 s, record: 1 s}}
campaign:
  members: {members}
  dispersions:
    - {{set: hub.mass, normal: {{sigma: 2 %, truncate: 3}}}}
    - {{set: panels.*.stiffness, uniform: {{low: 90 %, high: 110 %}}}}
  outputs:
    - {{name: wing_rms, of: wing_p.1.position, reduce: rms}}
  twin: {{every: 1000000}}
"""


@dataclass(frozen=True)
class Campaign:
    """A spec in a folder of its own, in which jobs run; `out` there is theirs."""

    folder: Path
    members: int = 240  # some seconds of work: long enough for a kill to hit it

    @property
    def spec(self) -> Path:
        return self.folder / "vehicle.yaml"

    def write(self) -> Campaign:
        shutil.copy(ROOT / "models" / "quickstart.yaml", self.folder)
        self.spec.write_text(SPEC.format(members=self.members))
        return self

    @property
    def out(self) -> Path:
        return self.folder / "out"

    def finished(self) -> int:
        """The members that shards have written; a header and the number of members come before."""
        parts = [part.read_bytes() for part in self.out.glob("shards/*.records")]
        return sum(max(part.count(b"\n") - 2, 0) for part in parts)

    def has_begun(self) -> bool:
        """Whether a shard has finished a member."""
        return self.finished() > 0

    def merge(self) -> int:
        """The exit code of the merge."""
        return subprocess.run(["scsim", "merge", self.out], stdout=subprocess.DEVNULL).returncode

    def table(self) -> list[dict[str, str]]:
        """campaign.csv without the time that members took."""
        with (self.out / "campaign.csv").open(newline="") as file:
            return [{name: cell for name, cell in row.items() if name != "seconds"}
                    for row in csv.DictReader(file)]


@pytest.fixture(scope="session", autouse=True)
def scsim(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Puts scsim on the path, here and in jobs."""
    if not SCSIM.exists():
        pytest.fail(f"no {SCSIM}: build it, or name another in TWINCRAFT_SCSIM")
    folder = tmp_path_factory.mktemp("bin")
    (folder / "scsim").symlink_to(SCSIM)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PATH", str(folder), prepend=os.pathsep)
        yield


@pytest.fixture(scope="session")
def flown_alone(scsim: None, tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, str]]:
    """The table of the campaign, flown in one go, here."""
    campaign = Campaign(tmp_path_factory.mktemp("alone")).write()
    subprocess.run(["scsim", campaign.spec, "-o", campaign.out, "--quiet"], check=True)
    table = campaign.table()
    assert len(table) == campaign.members
    return table


@pytest.fixture
def campaign(tmp_path: Path) -> Campaign:
    return Campaign(tmp_path).write()


@pytest.fixture(scope="session")
def slurm(scsim: None) -> Iterator[Slurm]:
    if reason := want_of():
        pytest.skip(reason)
    with slurm_node() as node:
        yield node
