"""Batches of members on a Dask cluster of two processes, one of which is killed midway."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from signal import SIGKILL
from typing import Any

import pytest

distributed = pytest.importorskip("distributed", reason="no Dask; tools/setup --clusters installs it")

BATCHES = [range(first, first + 10) for first in range(0, 200, 10)]


def fly(batch: range) -> list[float]:
    return [member / 7 for member in batch]


def fly_and_die_once(marker: Path, batch: range) -> list[float]:
    """Kills the process that first flies member 105, as a machine out of memory does."""
    if 105 in batch and not marker.exists():
        marker.touch()
        os.kill(os.getpid(), SIGKILL)
    return fly(batch)


def campaign(executor: Any, task: Callable[[range], list[float]]) -> list[float]:
    """Stands in for m.campaign(executor=...): results in the order of members, by any executor."""
    flown = [executor.submit(task, batch) for batch in BATCHES]
    return [result for future in flown for result in future.result(timeout=60)]


@pytest.fixture
def client(tmp_path: Path) -> Iterator[distributed.Client]:
    with (distributed.LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1",
                                   dashboard_address=None, local_directory=tmp_path) as cluster,
          distributed.Client(cluster) as client):
        yield client


def test_no_member_is_lost_with_a_worker(client: distributed.Client, tmp_path: Path):
    marker = tmp_path / "killed"
    before = client.run(os.getpid).values()
    flown = campaign(client, partial(fly_and_die_once, marker))
    assert marker.exists(), "no worker was killed"
    client.wait_for_workers(2, timeout=30)
    after = client.run(os.getpid).values()
    assert len(set(before) & set(after)) == 1
    assert flown == [result for batch in BATCHES for result in fly(batch)]
