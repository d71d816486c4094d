"""An installation without the simulation engines: what reads works as with them, what simulates says what is missing.

The engines are hidden from a process of its own, as if only ``pip install rgss`` had been run.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from importlib.metadata import distributions

import pytest

from rgss.cli.main import main
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
EACH_OF = """
import json, os, sys, tempfile, traceback
from rgss.cli.main import main

sys.argv[0] = "rgss"

def ended(words):
    try:
        return main(words)
    except SystemExit as end:
        return end.code
    except BaseException:
        traceback.print_exc()
        return "raised"

own = os.dup(1)
told = []
for words in json.load(sys.stdin):
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        os.dup2(output.fileno(), 1)
        os.dup2(errors.fileno(), 2)
        status = ended(words)
        sys.stdout.flush()
        sys.stderr.flush()
        said = [os.pread(each.fileno(), os.fstat(each.fileno()).st_size, 0).decode() for each in (output, errors)]
    told.append((status, *said))
with open(own, "w", encoding="utf-8") as answers:
    json.dump(told, answers)
"""
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
CHECK = ["check"]
REPORT = ["report", "--out", "no_engines.html"]
SIMULATING = [["run", "1"], ["sweep"], ["sweep", "--dry-run"], ["replay", "1/1"], ["regress"], ["confirm"]]


def run_python(folder, script, *arguments, **options):
    return subprocess.run(
        [sys.executable, "-c", script, *arguments],
        cwd=folder,
        env={**os.environ, "LC_ALL": "C.UTF-8"},
        capture_output=True,
        encoding="utf-8",
        check=False,
        **options,
    )


def rgss(folder, *arguments, engines=True):
    return run_python(folder, MAIN if engines else WITHOUT_ENGINES + MAIN, *arguments)


@dataclass(frozen=True, kw_only=True)
class Told:
    """What a command wrote and how it ended."""

    status: int
    output: str
    errors: str


def told_by_each(folder, commands, *, engines):
    """What each of several commands says, one after the other in one process, whose imports they share."""
    words = json.dumps(commands)
    script = EACH_OF if engines else WITHOUT_ENGINES + EACH_OF
    done = run_python(folder, script, input=words)
    assert done.returncode == 0, done.stderr
    told = (Told(status=status, output=output, errors=errors) for status, output, errors in json.loads(done.stdout))
    return {tuple(command): each for command, each in zip(commands, told, strict=True)}


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """A small project with evidence, made with the engines."""
    folder = tmp_path_factory.mktemp("light") / "project"
    assert main(["init", str(folder)]) == 0
    assert main(["sweep", "--jobs", "1", "--project", str(folder)]) == 0
    return folder


@pytest.fixture(scope="module")
def full(project):
    """What the reading verbs say with the engines."""
    return told_by_each(project, [*READING, CHECK], engines=True)


@pytest.fixture(scope="module")
def light(project, full):
    """What all verbs say without the engines, after those that have them."""
    return told_by_each(project, [*READING, CHECK, REPORT, *SIMULATING], engines=False)


@pytest.mark.engine
@pytest.mark.parametrize("verb", READING, ids=" ".join)
def test_reading_verbs_give_the_same(full, light, verb):
    with_engines, without = full[tuple(verb)], light[tuple(verb)]

    assert without.errors == with_engines.errors
    assert without.output == with_engines.output
    assert without.status == with_engines.status
    assert without.status in (0, 1)


@pytest.mark.engine
def test_a_process_of_its_own_gives_the_same(project, light):
    done = rgss(project, "trade", engines=False)
    shared = light["trade",]

    assert (done.returncode, done.stdout, done.stderr) == (shared.status, shared.output, shared.errors)


@pytest.mark.engine
def test_the_check_leaves_the_scene_out(full, light):
    with_engines, without = full[tuple(CHECK)], light[tuple(CHECK)]
    skipped = "Skipped: the scene is not checked: coal is not installed (pip install 'rgss[sim]').\n"

    assert without.output == skipped + with_engines.output
    assert (without.status, without.errors) == (with_engines.status, "")


@pytest.mark.engine
def test_a_report_is_made_without_films(project, full, light):
    told = light[tuple(REPORT)]

    assert (told.status, told.errors) == (full[tuple(READING[-1])].status, "")
    page = (project / "no_engines.html").read_text(encoding="utf-8")
    assert "The report was made without films, which need the simulation engines (pip install" in page


@pytest.mark.engine
@pytest.mark.parametrize("verb", SIMULATING, ids=" ".join)
def test_simulating_verbs_say_what_is_missing(light, verb):
    told = light[tuple(verb)]

    assert told.status == 2
    assert told.output == ""
    assert told.errors == f"rgss: 'rgss {verb[0]}' needs the simulation engines, of which eaik, {LISTED}\n"


@pytest.mark.engine
def test_the_interface_says_what_is_missing(project):
    script = "import rgss\nstudy = rgss.load_study()\nprint(len(study.trials) > 0)\nstudy.{}"
    for call in ("sweep(jobs=0)", "trial(1, 1)"):
        run = run_python(project, WITHOUT_ENGINES + script.format(call))

        assert run.stdout == "True\n"
        assert run.stderr.splitlines()[-1].endswith(f"needs the simulation engines, of which eaik, {LISTED}")


@pytest.mark.engine
def test_without_evidence_the_sweep_is_named(tmp_path):
    commands = [["init", "empty"], ["trade", "--project", "empty"]]
    begun, light = told_by_each(tmp_path, commands, engines=False).values()

    assert begun.status == 0
    assert light.status == 2
    assert len(light.errors.splitlines()) == 1
    assert light.errors.endswith("(run 'rgss sweep --project empty' first)\n")


def test_the_extra_brings_every_engine():
    (own,) = (found for found in distributions() if found.metadata["Name"] == "rgss")
    of_sim = [line for line in own.requires or () if "extra == 'sim'" in line.replace('"', "'")]
    of_core = [line for line in own.requires or () if "extra ==" not in line]

    for name in set(DISTRIBUTIONS.values()):
        assert any(line.startswith(name) for line in of_sim), name
        assert not any(line.startswith((f"{name}=", f"{name}>")) for line in of_core), name
