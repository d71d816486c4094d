"""What is confirmed where MuJoCo does not simulate a gripper."""

from __future__ import annotations

import pytest

from rgss.confirmation import Aspect, Engine, confirmation_settings, selected_by_id, supported_settings
from rgss.errors import DefinitionError
from rgss.reports.confirmation.sentences import summary_sentences
from rgss.studies import load_project
from tests.fixtures.shipped_project import REPOSITORY


@pytest.fixture(scope="module")
def cubes():
    return load_project(REPOSITORY, study="studies/lite6_cubes.yaml")


@pytest.fixture(scope="module")
def grippers(cubes):
    """A design with a cup and one with fingers."""
    found = {bool(cubes.grippers[one.components["gripper"].geometry].suction): one.id for one in cubes.designs.expand()}
    return found[True], found[False]


def aspects(settings):
    return [one.aspect for one in settings]


def test_designs_with_fingers_are_confirmed_under_every_setting(cubes, grippers):
    settings = confirmation_settings(cubes)
    selection = selected_by_id(cubes, [grippers[1]])
    assert supported_settings(cubes, selection, settings, is_named=False) == (selection, settings)


def test_a_cup_is_confirmed_without_mujoco_and_the_reason_is_told(cubes, grippers, confirmation):
    cup, fingers = grippers
    selection = selected_by_id(cubes, [fingers, cup])
    found, settings = supported_settings(cubes, selection, confirmation_settings(cubes), is_named=False)
    assert aspects(settings) == [Aspect.STUDY, Aspect.STEP, Aspect.ITERATIONS]
    assert found.without_engine == f"MuJoCo does not simulate variant {cup}: the suction cup of lite6_vacuum"
    told = confirmation(rankings=[(28,), (28,)], without_engine=found.without_engine)
    assert f"Not confirmed in another engine: {found.without_engine}." in list(summary_sentences(told))


def test_an_engine_that_was_named_is_not_left_out(cubes, grippers):
    selection = selected_by_id(cubes, [grippers[0]])
    settings = confirmation_settings(cubes, engines=[Engine.MUJOCO])
    with pytest.raises(DefinitionError) as caught:
        supported_settings(cubes, selection, settings, is_named=True)
    assert caught.value.message == f"MuJoCo does not simulate variant {grippers[0]}: the suction cup of lite6_vacuum"
    assert caught.value.hint == "name other designs with --variants, or confirm with --engine pybullet"


def test_pybullet_alone_confirms_any_gripper(cubes, grippers):
    settings = confirmation_settings(cubes, engines=[Engine.PYBULLET])
    selection = selected_by_id(cubes, grippers)
    assert supported_settings(cubes, selection, settings, is_named=True) == (selection, settings)
