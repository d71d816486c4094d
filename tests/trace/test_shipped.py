"""The project's own requirements, with the traces that the source states."""

from __future__ import annotations

from pathlib import Path

import pytest

from rgss.documents import read_document
from rgss.findings import Severity
from rgss.requirements import RequirementSet, load_requirements
from rgss.trace import (
    MeasureKind,
    MeasureTrace,
    build_trace_model,
    check_trace,
    stakeholder_by_effectiveness,
    system_by_architecture,
    system_by_stakeholder,
)

ROOT = Path(__file__).parents[2]

NEEDS_OF_EFFECTIVENESS = {
    "P_max": ("STK-006", "STK-010", "STK-011", "STK-012"),
    "C_total": ("STK-021", "STK-095"),
    "t_e": ("STK-095",),
    "t_p": ("STK-006", "STK-011", "STK-012"),
    "S": ("STK-097",),
}
UNITS_OF_EFFECTIVENESS = {"P_max": "kg", "C_total": "USD", "t_e": "s", "t_p": "s", "S": "1"}
EFFECTIVENESS_OF_PERFORMANCE = {
    "P_max_m": ("kg", "P_max"),
    "v_m": ("m/s", "t_e"),
    "C_m": ("USD", "C_total"),
    "P_max_g": ("kg", "P_max"),
    "M_g": ("kg", "P_max"),
    "t_gc": ("s", "t_e"),
    "C_g": ("USD", "C_total"),
    "t_sp": ("s", "t_p"),
    "L": ("m", "t_e"),
    "C_al": ("USD", "C_total"),
}


@pytest.fixture(scope="module")
def requirements() -> RequirementSet:
    return load_requirements(ROOT / "requirements")


@pytest.fixture(scope="module")
def measures() -> list[MeasureTrace]:
    """The measures as their file states them, read here without the package that computes them."""
    document = read_document(ROOT / "requirements" / "measures.yaml", label="requirements/measures.yaml")
    found = []
    for index, entry in enumerate(document.data["measures"]):
        line, column = document.values["measures", index, "id"]
        found.append(
            MeasureTrace(
                id=entry["id"],
                kind=MeasureKind(entry["kind"]),
                unit=entry["unit"],
                traces=tuple(entry.get("traces", ())),
                contributes_to=tuple(entry.get("contributes_to", ())),
                observed=entry["id"] == "S",
                file=document.label,
                line=line,
                column=column,
            )
        )
    return found


@pytest.mark.verifies("SYS-030")
def test_the_project_is_clean(requirements, measures):
    findings = check_trace(requirements, measures)
    assert [str(finding) for finding in findings if finding.severity is not Severity.INFO] == []


def test_elements_that_satisfy_nothing_are_listed(requirements, measures):
    idle = [finding for finding in check_trace(requirements, measures) if finding.rule == "trace.idle-element"]
    listed = {finding.message.split("'")[1] for finding in idle}
    satisfying = {element for item in requirements.system for element in item.satisfied_by}
    elements = {element.id for element in requirements.architecture.elements}
    assert listed == elements - satisfying
    assert listed >= {"BLK-camera", "BLK-pneumatic-actuator", "BLK-manipulator-screw-joint"}


@pytest.mark.parametrize("measure", NEEDS_OF_EFFECTIVENESS)
def test_measures_of_effectiveness_trace_as_the_source_says(requirements, measures, measure):
    matrix = stakeholder_by_effectiveness(build_trace_model(requirements, measures))
    assert tuple(row for row in matrix.rows if measure in matrix.linked_to_row(row)) == NEEDS_OF_EFFECTIVENESS[measure]


def test_measures_of_performance_contribute_as_the_source_says(measures):
    stated = {item.id: (item.unit, *item.contributes_to) for item in measures if item.kind is MeasureKind.MOP}
    assert stated == EFFECTIVENESS_OF_PERFORMANCE


def test_units_of_the_measures_of_effectiveness(measures):
    stated = {item.id: item.unit for item in measures if item.kind is MeasureKind.MOE}
    assert stated == UNITS_OF_EFFECTIVENESS


def test_no_matrix_has_an_empty_row(requirements, measures):
    model = build_trace_model(requirements, measures)
    for matrix in (stakeholder_by_effectiveness(model), system_by_stakeholder(model), system_by_architecture(model)):
        assert [row for row in matrix.rows if not matrix.linked_to_row(row)] == []


def test_every_need_has_a_requirement_and_every_measure_a_need(requirements, measures):
    model = build_trace_model(requirements, measures)
    for matrix in (stakeholder_by_effectiveness(model), system_by_stakeholder(model)):
        assert matrix.empty_columns == ()


def test_a_criterion_on_a_measure_of_effectiveness_derives_from_the_needs_it_stands_for(requirements):
    for requirement in requirements.system:
        if requirement.criterion is not None and requirement.criterion.measure in NEEDS_OF_EFFECTIVENESS:
            assert requirement.derived_from == NEEDS_OF_EFFECTIVENESS[requirement.criterion.measure], requirement.id
