"""Matrices of a small project."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.errors import DefinitionError
from rgss.requirements import (
    Architecture,
    NeedKind,
    Place,
    Priority,
    Requirement,
    RequirementGroup,
    RequirementSet,
    StakeholderNeed,
    Status,
)
from rgss.trace import (
    MeasureKind,
    TraceMatrix,
    build_trace_model,
    matrix_of,
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
        rows=("STK-1", "STK-2"), columns=("P", "C"), linked=((0, 1), (1,))
    )


def test_system_by_stakeholder_reaches_over_steps(model):
    assert system_by_stakeholder(model) == TraceMatrix(
        rows=("SYS-1", "SYS-2"), columns=("STK-1", "STK-2"), linked=((0,), (0, 1))
    )


def test_system_by_architecture(model):
    assert system_by_architecture(model) == TraceMatrix(
        rows=("SYS-1", "SYS-2"), columns=("BLK-1", "UC-1"), linked=((0,), (1,))
    )


def test_what_is_linked_to_a_row(model):
    assert stakeholder_by_effectiveness(model).linked_to_row("STK-2") == ("C",)


def test_what_has_no_link_is_named():
    matrix = matrix_of(["a", "b"], ["x", "y"], {"a": ["y", "y", "not a column"], "not a row": ["x"]})
    assert matrix == TraceMatrix(rows=("a", "b"), columns=("x", "y"), linked=((1,), ()))
    assert (matrix.empty_rows, matrix.empty_columns, matrix.link_count) == (("b",), ("x",), 1)


def test_a_row_that_is_not_there(model):
    with pytest.raises(DefinitionError, match="no row 'STK-3' \\(did you mean 'STK-2'"):
        stakeholder_by_effectiveness(model).linked_to_row("STK-3")


@given(
    size=st.integers(1, 12),
    links=st.lists(st.tuples(st.integers(0, 11), st.integers(0, 11)), max_size=40),
    roots=st.lists(st.tuples(st.integers(0, 11), st.integers(0, 3)), max_size=12),
)
def test_origins_are_those_of_a_walk_from_each_requirement(size, links, roots):
    """Also where requirements depend on themselves, which files may not, but a model may."""
    names, needs = [f"S{n}" for n in range(size)], [f"N{n}" for n in range(4)]
    parents = {name: [] for name in names}
    for low, high in links:
        parents[f"S{low % size}"].append(f"S{high % size}")
    for low, need in roots:
        parents[f"S{low % size}"].append(f"N{need}")

    def origins(name, seen):
        reached = set()
        for parent in parents.get(name, ()):
            if parent not in seen:
                reached |= {parent} | origins(parent, seen | {parent})
        return reached

    matrix = system_by_stakeholder(bare_model(names, needs, parents))

    for name in names:
        assert set(matrix.linked_to_row(name)) == {one for one in origins(name, {name}) if one.startswith("N")}


def bare_model(names, needs, parents):
    """A model whose requirements have ids and parents, and nothing else of their own."""
    requirements = tuple(replace(EXAMPLE, id=name, derived_from=tuple(parents[name])) for name in names)
    stakeholder = tuple(replace(EXAMPLE_NEED, id=need) for need in needs)
    places = dict.fromkeys([*names, *needs], Place(document=None, location=()))
    architecture = Architecture(blocks=(), behaviours=())
    whole = RequirementSet(stakeholder=stakeholder, system=requirements, architecture=architecture, places=places)
    return build_trace_model(whole, [])


EXAMPLE_NEED = StakeholderNeed(
    id="N",
    kind=NeedKind.DESIGN,
    text="The system shall move.",
    rationale="It waits.",
    source="interview",
    priority=Priority.LOW,
    status=Status.DRAFT,
    owner="cook",
)
EXAMPLE = Requirement(
    id="R",
    group=RequirementGroup.GRIPPER,
    text="The system shall move.",
    rationale="It waits.",
    source="interview",
    priority=Priority.LOW,
    status=Status.DRAFT,
    owner="cook",
)
