import math

import pytest

from rgss.scenes import Box, Cylinder


def test_a_gripper_is_read_in_si_units(kitchen):
    gripper = kitchen.gripper()
    assert gripper.id == "three"
    assert gripper.azimuths_rad == pytest.approx((0.0, 2 * math.pi / 3, 4 * math.pi / 3))
    assert gripper.base == Cylinder(radius_m=0.04, height_m=0.08)
    assert gripper.finger == Box(size_m=(0.01, 0.02, 0.09))
    assert (gripper.largest_opening_m, gripper.stroke_m, gripper.grasp_depth_m) == (0.06, 0.05, 0.13)


@pytest.mark.parametrize(
    ("old", "new", "name"),
    [
        ("radius: 40 mm", "radius: ¦0 mm", "radius"),
        ("height: 80 mm", "height: ¦-80 mm", "height"),
        ("thickness: 10 mm", "thickness: ¦0 mm", "thickness"),
        ("width: 20 mm", "width: ¦0 mm", "width"),
        ("stroke: 50 mm", "stroke: ¦0 mm", "stroke"),
    ],
)
def test_a_length_that_is_not_positive_is_found(kitchen, old, new, name):
    kitchen.change("three.yaml", old, new)
    assert f"{kitchen.marks()[0]} scene.not-positive {name} must be greater than zero" in kitchen.findings("gripper")


@pytest.mark.parametrize("stroke", ["60 mm", "61 mm"])
def test_fingers_that_would_cross_are_found(kitchen, stroke):
    kitchen.change("three.yaml", "stroke: 50 mm", f"stroke: ¦{stroke}")
    expected = (
        "the stroke is not shorter than the largest opening, so the fingers would cross (make it less than 0.06 m)"
    )
    assert kitchen.findings("gripper") == [f"{kitchen.marks()[0]} scene.stroke {expected}"]


@pytest.mark.parametrize("depth", ["80 mm", "170 mm", "1 m"])
def test_a_grasp_outside_the_fingers_is_found(kitchen, depth):
    kitchen.change("three.yaml", "grasp_depth: 130 mm", f"grasp_depth: ¦{depth}")
    expected = "the grasp centre lies outside the fingers (give a depth between 0.08 m and 0.17 m)"
    assert kitchen.findings("gripper") == [f"{kitchen.marks()[0]} scene.grasp-depth {expected}"]


def test_a_gripper_needs_two_fingers(kitchen):
    kitchen.change("three.yaml", "[0 deg, 120 deg, 240 deg]", "¦[0 deg]")
    expected = "document.value azimuths: at least 2 entries are expected"
    assert kitchen.findings("gripper") == [f"{kitchen.marks()[0]} {expected}"]


def test_all_problems_come_at_once(kitchen):
    kitchen.change("three.yaml", "length: 90 mm", "length: ¦0 mm")
    kitchen.change("three.yaml", "stroke: 50 mm", "stroke: ¦70 mm")
    kitchen.change("three.yaml", "grasp_depth: 130 mm", "grasp_depth: ¦¦0 mm")
    findings = kitchen.findings("gripper")
    assert [finding.split()[0] for finding in findings] == kitchen.marks()
