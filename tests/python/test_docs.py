"""What the documents show runs: docstrings, docs/python.md, the examples and the notebook."""

from __future__ import annotations

import doctest
import importlib
import io
import re
import runpy
import subprocess
from contextlib import redirect_stdout
from pathlib import Path

import pytest
from conftest import ROOT

import twincraft as tc

MODULES = ["", "._model", "._batch", "._campaign", "._errors", "._overrides", "._run", "._trajectory"]


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_docstrings_run(name):
    module = importlib.import_module("twincraft" + name)
    failed, _ = doctest.testmod(module)
    assert failed == 0


def test_everything_public_has_a_docstring():
    for name in tc.__all__:
        item = getattr(tc, name)
        assert item.__doc__, name
        for member, value in vars(item).items():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert value.__doc__, f"{name}.{member}"


@pytest.mark.parametrize("name", ["docs/python.md", "README.md"])
def test_the_page_runs(name, tmp_path, monkeypatch):
    page = (ROOT / name).read_text()
    blocks = re.findall(r"(<!-- not run -->\n)?```python\n(.*?)```", page, re.DOTALL)
    (tmp_path / "models").symlink_to(ROOT / "models")
    monkeypatch.chdir(tmp_path)
    code = "\n".join(block for not_run, block in blocks if not not_run)
    with redirect_stdout(io.StringIO()) as out:
        exec(compile(code, name, "exec"), {"__name__": "__main__"})
    assert out.getvalue()


def output_of(name: str, *arguments: str) -> list[str]:
    with redirect_stdout(io.StringIO()) as out:
        runpy.run_path(str(ROOT / "examples" / "python" / name))["main"](*arguments)
    return out.getvalue().splitlines()


def test_mrp_feedback_points_the_vehicle():
    lines = output_of("mrp_feedback.py", "models/quickstart.yaml")
    rows = [[float.fromhex(number) for number in line.split()] for line in lines]
    assert len(rows) == 301 and rows[0][0] == 0.0 and rows[-1][0] == 30.0
    assert all(len(row) == 1 + len(tc.load("models/quickstart.yaml").states) for row in rows)
    names = list(tc.load("models/quickstart.yaml").states)
    rate = names.index("omega_BN_B.y") + 1
    assert abs(rows[-1][rate]) < 0.7 * abs(rows[0][rate])


@pytest.mark.parametrize(("compiler", "language"), [("cc", "c"), ("c++", "cpp")])
def test_the_same_controller_in_c_and_cpp_gives_the_same_bytes(compiler, language, tmp_path):
    package = Path(tc.__file__).parent
    built, bundled = package.parents[1] / "lib" / "libtwincraft.so", package / "libtwincraft.so.0"
    library = built if built.exists() else bundled
    program = tmp_path / "program"
    subprocess.run(
        [compiler, "-O2", "-ffp-contract=off", "-I", "runtime/api/include",
         f"examples/{language}/mrp_feedback.{language}", library, f"-Wl,-rpath,{library.parent}",
         "-o", program], check=True)
    other = subprocess.run([program, "models/quickstart.yaml"], check=True, capture_output=True,
                           text=True)
    assert other.stdout.splitlines() == output_of("mrp_feedback.py", "models/quickstart.yaml")


def test_deadband_holds_the_attitude():
    lines = output_of("deadband.py")
    assert lines[-1].startswith("held within")


def test_the_notebook_runs():
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    path = ROOT / "examples" / "notebook" / "closed_loop.ipynb"
    notebook = nbformat.read(path, as_version=4)
    client = nbclient.NotebookClient(
        notebook, timeout=300, kernel_name="python3",
        resources={"metadata": {"path": str(path.parent)}})
    client.execute()
    assert not any(cell.get("outputs") for cell in nbformat.read(path, as_version=4).cells)
