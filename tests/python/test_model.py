"""Loading, texts, identity, transport of models."""

from __future__ import annotations

import copy
import hashlib
import os
import pickle
import subprocess
import warnings

import numpy as np
import pytest
from conftest import ROOT, SPEC, program, pushed, python

import twincraft as tc

WARNED = ROOT / "tests" / "malformed" / "load_after_the_run.yaml"  # it compiles, with a warning


def test_texts_are_the_files_of_the_compiler(m, tmp_path):
    subprocess.run(
        [program("sccompile"), "models/quickstart.yaml", "--emit", "mjcf,resolved", "-o", tmp_path],
        check=True,
    )
    assert m.mjcf == (tmp_path / f"{m.name}.xml").read_text()
    assert m.resolved == (tmp_path / f"{m.name}.resolved.yaml").read_text()
    assert m.digest == hashlib.sha256(m.resolved.encode()).hexdigest()


def test_names_have_units_in_the_order_of_columns(m, tmp_path):
    assert m.inputs == {"rw_x.torque": "N m", "rw_y.torque": "N m", "rw_z.torque": "N m"}
    header = ",".join(["t [s]", *(f"{n} [{u}]" for n, u in m.outputs.items())])
    m.run(engine="bsm").save(tmp_path)
    assert (tmp_path / "bsm.csv").read_text().splitlines()[0] == header
    assert list(m.states)[:8] == [
        "r_BN_N.x", "r_BN_N.y", "r_BN_N.z", "q_BN.w", "q_BN.x", "q_BN.y", "q_BN.z",
        "wing_p.1.position",
    ]
    assert m.degrees_of_freedom == 11


def test_its_dicts_are_copies(m):
    m.inputs.clear()
    assert m.inputs


def test_mass_properties_are_arrays(m):
    mass = m.mass_properties()
    assert mass.mass == pytest.approx(700.0)
    assert mass.center_of_mass.shape == (3,)
    assert mass.inertia.shape == (3, 3)
    assert np.array_equal(mass.inertia, mass.inertia.T)


def test_values_are_texts_numbers_bools_sequences_and_arrays():
    model = tc.load(
        SPEC,
        set={
            "simulation.step": "0.01 s",
            "simulation.duration": 2,
            "hub.mass": np.float64(500.0),
            "hub.inertia": np.array([400.0, 380.0, 360.0]),
            "initial.rate": ["1 deg/s", 0.0, 0],
            "engines.mujoco.compensate": False,
        },
    )
    assert model.step == 0.01
    assert model.duration == 2.0
    assert model.mass_properties().mass == pytest.approx(600.0)
    assert model.simulate().observe()["omega_BN_B"][0] == np.deg2rad(1.0)


def test_a_path_like_is_a_path():
    assert tc.load(SPEC) == tc.load(os.fspath(SPEC)) == tc.load("models/quickstart.yaml")


def test_faults_of_a_spec_are_the_terminals_text_and_objects():
    with pytest.raises(tc.SpecError) as caught:
        tc.loads("format: spacecraft/1\nname: x\nhub: {mass: 5 m, inertai: [1, 1, 1]}\n")
    error = caught.value
    assert isinstance(error, (tc.Error, ValueError))
    assert "<string>:3:" in str(error) and "^" in str(error)
    first = error.diagnostics[0]
    assert (first.severity, first.file, first.line) == ("error", "<string>", 3)
    assert first.code.startswith("SC") and first.column > 0 and first.end_column >= first.column
    assert isinstance(first.message, str) and isinstance(first.hint, str)
    assert len(list(first.notes)) >= 0
    assert str(pickle.loads(pickle.dumps(error))) == str(error)


def test_an_unknown_path_of_set_is_a_fault_of_the_spec():
    with pytest.raises(tc.SpecError, match="simulation.stpe"):
        tc.load(SPEC, set={"simulation.stpe": 1})


@pytest.mark.parametrize("value", [float("nan"), np.inf, object()])
def test_a_value_that_is_none_is_refused(value):
    with pytest.raises(tc.InputError, match="hub.mass"):
        tc.load(SPEC, set={"hub.mass": value})


def test_a_file_that_is_missing_is_an_os_error():
    with pytest.raises(OSError, match="nowhere.yaml") as caught:
        tc.load("nowhere.yaml")
    assert isinstance(caught.value, tc.Error)


def test_warnings_of_the_compiler_are_warnings():
    text = (ROOT / "models" / "quickstart.yaml").read_text()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tc.loads(text)
    with pytest.warns(tc.SpecWarning, match="warning") as record:
        tc.load(WARNED)
    assert record[0].filename == __file__


def test_a_model_is_immutable(m):
    with pytest.raises(AttributeError):
        m.name = "x"
    with pytest.raises(AttributeError):
        m.other = 1
    with pytest.raises(TypeError):
        tc.Model()


def test_equal_digests_are_equal_models(m):
    other = tc.load(SPEC)
    assert other == m and hash(other) == hash(m) and len({m, other}) == 1
    assert tc.load(SPEC, set={"hub.mass": 601.0}) != m
    assert tc.loads(m.resolved) == m


def test_copies_are_itself(m):
    assert copy.copy(m) is m and copy.deepcopy(m) is m


def test_it_pickles_into_another_process(m, tmp_path):
    (tmp_path / "m.pickle").write_bytes(pickle.dumps(m))
    done = python(
        "import pickle, sys; m = pickle.load(open(sys.argv[1], 'rb')); "
        "s = m.simulate(); s.step(50); print(m.digest, s.state.tobytes().hex())",
        str(tmp_path / "m.pickle"), check=True,
    )
    sim = m.simulate()
    sim.step(50)
    assert done.stdout.split() == [m.digest, sim.state.tobytes().hex()]


def test_a_pickle_of_another_model_is_refused(m):
    function, (resolved, _, version) = m.__reduce__()
    with pytest.raises(tc.Error, match="digest"):
        function(resolved, "0" * 64, version)


def test_it_shows_itself(m):
    assert "wheels_and_panels" in repr(m) and m.digest[:8] in repr(m)
    html = m._repr_html_()
    assert "11" in html and "700 kg" in html and "<script" not in html


def test_text_of_a_user_is_escaped():
    run = pushed().run()
    assert "<script" not in run._repr_html_()
    assert "<b>" + run.verdict in run._repr_html_()
