"""A stated grasp that the arm does not reach, and the half turn of the hand that holds the object alike."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from rgss.studies.checks.scene_texts import remedy
from rgss.trials.scene_check import reach_problems

pytestmark = pytest.mark.engine


def problems(spec, low_deg, high_deg, **changes):
    """Problems of a trial whose arm turns its last joint within a range alone; as planned it is at 54 and 97 deg."""
    robot = spec.scene.robot
    last = replace(robot.joints[-1], lower_rad=math.radians(low_deg), upper_rad=math.radians(high_deg))
    home = (*robot.home_rad[:-1], math.radians((low_deg + high_deg) / 2))
    robot = replace(robot, joints=(*robot.joints[:-1], last), home_rad=home)
    scene = replace(spec.scene, robot=robot, task=replace(spec.scene.task, **changes))
    clearance_m = spec.settings.planning.clearance_m
    return reach_problems(scene, spec.gripper.geometry, clearance_m=clearance_m, task=spec.task)


def test_the_half_turn_is_named_where_it_serves_every_waypoint(spec_of):
    spec = spec_of(19)
    assert spec.gripper.geometry.fingers == 2
    found = problems(spec, -180.0, 0.0)
    assert len(found) == 6
    assert all(one.serves_turned for one in found)
    hint = "add 180 deg to 'grasp_yaw' and 'place_yaw': the hand so turned holds it alike and serves every waypoint"
    assert {remedy(one) for one in found} == {hint}
    task = spec.scene.task
    turned = {"grasp_yaw_rad": task.grasp_yaw_rad + math.pi, "place_yaw_rad": task.place_yaw_rad + math.pi}
    assert problems(spec, -180.0, 0.0, **turned) == ()


def test_and_not_where_it_does_not(spec_of):
    found = problems(spec_of(19), -60.0, 60.0)
    assert {one.waypoint for one in found} == {"place_approach", "place"}
    assert not any(one.serves_turned for one in found)


def test_the_yaw_at_the_place_that_serves_is_named(spec_of):
    spec = spec_of(19)
    yaws = {one.place_yaw_rad for one in problems(spec, -60.0, 60.0)}
    assert len(yaws) == 1
    (yaw_rad,) = yaws
    assert yaw_rad is not None
    hint = f"state 'place_yaw: {math.degrees(yaw_rad):.3g} deg'"
    assert {remedy(one)[: len(hint)] for one in problems(spec, -60.0, 60.0)} == {hint}
    assert problems(spec, -60.0, 60.0, place_yaw_rad=yaw_rad) == ()
    # Where the grasp is in the way too, another yaw at the place does not help, and the key is named.
    both = problems(spec, 100.0, 120.0)
    assert {one.place_yaw_rad for one in both} == {None}
    assert any("('grasp_yaw')" in remedy(one) for one in both)


def test_three_fingers_hold_it_otherwise_when_turned(spec_of):
    spec = spec_of(5)
    assert spec.gripper.geometry.fingers == 3
    found = problems(spec, -180.0, 0.0)
    assert found
    assert not any(one.serves_turned for one in found)
