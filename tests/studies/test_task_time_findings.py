"""A bound of the task's time is kept by the task, or `rgss check` says so."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from rgss.cli.main import main
from rgss.findings import Severity
from rgss.studies.checks.task_time_check import task_time_findings
from rgss.studies.project import load_project

REPOSITORY = Path(__file__).parents[2]
TASK = "time_limit: 90 s\n"


@pytest.fixture
def folder(tmp_path):
    for name in ("requirements", "designs", "scenes", "studies"):
        shutil.copytree(REPOSITORY / name, tmp_path / name)
    study = tmp_path / "studies" / "pick_place.yaml"
    text = study.read_text(encoding="utf-8")
    study.write_text(text.replace("\nscene:", "\ntask: scenes/tasks/pick_and_place.yaml\nscene:", 1), encoding="utf-8")
    return tmp_path


def limit(folder, text):
    path = folder / "scenes" / "tasks" / "pick_and_place.yaml"
    old = path.read_text(encoding="utf-8")
    assert TASK in old
    path.write_text(old.replace(TASK, text), encoding="utf-8")


@pytest.mark.parametrize("text", [TASK, "time_limit: 1.5 min\n", "time_limit: 30 s\n"])
def test_a_bound_that_the_task_keeps_has_no_finding(folder, text):
    limit(folder, text)
    assert tuple(task_time_findings(load_project(folder))) == ()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "task 'pick_and_place' states no time limit"),
        ("time_limit: 91 s\n", "task 'pick_and_place' may take 91 s"),
    ],
)
def test_a_bound_that_the_task_does_not_keep_is_a_warning(folder, text, said, capsys):
    limit(folder, text)
    (finding,) = task_time_findings(load_project(folder))

    assert (finding.rule, finding.severity) == ("measures.task-time", Severity.WARNING)
    assert finding.message == (
        f"t_e_simulated is declared to be at most 90 s, but {said}: a longer trial would be refused"
    )
    assert finding.hint == "state 'time_limit: 90 s' in the task's file, or remove 'most'"
    main(["check", "--project", str(folder)])
    assert "measures.task-time" in capsys.readouterr().out


@pytest.mark.parametrize("text", ["time_limit: 0 s\n", "time_limit: -1 s\n"])
def test_a_limit_that_is_not_positive_is_refused(folder, text, capsys):
    limit(folder, text)
    assert main(["check", "--project", str(folder)]) == 2
    assert "time_limit must be greater than zero [task.not-positive]" in capsys.readouterr().out
