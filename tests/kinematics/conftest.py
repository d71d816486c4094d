"""A small workcell built by hand, and an independent product of Denavit-Hartenberg transforms."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from rgss.kinematics import Arm, inverse_kinematics
from rgss.scenes import (
    Box,
    Cylinder,
    GripperGeometry,
    Joint,
    PlaceRegion,
    Pose,
    Robot,
    Scene,
    SceneBody,
    Task,
    Workpiece,
)

URDF = (Path(__file__).parents[2] / "scenes" / "robots" / "ur10.urdf").read_text(encoding="utf-8")
JOINTS = (
    ("shoulder_pan_joint", 2 * math.pi, 120.0, 330.0),
    ("shoulder_lift_joint", 2 * math.pi, 120.0, 330.0),
    ("elbow_joint", math.pi, 180.0, 150.0),
    ("wrist_1_joint", 2 * math.pi, 180.0, 56.0),
    ("wrist_2_joint", 2 * math.pi, 180.0, 56.0),
    ("wrist_3_joint", 2 * math.pi, 180.0, 56.0),
)
# (d, a, alpha) of each joint: Universal Robots, "DH parameters for calculations of kinematics and dynamics".
DENAVIT_HARTENBERG = (
    (0.1273, 0.0, math.pi / 2),
    (0.0, -0.612, 0.0),
    (0.0, -0.5723, 0.0),
    (0.163941, 0.0, math.pi / 2),
    (0.1157, 0.0, -math.pi / 2),
    (0.0922, 0.0, 0.0),
)
GREY = (0.7, 0.7, 0.7, 1.0)


def make_robot(**changes):
    joints = tuple(
        Joint(
            name=name,
            lower_rad=-limit,
            upper_rad=limit,
            speed_rad_s=math.radians(speed),
            acceleration_rad_s2=5.0,
            torque_n_m=torque,
        )
        for name, limit, speed, torque in JOINTS
    )
    values = {
        "id": "ur10",
        "urdf": URDF,
        "flange": "flange",
        "joints": joints,
        "base": Pose(position_m=(0.0, 0.0, 0.85)),
        "payload_kg": 10.0,
        "tool_acceleration_m_s2": 4.0,
        "home_rad": (0.0, -1.5, 1.5, -1.5, -1.5, 0.0),
    }
    return Robot(**(values | changes))


def make_body(name, size_m, position_m):
    return SceneBody(id=name, shape=Box(size_m=size_m), pose=Pose(position_m=position_m), friction=0.5, colour=GREY)


def make_scene(robot):
    return Scene(
        id="bench",
        gravity_m_s2=9.81,
        robot=robot,
        bodies=(
            make_body("floor", (4.0, 4.0, 0.1), (0.0, 0.0, -0.05)),
            make_body("pedestal", (0.24, 0.24, 0.85), (0.0, 0.0, 0.425)),
            make_body("counter", (0.6, 2.0, 0.04), (0.75, 0.05, 0.88)),
            make_body("side_counter", (1.4, 0.6, 0.04), (-0.25, 0.75, 0.88)),
            make_body("shelf", (0.6, 0.6, 0.03), (0.7, 0.4, 1.465)),
        ),
        support="counter",
        place_support="side_counter",
        workpiece=Workpiece(
            id="cup",
            shape=Cylinder(radius_m=0.035, height_m=0.10),
            mass_kg=0.3,
            friction=1.0,
            force_limit_n=40.0,
            pose=Pose(position_m=(0.70, -0.30, 0.95)),
            colour=GREY,
        ),
        place=PlaceRegion(centre_m=(-0.25, 0.70, 0.90), radius_m=0.04, largest_tilt_rad=0.1),
        task=Task(
            approach_height_m=0.12,
            lift_height_m=0.06,
            departure_height_m=0.15,
            place_approach_height_m=0.15,
            place_clearance_m=0.003,
            largest_carry_tilt_rad=0.8,
            grasp_yaw_rad=0.0,
            place_yaw_rad=0.0,
        ),
    )


@pytest.fixture
def new_robot():
    """Makes a robot, with changes."""
    return make_robot


@pytest.fixture(scope="session")
def robot():
    return make_robot()


@pytest.fixture(scope="session")
def gripper():
    return GripperGeometry(
        id="three_fingers",
        azimuths_rad=(0.0, 2 * math.pi / 3, 4 * math.pi / 3),
        base=Cylinder(radius_m=0.05, height_m=0.085),
        finger=Box(size_m=(0.012, 0.02, 0.09)),
        largest_opening_m=0.070,
        stroke_m=0.048,
        grasp_depth_m=0.145,
    )


@pytest.fixture(scope="session")
def scene(robot):
    return make_scene(robot)


@pytest.fixture(scope="session")
def arm(robot, gripper):
    return Arm(robot, gripper.grasp_centre)


@pytest.fixture(scope="session")
def inverse(arm):
    return inverse_kinematics(arm)


@pytest.fixture
def configurations():
    """Random joint angles over the whole range of the arm, shape (n, 6)."""

    def draw(count, seed=0):
        limits = np.array([limit for _, limit, _, _ in JOINTS])
        return np.random.default_rng(seed).uniform(-limits, limits, (count, 6))

    return draw


@pytest.fixture
def link_frames():
    """The frames 0..6 of the Denavit-Hartenberg convention in the arm's base, by plain matrix products."""

    def frames(q):
        result = [np.eye(4)]
        for angle, (d, a, alpha) in zip(q, DENAVIT_HARTENBERG, strict=True):
            c, s, ca, sa = math.cos(angle), math.sin(angle), math.cos(alpha), math.sin(alpha)
            step = np.array(
                [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0.0, sa, ca, d], [0.0, 0.0, 0.0, 1.0]]
            )
            result.append(result[-1] @ step)
        return result

    return frames


@pytest.fixture
def matrix_of():
    """The homogeneous matrix of a pose."""

    def matrix(pose):
        result = np.eye(4)
        result[:3, 3] = pose.position_m
        for column, axis in enumerate(np.eye(3)):
            result[:3, column] = pose.rotate(tuple(axis))
        return result

    return matrix


@pytest.fixture(scope="session")
def reference():
    """What ur-analytic-ik says of some configurations of the UR10: the tool's matrix, and every solution for it."""
    return json.loads((Path(__file__).parent / "ur10_reference.json").read_text(encoding="utf-8"))
