"""Campaigns: in process and by executors, to the bytes of the program."""

from __future__ import annotations

import csv
import json
import os
import pickle
import re
import shutil
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from conftest import ROOT, python
from test_run import files_of, scsim

import twincraft as tc
from twincraft import _campaign as campaign

# Members that break a requirement, that never reach a level, that are no vehicle, that are kept.
SPEC = """
format: spacecraft/1
name: thrown
extends: quickstart.yaml
simulation: {{duration: 4 s}}
campaign:
  members: 40
  seed: 3
  dispersions:
    - {{set: hub.mass, normal: {{sigma: 45 %}}}}
    - {{set: panels.*.stiffness, uniform: {{low: 80 %, high: 120 %}}}}
    - {{set: initial.attitude, rotation: {{sigma: 2 deg}}}}
  outputs:
    - {{name: rate_end, of: omega_BN_B.x, reduce: final}}
    - {{name: peak, of: wing_p.1.position, reduce: max_abs, require: {{below: {bound} rad}}}}
    - {{name: crossing, of: wing_p.1.position, reduce: first_crossing, level: {level} rad}}
  keep: {{worst: 2, by: peak, members: [3]}}
  twin: {{every: 10}}
"""


@pytest.fixture(scope="module")
def spec(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Beside a copy of what it extends."""
    folder = tmp_path_factory.mktemp("spec")
    shutil.copy(ROOT / "models" / "quickstart.yaml", folder)
    path = folder / "thrown.yaml"
    path.write_text(SPEC.format(bound=0.21, level=-0.21))
    return path


@pytest.fixture(scope="module")
def model(spec: Path) -> tc.Model:
    return tc.load(spec)


@pytest.fixture(scope="module")
def flown(model: tc.Model) -> tc.Campaign:
    return model.campaign()


@pytest.fixture(scope="module")
def program(spec: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The files of the program."""
    folder = tmp_path_factory.mktemp("program") / "out"
    text = scsim(spec, "-o", folder, code=4)
    (folder.parent / "text").write_text(text)
    return folder


def timeless(folder: Path) -> dict[str, bytes]:
    """Files by name, without times: campaign.nc apart, which test_xarray reads."""
    files = files_of(folder)
    files.pop("campaign.nc", None)
    files["campaign.csv"] = re.sub(rb",[^,\n]*\n", b"\n", files["campaign.csv"])
    records = "shards/1-of-1.records"  # a checksum, then cells of which the last but one is the time
    files[records] = re.sub(rb"(?m)^[0-9a-f]{8} (\d+\t.*\t)[^\t]*(\t[^\t]*)$", rb"\1\2", files[records])
    return files


def assert_same(folder: Path, program: Path) -> None:
    ours, theirs = timeless(folder), timeless(program)
    assert list(ours) == list(theirs)
    for name, data in theirs.items():
        if not name.endswith(".html"):  # it has the times of members
            assert ours[name] == data, name


def table_of(campaign: tc.Campaign) -> str:
    return re.sub(r",[^,\n]*\n", "\n", campaign._finished.csv())


@pytest.fixture(scope="module")
def processes() -> Iterator[ProcessPoolExecutor]:
    with ProcessPoolExecutor(2) as pool:
        yield pool


# --- to the bytes of the program


def test_the_specimen_has_all_that_can_happen(flown):
    assert flown.verdict == "failed" and flown.exit_code == 4 and not flown
    assert set(flown.verdicts) == {"agree", "failed", "not_judged"}
    assert any("is not below" in reason for reason in flown.reasons)
    assert 0 < np.isnan(flown["peak"]).sum() < np.isnan(flown["crossing"]).sum() < len(flown)
    assert len(flown.report["campaign"]["kept"]) == 3


def test_saved_files_are_those_of_the_program(flown, program, tmp_path):
    flown.save(tmp_path / "out")
    assert_same(tmp_path / "out", program)


def test_files_of_a_folder_are_those_of_the_program(model, program, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    campaign = model.campaign(folder="out", jobs=1)
    assert_same(tmp_path / "out", program)
    monkeypatch.chdir(ROOT)
    campaign.save(tmp_path / "again")
    assert_same(tmp_path / "again", program)


def test_files_of_an_executor_are_those_of_the_program(model, program, processes, tmp_path):
    campaign = model.campaign(processes, folder=tmp_path / "out", tasks=7)
    assert_same(tmp_path / "out", program)
    campaign.save(tmp_path / "again")
    assert_same(tmp_path / "again", program)


def test_a_folder_holds_one_campaign(spec, model, flown, program, tmp_path):
    tc.load(spec, set={"campaign.keep": {"members": [7]}}).campaign(folder=tmp_path)
    (tmp_path / "shards" / "2-of-3.records").write_bytes(b"")
    assert (tmp_path / "0007" / "bsm.csv").exists()
    flown.save(tmp_path)
    assert_same(tmp_path, program)


def test_text_and_report_are_those_of_the_program(flown, program, tmp_path):
    assert str(flown) == (program.parent / "text").read_text()
    flown.save(tmp_path)
    assert flown.report == json.loads((tmp_path / "report.json").read_text())
    assert flown.report["verdict"] == flown.verdict


# --- the table


def test_columns_are_those_of_the_csv(flown, program):
    with (program / "campaign.csv").open(newline="") as file:
        rows = list(csv.reader(file))
    numbers = [name for name in rows[0] if name not in ("member", "verdict", "reason", "seconds")]
    assert [f"{name} [{flown.units[name]}]" for name in flown.columns[:-1]] == numbers
    assert flown.columns[-1] == "seconds" and flown.units["seconds"] == "s"
    assert list(flown) == list(flown.columns) and len(flown) == 40 and "peak" in flown
    assert flown.members.tolist() == [int(row[0]) for row in rows[1:]] == list(range(40))
    for name in flown.columns[:-1]:
        place = rows[0].index(f"{name} [{flown.units[name]}]")
        read = [float(row[place] or "nan") for row in rows[1:]]
        assert flown[name].dtype == np.float64 and np.array_equal(flown[name], read, equal_nan=True)
    assert flown.verdicts == [row[rows[0].index("verdict")] for row in rows[1:]]
    assert flown.reasons == [row[rows[0].index("reason")] for row in rows[1:]]


def test_columns_are_read_only_and_unknown_ones_named(flown):
    with pytest.raises(ValueError):
        flown["peak"][0] = 1.0
    with pytest.raises(KeyError, match="did you mean `peak`"):
        flown["peek"]
    with pytest.raises(tc.InputError):
        flown[0]


def test_pandas_is_as_the_csv_reads(flown, program, tmp_path):
    pandas = pytest.importorskip("pandas")
    flown.save(tmp_path)
    read = pandas.read_csv(tmp_path / "campaign.csv", index_col="member")
    pandas.testing.assert_frame_equal(flown.to_pandas(), read, check_exact=True)


def test_xarray_is_as_the_netcdf_file_opens(flown, tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    flown.save(tmp_path)
    if not (tmp_path / "campaign.nc").exists():
        pytest.skip("the library was built without netCDF")
    ours = flown.to_xarray()
    with xarray.open_dataset(tmp_path / "campaign.nc", engine="h5netcdf") as theirs:
        xarray.testing.assert_identical(ours, theirs.load())


def test_units_of_netcdf_are_products():
    model = tc.loads(
        "{format: spacecraft/1, name: x, hub: {mass: 1 kg, inertia: [1, 1, 1]},"
        " loads: [{name: f, force: [0.1 N, 0, 0]}], simulation: {step: 0.1 s, duration: 1 s},"
        " campaign: {members: 2, dispersions: [{set: hub.mass, normal: {sigma: 1 %}}],"
        " outputs: [{name: v, of: v_BN_N.x, reduce: final}]}}")
    pytest.importorskip("xarray")
    assert model.campaign(engine="bsm").to_xarray()["v"].attrs["units"] == "m s-1"


def test_worst_members_are_the_reports(flown):
    of_peak = [one["member"] for one in flown.report["campaign"]["worst"] if one["output"] == "peak"]
    assert flown.worst() == flown.worst(5, by="peak") == of_peak
    assert flown.worst(2) == of_peak[:2] and flown.worst(0) == []
    assert len(flown.worst(1000)) == 39  # those that were flown
    largest = np.argsort(-flown["rate_end"], kind="stable")[:3]
    assert flown.worst(3, by="rate_end") == flown.members[largest].tolist()
    with pytest.raises(tc.InputError, match="did you mean `peak`"):
        flown.worst(by="peek")
    with pytest.raises(ValueError):
        flown.worst(-1)


def test_it_shows_itself(flown):
    assert repr(flown) == "<twincraft.Campaign thrown, 40 members, failed>"
    assert "<script" not in flown._repr_html_() and "crossing" in flown._repr_html_()


# --- members


def test_a_member_flies_as_it_was_kept(flown, program, tmp_path):
    member = flown.member(3)
    assert member == flown.model.member(3) == pickle.loads(pickle.dumps(member))
    run = member.run()
    run.save(tmp_path)
    for name in ("bsm.csv", "mujoco.csv"):
        assert (tmp_path / name).read_bytes() == (program / "0003" / name).read_bytes()
    assert np.abs(run.bsm["wing_p.1.position"]).max() == flown["peak"][3]
    assert "hub.mass" in run.report["members"][0]["settings"]
    with pytest.raises(tc.SpecError):
        member.campaign()


def test_what_is_no_vehicle_is_no_member(flown):
    failed = flown.verdicts.index("failed")
    with pytest.raises(tc.SpecError, match="must be positive") as caught:
        flown.member(failed)
    assert caught.value.diagnostics
    for i in (-1, 40):
        with pytest.raises(tc.InputError):
            flown.member(i)


def test_a_pickled_model_flies_the_same_campaign(model, flown):
    assert table_of(pickle.loads(pickle.dumps(model)).campaign()) == table_of(flown)


# --- engines, instructions, threads


def test_engines_are_those_asked_for(spec, model, flown):
    alone = model.campaign(engine="bsm")
    assert set(alone.verdicts) == {"failed", "not_judged"}
    both = tc.load(spec, set={"campaign.members": 4}).campaign(engine="both")
    assert both.verdicts == ["agree"] * 4
    assert np.array_equal(alone["peak"], flown["peak"], equal_nan=True)
    with pytest.raises(ValueError, match="both"):
        model.campaign(engine="mujoco")


def test_instructions_are_those_asked_for(model):
    portable = model.campaign(isa="portable", jobs=2)
    assert "x86-64" in json.dumps(portable.report["provenance"]["instructions"])
    with pytest.raises(tc.InputError, match="portable"):
        model.campaign(isa="sse9")


def test_other_threads_go_on(spec, model):
    long = tc.load(spec, set={"simulation.duration": 60})
    passed: list[int] = []
    flying = threading.Thread(target=lambda: passed.append(len(long.campaign(engine="bsm"))))
    flying.start()
    turns = 0
    while flying.is_alive():
        turns += 1
    assert passed == [40] and turns > 100


INTERRUPTED = """
import os, signal, sys, threading
import twincraft as tc
m = tc.load(sys.argv[1], set={"simulation.duration": 100, "campaign.members": 100000})
signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job begins without
threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    m.campaign(folder=sys.argv[2])
except KeyboardInterrupt:
    print("interrupted")
print(len(tc.load(sys.argv[1]).campaign()))
"""


def test_ctrl_c_ends_it_and_keeps_what_was_flown(spec, tmp_path):
    done = python(INTERRUPTED, str(spec), str(tmp_path), timeout=60)
    assert done.stdout.split() == ["interrupted", "40"], done.stderr
    assert len((tmp_path / "shards" / "1-of-1.records").read_bytes().splitlines()) > 2
    assert json.loads((tmp_path / "report.json").read_text())["complete"] is False


# --- going on


def test_resume_goes_on_with_what_is_there(spec, model, program, tmp_path):
    fewer = tc.load(spec, set={"campaign.members": 17})
    assert len(fewer.campaign(folder=tmp_path)) == 17
    before = (tmp_path / "shards" / "1-of-1.records").read_bytes()
    assert len(model.campaign(folder=tmp_path, resume=True)) == 40
    assert (tmp_path / "shards" / "1-of-1.records").read_bytes().startswith(before)
    ours, theirs = timeless(tmp_path), timeless(program)
    assert ours["campaign.csv"] == theirs["campaign.csv"]


def test_results_of_another_spec_are_not_gone_on_with(spec, model, tmp_path):
    tc.load(spec, set={"campaign.seed": 4}).campaign(
        folder=tmp_path)
    before = files_of(tmp_path)
    with pytest.raises(OSError, match="another") as caught:
        model.campaign(folder=tmp_path, resume=True)
    assert isinstance(caught.value, tc.FileError) and files_of(tmp_path) == before


# --- executors


class InReverse:
    """Flies every task twice, and the last first, when a result is asked for."""

    def __init__(self) -> None:
        self.tasks: list[Callable[[], Any]] = []
        self.results: dict[int, Any] = {}

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Any:
        carried = pickle.loads(pickle.dumps((fn, args)))
        place = len(self.tasks)
        self.tasks.append(lambda: carried[0](*carried[1]))
        return SimpleNamespace(result=lambda: self.fly()[place])

    def fly(self) -> dict[int, Any]:
        for place in reversed(range(len(self.tasks))):
            if place not in self.results:
                self.tasks[place]()
                self.results[place] = self.tasks[place]()
        return self.results


def test_any_executor_will_do(model, flown):
    executor = InReverse()
    assert table_of(model.campaign(executor, tasks=9)) == table_of(flown)
    assert len(executor.tasks) == 9
    with ThreadPoolExecutor(2) as threads:
        assert table_of(model.campaign(threads, tasks=3, jobs=2)) == table_of(flown)


def test_tasks_are_neither_tiny_nor_more_than_members(spec, model):
    for tasks, expected in ((None, 1), (1000, 40)):
        executor = InReverse()
        model.campaign(executor, tasks=tasks, engine="bsm")
        assert len(executor.tasks) == expected
    long = tc.load(spec, set={"simulation.duration": 4000, "campaign.members": 64})
    assert campaign._tasks_of(long) == 4
    many = tc.load(spec, set={"simulation.duration": 4000, "campaign.members": 1_000_000})
    assert campaign._tasks_of(many) == 10_000


def fail(model: tc.Model, shard: int, *how: Any) -> bytes:
    if shard == 3:
        raise ArithmeticError("no luck")
    return campaign._fly_shard(model, shard, *how)


def die(model: tc.Model, shard: int, *how: Any) -> bytes:
    if shard == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return campaign._fly_shard(model, shard, *how)


class Instead:
    """Flies another function than is asked for."""

    def __init__(self, pool: Executor, function: Callable[..., bytes]) -> None:
        self.pool, self.function, self.futures = pool, function, list[Any]()

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Any:
        self.futures.append(self.pool.submit(self.function, *args))
        return self.futures[-1]


def test_what_a_task_raises_comes_through_and_nothing_is_written(model, tmp_path):
    with ThreadPoolExecutor(1) as threads:
        executor = Instead(threads, fail)
        with pytest.raises(ArithmeticError, match="no luck") as caught:
            model.campaign(executor, tasks=20, folder=tmp_path)
    assert "2 of 20 tasks" in caught.value.__notes__[0]
    assert all(future.done() for future in executor.futures)
    assert not list(tmp_path.iterdir())


def test_a_killed_process_breaks_its_pool_and_nothing_is_written(model, flown, tmp_path):
    with ProcessPoolExecutor(2) as pool, pytest.raises(BrokenProcessPool) as caught:
        model.campaign(Instead(pool, die), tasks=6, folder=tmp_path)
    assert "of 6 tasks done; no file was written" in caught.value.__notes__[0]
    assert not list(tmp_path.iterdir())
    with ProcessPoolExecutor(2) as another:
        assert table_of(model.campaign(another, tasks=6)) == table_of(flown)


def test_ctrl_c_gives_up_the_tasks(model, tmp_path):
    def interrupt(*how: Any) -> bytes:
        if how[1] == 2:
            raise KeyboardInterrupt
        return campaign._fly_shard(*how)

    with ThreadPoolExecutor(1) as threads:
        executor = Instead(threads, interrupt)
        with pytest.raises(KeyboardInterrupt) as caught:
            model.campaign(executor, tasks=40, folder=tmp_path)
    assert "1 of 40 tasks" in caught.value.__notes__[0]
    assert any(future.cancelled() for future in executor.futures) and not list(tmp_path.iterdir())


def test_a_worker_of_another_version_is_refused(model):
    with ThreadPoolExecutor(1) as threads:
        other = Instead(threads, lambda *how: campaign._fly_shard(*how[:-1], "0.0.9"))
        with pytest.raises(tc.Error, match="twincraft 0.0.9"):
            model.campaign(other, tasks=2)


def test_records_of_another_spec_are_refused(spec, model, tmp_path):
    other = tc.load(spec, set={"campaign.seed": 4})
    with ThreadPoolExecutor(1) as threads:
        wrong = Instead(threads, lambda _, *how: campaign._fly_shard(other, *how))
        with pytest.raises(tc.FileError, match="another"):
            model.campaign(wrong, tasks=2, folder=tmp_path)
    assert not list(tmp_path.iterdir())


# --- mistakes


def test_a_spec_without_a_campaign_has_none(m):
    for executor in (None, InReverse()):
        with pytest.raises(tc.SpecError, match="`wheels_and_panels` has no `campaign`"):
            m.campaign(executor)
    with pytest.raises(tc.SpecError, match="no `campaign`"):
        m.member(0)


def test_mistakes_are_named_before_anything_is_flown(model, tmp_path):
    (tmp_path / "file").write_text("")
    for error, arguments in (
        (TypeError, {"executor": 3}),
        (ValueError, {"jobs": 0}),
        (ValueError, {"tasks": -1, "executor": InReverse()}),
        (ValueError, {"tasks": 2}),
        (ValueError, {"folder": ""}),
        (ValueError, {"resume": True}),
        (ValueError, {"resume": True, "folder": tmp_path, "executor": InReverse()}),
        (tc.FileError, {"folder": tmp_path / "file" / "out"}),
        (tc.FileError, {"folder": tmp_path / "file" / "out", "executor": InReverse()}),
    ):
        with pytest.raises(error):
            model.campaign(**arguments)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
