"""Campaigns by m.campaign(executor=...) on a Dask cluster of two processes, one of which is killed midway, and in
a pool of processes: the table of `scsim SPEC -o DIR`, byte for byte but for the time that members took."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from signal import SIGKILL
from typing import Any

import pytest

from conftest import ROOT, Campaign

distributed = pytest.importorskip("distributed", reason="no Dask; tools/setup --clusters installs it")
tc = pytest.importorskip("twincraft", reason="no twincraft on PYTHONPATH; tools/check clusters builds it")

Table = list[dict[str, str]]
TASKS = 24


@pytest.fixture
def client(tmp_path: Path) -> Iterator[distributed.Client]:
    with (distributed.LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1",
                                   dashboard_address=None, local_directory=tmp_path / "dask") as cluster,
          distributed.Client(cluster) as client):
        yield client


class KillsMidway:
    """Hands tasks to a client, and kills one of its workers when a quarter of them is done."""

    def __init__(self, client: distributed.Client) -> None:
        self.client = client
        self.victim = min(client.run(os.getpid).values())
        self.futures: list[Any] = []
        self.done_at_the_kill = 0
        self.killer = threading.Thread(target=self.kill)

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Any:
        self.futures.append(self.client.submit(fn, *args))
        if len(self.futures) == TASKS:
            self.killer.start()
        return self.futures[-1]

    def kill(self) -> None:
        while (done := sum(future.done() for future in self.futures)) < TASKS // 4:
            time.sleep(0.005)
        os.kill(self.victim, SIGKILL)
        self.done_at_the_kill = done


def test_a_worker_killed_midway_changes_no_byte(client: distributed.Client, campaign: Campaign,
                                                flown_alone: Table):
    executor = KillsMidway(client)
    flown = tc.load(campaign.spec).campaign(executor, folder=campaign.out, tasks=TASKS)
    executor.killer.join()
    assert TASKS // 4 <= executor.done_at_the_kill < TASKS
    client.wait_for_workers(2, timeout=30)
    assert executor.victim not in client.run(os.getpid).values()
    assert campaign.table() == flown_alone
    assert flown.report["complete"] and len(flown) == campaign.members
    assert sorted(path.name for path in campaign.out.rglob("*") if path.is_file()) == [
        "1-of-1.records", "campaign.csv", "campaign.nc", "report.html", "report.json", "spec.yaml"]


def test_a_client_is_an_executor_as_it_is(client: distributed.Client, campaign: Campaign, flown_alone: Table):
    tc.load(campaign.spec).campaign(executor=client).save(campaign.out)
    assert campaign.table() == flown_alone


def test_the_script_of_the_page_runs(tmp_path: Path):
    (script,) = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "clusters.md").read_text(), re.DOTALL)
    (tmp_path / "script.py").write_text(script)
    (tmp_path / "models").symlink_to(ROOT / "models")
    done = subprocess.run([sys.executable, "script.py"], cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert "64 of 64 members flown" in done.stdout, done.stderr
    assert (tmp_path / "out" / "campaign.csv").exists()


def test_a_pool_of_processes_gives_the_same_table(campaign: Campaign, flown_alone: Table):
    with ProcessPoolExecutor(2) as pool:
        tc.load(campaign.spec).campaign(pool, folder=campaign.out)
    assert campaign.table() == flown_alone
