"""``rgss trade`` on modelling assumptions: trials that lack are counted, run where asked for, and decided by."""

from __future__ import annotations

import pytest

from rgss.evidence import EvidenceStore
from rgss.studies import load_project
from tests.fixtures.shipped_project import copy_project


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--what-if", "physics.rate=480 Hz"], "the suppositions need 216 trials of 216 that were not run (add --run"),
        (["--what-if", "planning.limit=5 s"], "unknown input 'planning.limit' (did you mean planning.time_limit"),
        (["--what-if", "planning.charge_per_check=5 m"], "unit 'm' does not measure what 's' measures"),
        (["--jobs", "2"], "--jobs needs --run"),
        (["--run", "--jobs", "0"], "--jobs must be at least 1, got 0"),
    ],
)
def test_what_cannot_be_answered_is_one_line(rgss, with_evidence, words, said):
    told = rgss("trade", "--brief", *words, "--project", with_evidence)

    assert (told.status, told.output) == (2, "")
    assert said in told.errors
    assert told.errors.count("\n") == 1


@pytest.mark.engine
def test_a_row_is_run_once_and_then_decided_by(rgss, tmp_path):
    """Kinematic trials of few designs, whose planning limit is all that differs."""
    folder = copy_project(tmp_path / "project")
    space = folder / "designs" / "grasping_system.yaml"
    lines = space.read_text(encoding="utf-8").splitlines(keepends=True)
    for planner in ("rrt", "trrt"):
        place = lines.index(f"      - id: {planner}\n")
        del lines[place : place + 2]
    space.write_text("".join(lines), encoding="utf-8")
    project = load_project(folder)
    words = ("--fidelity", "kinematic", "--replicates", 1, "--project", folder)
    assert rgss("sweep", *words, "--jobs", 1).status == 0
    with EvidenceStore.open(project.evidence) as store:
        before = len(store)
    supposed = ("--brief", "--what-if", "planning.resolution=0.06 rad", "--json")
    lacking = rgss("trade", *supposed, *words)
    ran = rgss("trade", *supposed, "--run", "--jobs", 1, *words)
    again = rgss("trade", *supposed, *words)
    with EvidenceStore.open(project.evidence) as store:
        after = len(store)

    assert lacking.status == 2
    assert ran.document["what_if"]["settings"][0]["id"] == "planning.resolution"
    assert after == 2 * before
    assert again.document == ran.document
