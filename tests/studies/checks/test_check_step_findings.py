"""Findings about check steps that their own task violates."""

from __future__ import annotations

import pytest

import rgss.trials
from rgss.findings import Severity
from rgss.studies.project import load_project
from rgss.studies.scene_findings import check_scene

TASK = """task: own
steps:
  - move: {to: grasp_approach}
  - repeat:
      times: 2
      steps:
        - check: {name: away, near: {point: [0 m, 0 m, 0 m], within: 1 cm}}
  - move: {to: grasp}
  - grip: {}
  - move: {to: lift}
  - move: {to: place}
  - release: {}
  - check: {name: there, near: {point: [0 m, 0 m, 0 m], within: 1 cm}}
  - move: {to: place_approach}
"""


@pytest.fixture
def checked(folder, edit, monkeypatch):
    """Findings on the steps of a task that is checked without a search for grasps."""

    def check(text):
        (folder / "scenes/own.yaml").write_text(text, encoding="utf-8")
        edit("studies/pick_place.yaml", "\nscene: ", "\ntask: scenes/own.yaml\nscene: ")
        for name in ("hand_step_problems", "reach_problems"):
            monkeypatch.setattr(rgss.trials, name, lambda *_, **__: ())
        return [one for one in check_scene(load_project(folder)).findings if one.rule.startswith("task.")]

    return check


def test_each_condition_is_found_once_at_its_key(checked):
    away, near = checked(TASK)
    assert (away.rule, away.line, away.severity) == ("task.check-violated", 7, Severity.ERROR)
    assert away.message.startswith("'cycle_1.away' is violated even if every step is exact: the centre of cup is ")
    assert (near.rule, near.line) == ("task.check-violated", 13)
    assert near.message.startswith("'there' is violated even if every step is exact: the centre of cup is ")
    assert near.hint.startswith("move the check, or change the condition")
