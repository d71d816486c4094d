"""Matrices of a small project."""

from __future__ import annotations

import pytest

from rgss.trace import (
    MeasureKind,
    TraceMatrix,
    stakeholder_by_effectiveness,
    system_by_architecture,
    system_by_stakeholder,
)

NEED = "  - {id: STK-2, kind: design, text: T, rationale: R, source: S, priority: low, status: draft, owner: O}\n"
REQUIREMENT = """\
  - id: SYS-2
    group: gripper
    text: The gripper shall open.
    rationale: A closed one holds on.
    source: catalogue
    priority: low
    status: draft
    owner: engineer
    derived_from: [SYS-1, STK-2]
    satisfied_by: [UC-1]
    verification: test
"""


@pytest.fixture
def model(project):
    project.append("stakeholder.yaml", NEED).append("system.yaml", REQUIREMENT)
    project.append("architecture.yaml", "behaviours:\n  - {id: UC-1, name: Lift, kind: use_case, text: Lifts.}\n")
    return project.add("C", MeasureKind.MOE, traces=("STK-1", "STK-2"), observed=True).model()


def test_stakeholder_by_effectiveness(model):
    assert stakeholder_by_effectiveness(model) == TraceMatrix(
        rows=("STK-1", "STK-2"), columns=("P", "C"), cells=((True, True), (False, True))
    )


def test_system_by_stakeholder_reaches_over_steps(model):
    assert system_by_stakeholder(model) == TraceMatrix(
        rows=("SYS-1", "SYS-2"), columns=("STK-1", "STK-2"), cells=((True, False), (True, True))
    )


def test_system_by_architecture(model):
    assert system_by_architecture(model) == TraceMatrix(
        rows=("SYS-1", "SYS-2"), columns=("BLK-1", "UC-1"), cells=((True, False), (False, True))
    )


def test_what_is_linked_to_a_row_and_to_a_column(model):
    matrix = stakeholder_by_effectiveness(model)
    assert matrix.linked_to_row("STK-2") == ("C",)
    assert matrix.linked_to_column("P") == ("STK-1",)
