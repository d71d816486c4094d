"""Hints on failures name what to change and the file."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from rgss.cli.failure_hints import failure_hint
from rgss.evidence import Failure

PROJECT = SimpleNamespace(
    study=SimpleNamespace(label="studies/a.yaml", design_space="designs/b.yaml", scene="scenes/c.yaml")
)


@pytest.mark.parametrize(
    ("failure", "detail", "parts"),
    [
        (Failure.PLANNING_LIMIT, "", ("planning.time_limit in designs/b.yaml", "apart in scenes/c.yaml")),
        (
            Failure.TRACKING_ERROR,
            "the tool was 4 mm from its target; at its torque limit: elbow",
            ("robot.tool_speed in designs/b.yaml", "torques there and the masses with rgss robot FILE"),
        ),
        (
            Failure.TRACKING_ERROR,
            "the tool was 2.1 mm from its target",
            ("physics.solver_iterations or physics.rate in studies/a.yaml", "control.tracking_limit in studies/a.yaml"),
        ),
    ],
)
def test_a_failure_has_a_hint_with_the_file(failure, detail, parts):
    hint = failure_hint(SimpleNamespace(failure=failure, failure_detail=detail), PROJECT)

    assert all(part in hint for part in parts)


def test_other_failures_have_none():
    assert failure_hint(SimpleNamespace(failure=Failure.OBJECT_DROPPED, failure_detail=""), PROJECT) == ""
