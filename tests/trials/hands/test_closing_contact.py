"""Links of a linkage at the object while the pads close, against dense points of their solids."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.kinematics import ClosingLinks
from rgss.scenes import Box, Cylinder, LinkageMotion, at_object, misfit
from rgss.trials.hands import hand_of
from tests.trials.hands.gripper_files import gripper_of

pytestmark = pytest.mark.engine

# Of the cranks' URDF: the box of a crank in its link.
CRANK_M, CRANK_AT_M, CRANK_TURN_RAD = (0.012, 0.02, 0.05), (0.01625, 0.0, 0.02315), 0.612


@pytest.fixture
def case(spec_of, tmp_path):
    """Scene of an upright cylinder or a box gripped in its middle from above, and the cranks' gripper for it."""

    def make(shape):
        spec = spec_of()
        scene = replace(spec.scene, workpiece=replace(spec.scene.workpiece, shape=shape))
        gripper = gripper_of(tmp_path, "linkage")
        return scene, replace(gripper, geometry=at_object(gripper.geometry, scene))

    return make


def crank_points(geometry, driven):
    """Points over the two cranks at the flange, shape (n, 3): the origin of each link turned, its box filled."""
    grid = np.array(np.meshgrid(*(np.linspace(-size / 2, size / 2, 25) for size in CRANK_M), indexing="ij"))
    box = grid.reshape(3, -1).T
    c, s = math.cos(CRANK_TURN_RAD), math.sin(CRANK_TURN_RAD)
    box = box @ np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]]) + CRANK_AT_M
    c, s = math.cos(driven), math.sin(driven)
    turned = box @ np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]) + (0.012, 0.0, 0.07)
    return np.vstack([turned, turned * (-1.0, -1.0, 1.0)])


@pytest.mark.parametrize("half_height_m", [0.02, 0.04, 0.055])
def test_the_distance_of_cranks_from_an_upright_cylinder(case, half_height_m):
    radius_m = 0.015
    scene, gripper = case(Cylinder(radius_m=radius_m, height_m=2 * half_height_m))
    geometry = gripper.geometry
    motion = LinkageMotion(geometry.linkage)
    end = motion.driven_at(motion.largest_opening_m - radius_m)
    top_m = geometry.grasp_depth_m - half_height_m
    nearest_m = math.inf
    for driven in np.linspace(geometry.linkage.opened, end, 9):
        points = crank_points(geometry, driven)
        aside = np.hypot(points[:, 0], points[:, 1]) - radius_m
        above = top_m - points[:, 2]
        inside = np.maximum(aside, above)
        outside = np.hypot(np.maximum(aside, 0.0), np.maximum(above, 0.0))
        nearest_m = min(nearest_m, float(np.min(np.where(inside > 0.0, outside, inside))))
    contact = ClosingLinks(geometry).contact(scene, clearance_m=1.0)
    assert contact.link in ("left_crank", "right_crank")
    if nearest_m > 0.0:
        assert contact.distance_m == pytest.approx(nearest_m, abs=2e-3)
    else:
        assert contact.distance_m < 0.0
    assert (ClosingLinks(geometry).contact(scene) is None) == (nearest_m > 0.0)


def test_a_hand_says_that_a_link_meets_the_object_before_its_pads(case):
    low, gripper = case(Cylinder(radius_m=0.015, height_m=0.04))
    assert hand_of(gripper).misfit(low) == ""
    tall, gripper = case(Cylinder(radius_m=0.015, height_m=0.14))
    assert misfit(gripper.geometry, tall) == ""
    text = hand_of(gripper).misfit(tall)
    assert text.split(" would be ")[0] in ("left_crank", "right_crank")
    assert text.endswith(" mm in the object when the pads touch it")


def test_other_grippers_have_no_such_links(spec_of):
    spec = spec_of()
    links = ClosingLinks(spec.gripper.geometry)
    assert (
        links.contact(replace(spec.scene, workpiece=replace(spec.scene.workpiece, shape=Box(size_m=(0.03,) * 3))))
        is None
    )
