"""The scene, robot and grippers that come with the project."""

import math
import xml.etree.ElementTree as ET

import pytest

from rgss.scenes import Box, load_gripper, load_robot, load_scene
from rgss.scenes.pose import Pose


@pytest.fixture(scope="module")
def scene(shipped):
    return load_scene(shipped / "restaurant.yaml", label="scenes/restaurant.yaml")


def test_the_restaurant_has_what_the_task_needs(scene):
    names = {body.id for body in scene.bodies}
    assert {"floor", "counter_pick", "counter_place", "table_near", "chair_left"} <= names
    assert (scene.workpiece.id, scene.support, scene.place_support) == ("cup", "counter_pick", "counter_place")


@pytest.mark.parametrize("which", ["start", "place"])
def test_the_cup_stands_within_the_body_that_bears_it(scene, which):
    radius = scene.workpiece.shape.radius_m
    if which == "start":
        support, (x, y, z) = scene.support, scene.workpiece.pose.position_m
        z -= scene.workpiece.shape.half_height_m
    else:
        support, (x, y, z) = scene.place_support, scene.place.centre_m
        radius += scene.place.radius_m
    (body,) = (body for body in scene.bodies if body.id == support)
    assert isinstance(body.shape, Box)
    bx, by, bz = body.pose.position_m
    width, depth, height = body.shape.size_m
    assert abs(x - bx) + radius <= width / 2
    assert abs(y - by) + radius <= depth / 2
    assert z == pytest.approx(bz + height / 2)


def test_the_robot_is_a_ur10_on_its_pedestal(scene):
    robot = scene.robot
    assert (robot.id, robot.flange, len(robot.joints)) == ("ur10", "flange", 6)
    (pedestal,) = (body for body in scene.bodies if body.id == "pedestal")
    top = pedestal.pose.position_m[2] + pedestal.shape.half_height_m
    assert robot.base.position_m == pytest.approx((*pedestal.pose.position_m[:2], top))
    # Limits as the manufacturer states them.
    assert [joint.torque_n_m for joint in robot.joints] == [330, 330, 150, 56, 56, 56]
    degrees = [math.degrees(joint.speed_rad_s) for joint in robot.joints]
    assert degrees == pytest.approx([120, 120, 180, 180, 180, 180])
    for joint, angle in zip(robot.joints, robot.home_rad, strict=True):
        assert joint.lower_rad < angle < joint.upper_rad


def test_the_urdf_agrees_with_the_limits_of_the_robot_file(scene):
    root = ET.fromstring(scene.robot.urdf)  # noqa: S314 - our own text
    limits = {joint.get("name"): joint.find("limit") for joint in root.findall("joint")}
    for joint in scene.robot.joints:
        limit = limits[joint.name]
        assert float(limit.get("effort")) == joint.torque_n_m
        assert float(limit.get("velocity")) == pytest.approx(joint.speed_rad_s, rel=1e-12)
        # Planning may use less than the joint can do, never more.
        assert float(limit.get("lower")) <= joint.lower_rad + 1e-12
        assert float(limit.get("upper")) >= joint.upper_rad - 1e-12


def test_the_robot_file_loads_alone(shipped, scene):
    alone = load_robot(shipped / "robots/ur10.yaml", base=Pose())
    assert (alone.urdf, alone.joints) == (scene.robot.urdf, scene.robot.joints)


@pytest.mark.parametrize("fingers", [2, 3])
def test_the_grippers_close_on_the_cup(shipped, scene, fingers):
    gripper = load_gripper(shipped / f"grippers/kg-{fingers}.yaml")
    assert gripper.fingers == fingers
    assert gripper.azimuths_rad == pytest.approx([2 * math.pi * finger / fingers for finger in range(fingers)])
    # 1.2 s to close at 0.04 m/s.
    assert gripper.stroke_m == pytest.approx(1.2 * 0.04)
    cup = scene.workpiece.shape
    assert gripper.largest_opening_m - gripper.stroke_m < cup.radius_m < gripper.largest_opening_m
    # The base stays above the cup, the fingertips above the counter.
    tip = gripper.base.height_m + gripper.finger.size_m[2]
    assert gripper.base.height_m < gripper.grasp_depth_m - cup.half_height_m
    assert tip - gripper.grasp_depth_m < cup.half_height_m
