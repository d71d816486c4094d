"""An object that does not fit under the palm: by its height, or by the clearance of planned paths."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.scenes import load_gripper_file
from rgss.studies.checks import TooTall, objects_too_tall
from tests.fixtures.shipped_project import REPOSITORY

HAND = "scenes/grippers/kg-2.yaml"


@pytest.fixture
def too_tall(shipped):
    """Finds the objects of the shipped scene that do not fit under the palm with a clearance."""
    geometry = load_gripper_file(REPOSITORY / HAND, project=REPOSITORY).geometry

    def find(clearance_m):
        planning = shipped.study.planning
        planning = replace(planning, settings=replace(planning.settings, clearance_m=clearance_m))
        return objects_too_tall(geometry, replace(shipped, study=replace(shipped.study, planning=planning)))

    return find


def test_a_clearance_that_no_hand_has_room_for_is_named_and_not_the_height(too_tall):
    """The palm is 60 mm above the grasp, and the top of the cup 50 mm."""
    (cup,) = too_tall(1.0)
    assert cup == TooTall(object="cup", top_m=0.05, palm_m=pytest.approx(0.06), clearance_m=1.0)
    assert cup.message(HAND) == (
        f"cup is too tall for {HAND}: held at its middle, its top is 50 mm above the grasp and the palm 60 mm, less "
        "than the clearance of planned paths of 1000 mm"
    )
    assert cup.hint.startswith("lower 'clearance' of 'planning' below 10 mm, take a gripper with longer fingers")
    assert "-" not in cup.message(HAND).replace(HAND, "") + cup.hint


def test_where_the_clearance_alone_is_too_great_both_ways_out_are_named(too_tall):
    (cup,) = too_tall(0.02)
    assert cup.message(HAND).endswith("its top is 50 mm above the grasp, and the palm leaves 40 mm")
    assert cup.hint.startswith("take an object of at most 80 mm, a gripper with longer fingers")
    assert cup.hint.endswith("or lower 'clearance' of 'planning' below 10 mm")


def test_of_an_object_that_reaches_the_palm_no_clearance_is_named():
    tall = TooTall(object="cup", top_m=0.07, palm_m=0.06, clearance_m=0.008)
    assert tall.hint == (
        "take an object of at most 104 mm, a gripper with longer fingers, or let the task choose the grasp "
        "('candidates' of the task)"
    )


def test_an_object_with_room_is_not_too_tall(too_tall):
    assert too_tall(0.009) == ()
