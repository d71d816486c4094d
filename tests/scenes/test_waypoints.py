"""The waypoints: the tool points down, at the heights and turns that the task gives."""

import math

import numpy as np
import pytest

from rgss.scenes import Waypoint, waypoint_poses


@pytest.fixture
def scene(kitchen):
    return kitchen.scene()


def test_the_waypoints_come_in_the_order_of_the_task(scene):
    assert list(waypoint_poses(scene)) == list(Waypoint)


@pytest.mark.parametrize(
    ("waypoint", "position_m"),
    [
        # The mug's centre: the table's foot 0.1 m, its height 0.7 m, half the mug 0.06 m.
        (Waypoint.GRASP, (0.4, 0.1, 0.86)),
        (Waypoint.GRASP_APPROACH, (0.4, 0.1, 0.86 + 0.15)),
        (Waypoint.LIFT, (0.4, 0.1, 0.86 + 0.05)),
        (Waypoint.GRASP_DEPARTURE, (0.4, 0.1, 0.86 + 0.18)),
        # On the pole of 2 m, with 2 mm of clearance.
        (Waypoint.PLACE, (-1.0, 0.0, 2.062)),
        (Waypoint.PLACE_APPROACH, (-1.0, 0.0, 2.062 + 0.2)),
    ],
)
def test_heights_are_counted_from_the_grasp_and_the_place(scene, waypoint, position_m):
    assert waypoint_poses(scene)[waypoint].position_m == pytest.approx(position_m, abs=1e-12)


def test_the_tool_points_down_everywhere(scene):
    for pose in waypoint_poses(scene).values():
        assert pose.rotate((0.0, 0.0, 1.0)) == pytest.approx((0.0, 0.0, -1.0), abs=1e-12)
        assert pose.tilt_rad == pytest.approx(math.pi)


@pytest.mark.parametrize(
    ("waypoints", "yaw_rad"),
    [
        ((Waypoint.GRASP_APPROACH, Waypoint.GRASP, Waypoint.LIFT, Waypoint.GRASP_DEPARTURE), 0.0),
        ((Waypoint.PLACE_APPROACH, Waypoint.PLACE), math.pi / 2),
    ],
)
def test_the_tool_turns_about_the_vertical_as_the_task_says(scene, waypoints, yaw_rad):
    poses = waypoint_poses(scene)
    for waypoint in waypoints:
        along_x = np.array(poses[waypoint].rotate((1.0, 0.0, 0.0)))
        assert along_x == pytest.approx((math.cos(yaw_rad), math.sin(yaw_rad), 0.0), abs=1e-12)
