"""An installation without the simulation engines: what reads works as with them, what simulates says what is missing.

The engines are hidden from a process of its own, as if only ``pip install rgss`` had been run.
"""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.metadata import distributions

import pytest

from rgss.engines import DISTRIBUTIONS

HIDDEN = [*DISTRIBUTIONS, "pybullet_data", "cmeel"]
WITHOUT_ENGINES = f"""
import importlib.abc, importlib.metadata, sys

class Absent(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {HIDDEN!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Absent())
found = importlib.metadata.version

def version(name):
    if name in {[*DISTRIBUTIONS.values(), "coal"]!r}:
        raise importlib.metadata.PackageNotFoundError(name)
    return found(name)

importlib.metadata.version = version
"""
MAIN = "import sys; sys.argv[0] = 'rgss'; from rgss.cli.main import main; sys.exit(main())"
LISTED = "ompl, pin, pybullet, toppra are not installed (pip install 'rgss[sim]')"

READING = [
    ["variants"],
    ["trace", "SYS-2"],
    ["trace", "--output", "trace.html"],
    ["measure"],
    ["trade"],
    ["trade", "--section"],
    ["trade", "--what-if", "weight.cost=0.5"],
    ["evidence"],
    ["evidence", "verify"],
    ["evidence", "export", "trials.csv"],
    ["evidence", "export", "trials_of_study.csv", "studies/pick_place.yaml"],
    ["evidence", "gc", "--dry-run"],
    ["export", "csv", "--output", "requirements.csv"],
    ["export", "reqif", "--output", "requirements.reqif"],
    ["export", "sysml", "--output", "model.sysml"],
    ["export", "ompl", "--output", "planners.db"],
    ["schema", "--out", "schemas"],
    ["completion", "bash"],
    ["check", "--explain", "wording.R7"],
    ["report", "--no-film", "--out", "report.html"],
]
SIMULATING = [["run", "1"], ["sweep"], ["sweep", "--dry-run"], ["replay", "1/1"], ["regress"], ["confirm"]]


def rgss(folder, *arguments, engines=True):
    script = MAIN if engines else WITHOUT_ENGINES + MAIN
    return subprocess.run(
        [sys.executable, "-c", script, *arguments],
        cwd=folder,
        env={**os.environ, "LC_ALL": "C.UTF-8"},
        capture_output=True,
        encoding="utf-8",
        check=False,
    )


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """A small project with evidence, made with the engines."""
    folder = tmp_path_factory.mktemp("light") / "project"
    for words, where in ((["init", str(folder)], folder.parent), (["sweep"], folder)):
        made = rgss(where, *words)
        assert made.returncode == 0, made.stderr
    return folder


@pytest.mark.engine
@pytest.mark.parametrize("verb", READING, ids=" ".join)
def test_reading_verbs_give_the_same(project, verb):
    full, light = rgss(project, *verb), rgss(project, *verb, engines=False)

    assert light.stderr == full.stderr
    assert light.stdout == full.stdout
    assert light.returncode == full.returncode != 3


@pytest.mark.engine
def test_the_check_leaves_the_scene_out(project):
    full, light = rgss(project, "check"), rgss(project, "check", engines=False)
    skipped = "Skipped: the scene is not checked: coal is not installed (pip install 'rgss[sim]').\n"

    assert light.stdout == skipped + full.stdout
    assert (light.returncode, light.stderr) == (full.returncode, "")


@pytest.mark.engine
def test_a_report_is_made_without_films(project):
    light = rgss(project, "report", "--out", "no_engines.html", engines=False)

    assert (light.returncode, light.stderr) == (rgss(project, "report", "--no-film").returncode, "")
    page = (project / "no_engines.html").read_text(encoding="utf-8")
    assert "The report was made without films, which need the simulation engines (pip install" in page


@pytest.mark.engine
@pytest.mark.parametrize("verb", SIMULATING, ids=" ".join)
def test_simulating_verbs_say_what_is_missing(project, verb):
    light = rgss(project, *verb, engines=False)

    assert light.returncode == 2
    assert light.stdout == ""
    assert light.stderr == f"rgss: 'rgss {verb[0]}' needs the simulation engines, of which eaik, {LISTED}\n"


@pytest.mark.engine
def test_the_interface_says_what_is_missing(project):
    script = "import rgss\nstudy = rgss.load_study()\nprint(len(study.trials) > 0)\nstudy.{}"
    for call in ("sweep(jobs=0)", "trial(1, 1)"):
        run = subprocess.run(
            [sys.executable, "-c", WITHOUT_ENGINES + script.format(call)],
            cwd=project,
            capture_output=True,
            encoding="utf-8",
            check=False,
        )

        assert run.stdout == "True\n"
        assert run.stderr.splitlines()[-1].endswith(f"needs the simulation engines, of which eaik, {LISTED}")


@pytest.mark.engine
def test_without_evidence_the_sweep_is_named(tmp_path):
    assert rgss(tmp_path, "init", "empty", engines=False).returncode == 0
    light = rgss(tmp_path / "empty", "trade", engines=False)

    assert light.returncode == 2
    assert len(light.stderr.splitlines()) == 1
    assert light.stderr.endswith("(run the sweep first)\n")


def test_the_extra_brings_every_engine():
    (own,) = (found for found in distributions() if found.metadata["Name"] == "rgss")
    of_sim = [line for line in own.requires or () if "extra == 'sim'" in line.replace('"', "'")]
    of_core = [line for line in own.requires or () if "extra ==" not in line]

    for name in set(DISTRIBUTIONS.values()):
        assert any(line.startswith(name) for line in of_sim), name
        assert not any(line.startswith((f"{name}=", f"{name}>")) for line in of_core), name
