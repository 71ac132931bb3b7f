"""What the tests on clusters share: a node, and a program that flies campaigns on it."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from slurm_node import Slurm, slurm_node, want_of

STAND_IN = Path(__file__).with_name("stand_in.py")


@dataclass(frozen=True)
class Campaign:
    """A spec in a folder of its own, in which jobs run; `out` there is theirs."""

    folder: Path
    members: int
    seconds: float  # that each member takes

    @property
    def spec(self) -> Path:
        return self.folder / "vehicle.yaml"

    def write(self) -> Campaign:
        write_spec(self.spec, self.members, self.seconds)
        return self

    @property
    def out(self) -> Path:
        return self.folder / "out"

    def has_begun(self) -> bool:
        """Whether a shard has finished a member."""
        return any(part.stat().st_size for part in self.out.glob("shard_*"))

    def merge(self) -> int:
        """The exit code of the merge."""
        return subprocess.run(["scsim", "merge", self.out]).returncode

    def is_as_flown_alone(self) -> bool:
        """Whether what was merged has the bytes of a run in one go, here."""
        alone = self.folder / "alone"
        spec = write_spec(self.folder / "quick.yaml", self.members, seconds=0.0)
        subprocess.run(["scsim", spec, "-o", alone], check=True, stdout=subprocess.DEVNULL)
        return (self.out / "campaign.csv").read_bytes() == (alone / "campaign.csv").read_bytes()


def write_spec(file: Path, members: int, seconds: float) -> Path:
    file.write_text(json.dumps({"members": members, "seconds": seconds}))
    return file


@pytest.fixture(scope="session", autouse=True)
def scsim(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Puts scsim on the path, here and in jobs: for now its stand-in."""
    folder = tmp_path_factory.mktemp("bin")
    (folder / "scsim").symlink_to(STAND_IN)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PATH", str(folder), prepend=os.pathsep)
        yield


@pytest.fixture
def campaign(tmp_path: Path) -> Campaign:
    """Of 30 members: each of three shards flies for two seconds."""
    return Campaign(tmp_path, members=30, seconds=0.2).write()


@pytest.fixture(scope="session")
def slurm(scsim: None) -> Iterator[Slurm]:
    if reason := want_of():
        pytest.skip(reason)
    with slurm_node() as node:
        yield node
