"""The notebooks in studies/: kept with their outputs, of the public interface alone, and they run."""

from __future__ import annotations

import ast
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import nbformat
import pytest

import rgss
from rgss.decision.named_trials import naming_studies
from rgss.requirements import load_requirements
from rgss.trace.evidence.software import run_properties
from tests.fixtures.shipped_project import REPOSITORY, copy_as_shipped

from .conftest import ASKED
from .execution import METADATA

NOTEBOOKS = sorted((REPOSITORY / "studies").glob("*.ipynb"))
ALLOWED = {"rgss", "pandas", "matplotlib.pyplot", "pathlib", "shutil", "tempfile"}
LONGEST = 26
FEWEST_PICTURES, LARGEST_BYTES = 6, 1_000_000
NUMBER = re.compile(r"-?\d+\.?\d*(?:e[+-]?\d+)?")
WIDEST = 88
"""Longer lines of code are cut, or need to be scrolled, where notebooks are shown as pages."""


def notebook(path):
    return nbformat.read(path, as_version=4)


def codes(path):
    return [cell.source for cell in notebook(path).cells if cell.cell_type == "code"]


@pytest.fixture
def run(tmp_path):
    """Runs a notebook of a copy of the project, with settings of its own and no network."""
    folder = copy_as_shipped(tmp_path / "project")
    own = {"IPYTHONDIR": "ipython", "JUPYTER_CONFIG_DIR": "jupyter", "JUPYTER_DATA_DIR": "data", "MPLCONFIGDIR": "mpl"}
    environment = {name: value for name, value in os.environ.items() if name != "MPLBACKEND"}
    environment |= {name: str(tmp_path / value) for name, value in own.items()}
    environment["PYTHONWARNINGS"] = "error::FutureWarning,error::DeprecationWarning:__main__"

    def execute(name):
        path = folder / "studies" / name
        # The name of a socket may have a hundred characters and no more.
        with tempfile.TemporaryDirectory(prefix="nb-") as sockets:
            command = [sys.executable, str(Path(__file__).with_name("execution.py")), str(path), sockets]
            done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return notebook(path)

    return execute


def test_there_are_three():
    assert [path.name for path in NOTEBOOKS] == ["own_gripper.ipynb", "trade_off.ipynb", "validation.ipynb"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_whole_run_is_kept(path):
    """Readers see results without running anything; `make notebooks` renews them."""
    text = path.read_text(encoding="utf-8")
    document = json.loads(text)

    nbformat.validate(nbformat.from_dict(document))
    assert (document["nbformat"], document["metadata"]) == (4, METADATA)
    for number, cell in enumerate(document["cells"], start=1):
        assert (cell["id"], cell["metadata"]) == (f"cell-{number:02}", {})
    ran = [cell["execution_count"] for cell in document["cells"] if cell["cell_type"] == "code"]
    assert ran == list(range(1, len(ran) + 1))
    assert text == nbformat.writes(notebook(path)) + "\n"
    assert pictures(notebook(path).cells) >= FEWEST_PICTURES
    assert len(text) < LARGEST_BYTES
    for place in (str(REPOSITORY), str(Path.home()), tempfile.gettempdir()):
        assert f"{place}/" not in text


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_they_are_short_and_explained(path):
    cells = notebook(path).cells

    assert cells[0].cell_type == "markdown"
    assert cells[0].source.startswith("# ")
    assert len(cells) <= LONGEST
    assert max(len(source.splitlines()) for source in codes(path)) <= LONGEST
    assert max(len(line) for source in codes(path) for line in source.splitlines()) <= WIDEST


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_only_the_public_interface_is_used(path):
    tree = ast.parse("\n".join(codes(path)))
    imported = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    imported |= {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    attributes = [node for node in ast.walk(tree) if isinstance(node, ast.Attribute)]
    of_rgss = {node.attr for node in attributes if isinstance(node.value, ast.Name) and node.value.id == "rgss"}

    assert imported <= ALLOWED
    assert "rgss" in imported
    assert of_rgss <= set(rgss.__all__)
    assert [node.attr for node in attributes if node.attr.startswith("_")] == []


@pytest.mark.engine
def test_the_trade_off(run):
    cells = run("trade_off.ipynb").cells
    said = [shown(cell) for cell in cells if cell.cell_type == "code"]

    assert "72 variants × 2 seeds, kinematic fidelity" in said[0]
    assert "enumeration agrees" in said[4]
    assert_as_kept("trade_off.ipynb", cells)


@pytest.mark.engine
def test_the_validation(run):
    cells = run("validation.ipynb").cells
    said = [shown(cell) for cell in cells if cell.cell_type == "code"]

    assert "bench_kg" in said[1]
    assert "1000 Hz" in said[3]
    assert_as_kept("validation.ipynb", cells)


@pytest.mark.engine
def test_the_own_gripper(run):
    cells = run("own_gripper.ipynb").cells
    said = [shown(cell) for cell in cells if cell.cell_type == "code"]

    assert "108 variants" in said[3]
    assert "four" in said[5]
    assert "failed" not in said[-3]
    assert_as_kept("own_gripper.ipynb", cells)


def shown(cell):
    return "\n".join(output.get("data", {}).get("text/plain", output.get("text", "")) for output in cell.outputs)


def assert_as_kept(name, cells):
    """The outputs are those that are kept: the words, the numbers to four digits, the texts of the figures."""
    kept = [shown(cell) for cell in notebook(REPOSITORY / "studies" / name).cells if cell.cell_type == "code"]
    again = [shown(cell) for cell in cells if cell.cell_type == "code"]
    for before, now in zip(kept, again, strict=True):
        assert NUMBER.sub("0", now) == NUMBER.sub("0", before)
        numbers = [[float(number) for number in NUMBER.findall(text)] for text in (now, before)]
        assert numbers[0] == pytest.approx(numbers[1], rel=1e-4, abs=1e-6)
    assert pictures(cells) == pictures(notebook(REPOSITORY / "studies" / name).cells)


def pictures(cells):
    return sum("image/png" in output.get("data", {}) for cell in cells for output in cell.get("outputs", ()))


def test_a_notebook_is_no_input(changeable, told):
    """Nothing becomes stale by it, no study is looked for in it, and the tests are not of another software."""

    def known():
        studies = naming_studies(changeable, {"kinematic": [1, 2]})
        frames = rgss.load_study(changeable, **ASKED)
        system = load_requirements(changeable / "requirements").system
        return (
            [study.file for study in studies],
            [study.all for study in studies],
            told("check", "--project", changeable, "--json"),
            run_properties(changeable, system),
            frames.trials.to_csv(),
            frames.verdicts.to_csv(),
        )

    before = known()
    (changeable / "studies/trade_off.ipynb").write_text("{}", encoding="utf-8")
    (changeable / "studies/another.ipynb").write_text("no notebook", encoding="utf-8")
    os.utime(changeable / "studies/validation.ipynb", (0, 0))

    assert known() == before
    assert before[0] == sorted(f"studies/{path.name}" for path in (changeable / "studies").glob("*.yaml"))
