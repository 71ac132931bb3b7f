"""Campaigns as Slurm arrays, by examples/slurm/campaign.sbatch as it stands, in a Slurm of one node."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from conftest import ROOT, Campaign
from slurm_node import Slurm, slurm_node, wait_until

Table = list[dict[str, str]]
SCRIPT = ROOT / "examples" / "slurm" / "campaign.sbatch"


def submit(slurm: Slurm, campaign: Campaign, array: str, shards: int = 3, **options) -> str:
    arguments = (campaign.spec, campaign.out, str(shards))
    return slurm.submit(SCRIPT, *arguments, array=array, cwd=campaign.folder, **options)


def submit_merge(slurm: Slurm, campaign: Campaign, after: str) -> str:
    options = (f"--dependency=afterany:{after}", "--wrap=scsim merge out")
    return slurm.submit(*options, cwd=campaign.folder)


def exit_codes(slurm: Slurm, job: str) -> dict[int, int]:
    return {number: task.exit_code for number, task in slurm.wait(job).items()}


# What takes Slurm long is submitted first and looked at last; the other tests run meanwhile.


@pytest.fixture(scope="module", autouse=True)
def out_of_time(slurm: Slurm, tmp_path_factory: pytest.TempPathFactory) -> tuple[Campaign, str]:
    """A campaign without end and its job, which Slurm signals within 30 s: so often it looks at limits."""
    campaign = Campaign(tmp_path_factory.mktemp("limit"), members=1_000_000).write()
    options = ("--time=1", "--cpus-per-task=1")
    job = submit(slurm, campaign, "1", 1, signal="B:USR1@60", options=options)
    return campaign, job


@pytest.fixture(scope="module", autouse=True)
def requeued(slurm: Slurm, tmp_path_factory: pytest.TempPathFactory) -> tuple[Campaign, str, str]:
    """A campaign, its job and that of its merge. Task 1 is requeued as after a preemption, task 3 as before
    its limit. It is the last task, which Slurm knows by the number of the whole array."""
    campaign = Campaign(tmp_path_factory.mktemp("requeued")).write()
    job = submit(slurm, campaign, "1-3")
    merge = submit_merge(slurm, campaign, job)
    wait_until(campaign.has_begun, "a member is finished")
    slurm.signal(f"{job}_3", "USR1")
    slurm.requeue(f"{job}_1")
    return campaign, job, merge


def test_the_commands_of_the_page_fly_and_merge(slurm: Slurm, campaign: Campaign, flown_alone: Table):
    page = (ROOT / "docs" / "clusters.md").read_text()
    commands = re.search(r"```sh\n(.*?)```", page, re.DOTALL)[1]
    assert "sbatch" in commands
    (campaign.folder / SCRIPT.name).symlink_to(SCRIPT)
    said = slurm.run("bash", "-euc", commands + "echo $campaign", cwd=campaign.folder)
    merge, array = re.findall(r"\d+", said)
    assert exit_codes(slurm, merge) == {0: 0}
    assert exit_codes(slurm, array) == {1: 0, 2: 0, 3: 0, 4: 0}
    assert campaign.table() == flown_alone


def test_shards_killed_and_cancelled_are_submitted_again_alone(slurm: Slurm, campaign: Campaign,
                                                               flown_alone: Table):
    job = submit(slurm, campaign, "1-3")
    merge = submit_merge(slurm, campaign, job)
    wait_until(campaign.has_begun, "a member is finished")
    slurm.kill(f"{job}_2", "scsim")
    slurm.cancel(f"{job}_3")
    assert exit_codes(slurm, merge) == {0: 1}
    tasks = slurm.wait(job)
    assert [tasks[number].state for number in (1, 2, 3)] == ["COMPLETED", "FAILED", "CANCELLED"]
    assert tasks[2].exit_code == 128 + 9
    assert exit_codes(slurm, submit(slurm, campaign, "2,3")) == {2: 0, 3: 0}
    assert campaign.merge() == 0
    assert campaign.table() == flown_alone


def test_the_merge_waits_for_shards_that_are_requeued(slurm: Slurm, requeued: tuple[Campaign, str, str],
                                                      flown_alone: Table):
    campaign, job, merge = requeued
    assert exit_codes(slurm, merge) == {0: 0}
    assert exit_codes(slurm, job) == {1: 0, 2: 0, 3: 0}
    assert {number: task.restarts for number, task in slurm.tasks(job).items()} == {1: 1, 2: 0, 3: 1}
    assert campaign.table() == flown_alone


def test_a_shard_that_comes_to_its_limit_is_requeued(slurm: Slurm, out_of_time: tuple[Campaign, str]):
    campaign, job = out_of_time
    wait_until(lambda: slurm.tasks(job)[1].restarts > 0, "the task is requeued")
    kept = campaign.finished()
    assert kept > 0
    wait_until(lambda: campaign.finished() > kept, "it goes on")
    slurm.cancel(job)
    slurm.wait(job)


def test_a_node_leaves_nothing_behind(campaign: Campaign):
    with pytest.raises(KeyboardInterrupt), slurm_node() as node:
        job = submit(node, campaign, "1", 1)
        wait_until(campaign.has_begun, "a member is finished")
        assert len(node.processes(f"SLURM_JOB_ID={job}")) >= 2
        raise KeyboardInterrupt
    assert not node.processes()
    assert not node.configuration.parent.exists()
