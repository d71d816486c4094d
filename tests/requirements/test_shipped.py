"""The project's own requirements."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rgss.evidence.outcomes import Phase
from rgss.requirements import (
    BehaviourKind,
    NeedKind,
    RequirementGroup,
    RequirementSet,
    VerificationMethod,
    load_requirements,
)

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def shipped() -> RequirementSet:
    return load_requirements(ROOT / "requirements")


def test_stakeholder_ids_are_those_of_the_source(shipped):
    ids = [need.id for need in shipped.stakeholder]
    assert ids == ["STK-006", "STK-010", "STK-011", "STK-012", "STK-021", "STK-095", "STK-097"]


def test_every_kind_of_need_and_every_group_of_requirements_occurs(shipped):
    assert {need.kind for need in shipped.stakeholder} == set(NeedKind)
    assert {requirement.group for requirement in shipped.system} == set(RequirementGroup)


def test_system_ids_are_numbered_in_the_order_of_the_file(shipped):
    assert [item.id for item in shipped.system] == [f"SYS-{n:03}" for n in range(1, len(shipped.system) + 1)]


def test_requirements_stand_together_by_group(shipped):
    groups = list(dict.fromkeys(requirement.group for requirement in shipped.system))
    assert groups == list(RequirementGroup)
    assert [item.group for item in shipped.system] == sorted((item.group for item in shipped.system), key=groups.index)


def test_texts_are_ears_sentences_with_one_shall(shipped):
    for item in (*shipped.stakeholder, *shipped.system):
        assert len(re.findall(r"\bshall\b", item.text)) == 1, item.id
        assert re.match(r"(The|When|While|If|Where) [^.]*( shall )[^.]*(\.\d[^.]*)?\.$", item.text), item.id
        assert item.text.startswith("If") == ("then the " in item.text), item.id


def test_each_measure_of_effectiveness_has_its_criterion(shipped):
    bounds = {item.id: str(item.criterion) for item in shipped.system if item.criterion is not None}
    measures = {item.criterion.measure for item in shipped.system if item.criterion is not None}
    assert bounds["SYS-012"] == "P_max >= 0.8 kg"
    assert measures >= {"P_max", "C_total", "t_e", "t_p", "S"}


def test_a_criterion_stands_exactly_where_the_method_is_analysis(shipped):
    for requirement in shipped.system:
        assert (requirement.criterion is not None) == (requirement.verification is VerificationMethod.ANALYSIS)


@pytest.mark.verifies("SYS-028")
def test_the_restaurant_scene_has_its_bodies(shipped):
    parts = {block.name for block in shipped.architecture.blocks if block.parent == "BLK-restaurant-scene"}
    assert parts == {"L-shaped counter-top", "Tables", "Chairs", "Floor", "Cup"}


def test_each_state_of_the_task_is_an_activity(shipped):
    activities = [item.id for item in shipped.architecture.behaviours if item.kind is BehaviourKind.ACTIVITY]
    states = [f"ACT-{phase.value.replace('_', '-')}" for phase in Phase]
    assert [activity for activity in activities if activity in states] == states


def test_each_use_case_is_spelled_out_by_an_activity(shipped):
    behaviours = shipped.architecture.behaviours
    refined = {target for item in behaviours for target in item.refines}
    assert {item.id for item in behaviours if item.kind is BehaviourKind.USE_CASE} == refined


def test_blocks_hang_on_one_context(shipped):
    assert [block.id for block in shipped.architecture.blocks if block.parent is None] == ["BLK-context"]
