"""Runs, proofs, attributions and trajectories."""

from __future__ import annotations

import json
import re
import subprocess

import numpy as np
import pytest
from conftest import ROOT, SPEC, program, pushed

import twincraft as tc


@pytest.fixture(scope="module")
def run(m) -> tc.Run:
    return m.run()


def scsim(*arguments: object, code: int = 0) -> str:
    done = subprocess.run(
        [program("scsim"), *map(str, arguments)], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == code, done.stderr
    return done.stdout


def files_of(folder) -> dict[str, bytes]:
    """Files by name, without what differs from one run to the next: when, and the load."""
    def timeless(name: str, data: bytes) -> bytes:
        if not name.endswith((".json", ".html")):
            return data
        return re.sub(rb'("load_average": ?)[0-9.e+-]+', rb"\1", data)

    return {
        str(path.relative_to(folder)): timeless(path.name, path.read_bytes())
        for path in sorted(folder.rglob("*")) if path.is_file()
    }


@pytest.mark.parametrize("name", ["quickstart", "paper/variable_mass", "paper/studies/orbit_steps"])
def test_saved_files_are_those_of_the_program(name, tmp_path):
    spec = f"models/{name}.yaml"
    text = scsim(spec, "-o", tmp_path / "program", "--no-timing", "--quiet")
    run = tc.load(spec).run()
    run.save(tmp_path / "python")
    ours, theirs = files_of(tmp_path / "python"), files_of(tmp_path / "program")
    assert list(ours) == list(theirs) and "report.json" in ours
    for file, data in theirs.items():
        assert ours[file] == data, file
    assert text == "" or text in str(run) or str(run) in text


def test_text_is_the_terminals(run):
    assert str(run) == scsim("models/quickstart.yaml", "--no-timing")


def test_report_is_the_document(run, tmp_path):
    run.save(tmp_path / "out")
    assert run.report == json.loads((tmp_path / "out" / "report.json").read_text())
    assert run.report["verdict"] == run.verdict == "agree" and run
    assert run.report["format"] == "twincraft-report/1"


def test_a_verdict_raises_nothing():
    run = tc.load(SPEC, set={"agreement.attitude": 1e-25}).run()
    assert run.verdict == "disagree" and not run
    run = tc.load(SPEC, set={"simulation.step": "1 s"}).run()
    assert run.verdict == "unresolved" and not run


@pytest.mark.parametrize("engine", ["bsm", "mujoco"])
def test_an_engine_alone(m, engine):
    run = m.run(engine=engine)
    flown, other = (run.bsm, run.mujoco) if engine == "bsm" else (run.mujoco, run.bsm)
    assert len(flown.t) == 241 and other is None


def test_an_unknown_engine_is_refused(m):
    with pytest.raises(ValueError, match="bsm"):
        m.run(engine="all")


def test_timing_is_timed():
    run = tc.load(SPEC, set={"simulation.duration": 1}).run(timing=True)
    assert len(run.report["members"][0]["timing"]["bsm"]["trials_s"]) == 5


def test_a_folder_that_cannot_be_made_is_an_os_error(run, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError) as caught:
        run.save(tmp_path / "file" / "out")
    assert isinstance(caught.value, tc.Error)


def test_it_shows_itself(run):
    html = run._repr_html_()
    assert "agree" in html and "<script" not in html and "attitude" in html


def test_proof_and_attribution():
    model = pushed(torque="0.01 N m")
    proof = model.prove()
    assert proof and proof.verdict == "proved" and "proof" in str(proof) or str(proof)
    assert isinstance(proof.report, dict)
    found = model.attribute()
    assert isinstance(found.report, dict) and str(found) and found.verdict in (
        "explained", "unexplained")


# --- trajectories


def test_a_trajectory_is_a_mapping_of_arrays(run):
    bsm = run.bsm
    assert list(bsm)[:4] == ["r_BN_N", "v_BN_N", "q_BN", "omega_BN_B"]
    assert bsm["omega_BN_B"].shape == (241, 3) and bsm["q_BN"].shape == (241, 4)
    assert bsm["wing_p.1.position"].shape == bsm["omega_BN_B.x"].shape == bsm.t.shape == (241,)
    assert np.array_equal(bsm["omega_BN_B.y"], bsm["omega_BN_B"][:, 1])
    assert all(array.dtype == np.float64 for array in bsm.values())
    assert "q_BN.w" in bsm and "q_BN" in bsm and "nothing" not in bsm
    assert len(bsm) == len(list(bsm)) and dict(bsm).keys() == bsm.keys()
    assert bsm.units["omega_BN_B"] == bsm.units["omega_BN_B.x"] == "rad/s"
    assert bsm.units["t"] == "s" and bsm.units["mass"] == "kg" and bsm.units["q_BN"] == "1"
    with pytest.raises(KeyError, match="omega_BN_B"):
        bsm["omega_BN_C"]
    with pytest.raises(ValueError):
        bsm["omega_BN_B"][0, 0] = 1.0


def test_numbers_are_those_of_the_csv(run, tmp_path):
    pandas = pytest.importorskip("pandas")
    run.save(tmp_path / "out")
    for name in ("bsm", "mujoco"):
        read = pandas.read_csv(tmp_path / "out" / f"{name}.csv", index_col="t [s]")
        ours = getattr(run, name).to_pandas()
        pandas.testing.assert_frame_equal(ours, read, check_exact=True)


def test_xarray_is_as_the_netcdf_file_opens(tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    ours = tc.load("models/quickstart.yaml").run().bsm.to_xarray()
    assert ours["omega_BN_B"].dims == ("time", "xyz") and ours["q_BN"].dims == ("time", "wxyz")
    assert ours["omega_BN_B"].attrs["units"] == "rad s-1"
    done = subprocess.run(
        [program("scsim"), "models/quickstart.yaml", "-o", tmp_path / "out", "--netcdf",
         "--no-timing"], capture_output=True, text=True)
    if done.returncode == 2:
        pytest.skip("the programs were built without netCDF")
    with xarray.open_dataset(tmp_path / "out" / "bsm.nc", engine="h5netcdf") as theirs:
        xarray.testing.assert_equal(ours, theirs)
        for name in theirs.variables:
            assert ours[name].attrs == theirs[name].attrs, name
        for name, value in theirs.attrs.items():
            assert ours.attrs[name] == value, name


def test_a_run_after_a_run_is_the_same(m, run):
    again = m.run()
    assert np.array_equal(again.bsm["q_BN"], run.bsm["q_BN"])
    assert np.array_equal(again.mujoco["q_BN"], run.mujoco["q_BN"])
