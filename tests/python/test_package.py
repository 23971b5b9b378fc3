"""Docstrings, the typed stub, and the example."""
import inspect
import pathlib
import subprocess
import sys

import laneloom
from conftest import run

EXAMPLE = pathlib.Path(__file__).parents[2] / "tools" / "examples" / "python" / "rate_network.py"


def test_everything_public_has_a_docstring():
    for name in laneloom.__all__:
        public = getattr(laneloom, name)
        if name != "__version__":
            assert inspect.getdoc(public), name


def test_everything_that_is_imported_is_public():
    core = {name for name in vars(laneloom) if hasattr(laneloom._core, name) and not name.startswith("__")}
    assert core <= set(laneloom.__all__), core - set(laneloom.__all__)


def test_the_version_is_that_of_the_program():
    assert laneloom.__version__ in run("--version").stdout


def test_the_stub_says_what_is_there(tmp_path):
    checked = subprocess.run([sys.executable, "-m", "mypy.stubtest", "--concise", "laneloom"], cwd=tmp_path,
                             capture_output=True, text=True)
    # What all classes of pybind11 are, and names of types that only the stub has. What is public is looked at.
    of_pybind11 = ("metaclass differs", '.__init__ is inconsistent, stub does not have *args argument "args"',
                   '.__init__ is inconsistent, stub does not have **kwargs argument "kwargs"')
    wrong = [line for line in checked.stdout.splitlines() if not any(what in line for what in of_pybind11)
             and not (line.startswith("laneloom._core.") and line.endswith("not present at runtime"))]
    assert not wrong, wrong
    assert "laneloom.Config " in checked.stdout, checked.stdout + checked.stderr  # it was looked at


def test_the_example_rates_a_network(drive):
    picture = drive.folder / "picture.png"
    rated = subprocess.run([sys.executable, EXAMPLE, drive.truth, drive.frames, picture], check=True,
                           capture_output=True, text=True).stdout.splitlines()
    raw, fused = (float(line.split("F1 ")[1].split(",")[0]) for line in rated if "F1 " in line)
    assert fused > raw > 0.3
    way = next(i for i, line in enumerate(rated) if line.startswith("way: "))
    assert all("heading" in line for line in rated[way + 1:way + 4])
    assert picture.exists()


def test_the_example_is_typed_as_the_stub_says(tmp_path):
    checked = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", tmp_path,
                              EXAMPLE], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr
