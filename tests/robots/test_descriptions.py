"""Arms from their own URDF: kinematics against another reader, and the same convex shapes in both engines."""

from __future__ import annotations

import numpy as np
import pybullet
import pytest

from rgss.kinematics import Arm
from rgss.kinematics.description import build_model
from rgss.kinematics.geometry import arm_parts
from rgss.kinematics.link_contacts import lasting_contacts
from rgss.physics.engine import load_urdf_text
from rgss.scenes import Pose, convex_parts, load_robot
from tests.robots.conftest import urdf_of


@pytest.fixture
def robot(projects, arm_name):
    (path,) = (projects[arm_name] / "scenes" / "robots").glob("*.yaml")
    return load_robot(path, base=Pose(), project=projects[arm_name])


@pytest.fixture
def client():
    number = pybullet.connect(pybullet.DIRECT)
    yield number
    pybullet.disconnect(number)


def configurations(robot, count):
    lower, upper = (np.array([getattr(joint, end) for joint in robot.joints]) for end in ("lower_rad", "upper_rad"))
    return lower + np.random.default_rng(5).random((count, len(lower))) * (upper - lower)


def test_forward_kinematics_are_those_of_another_reader_of_the_original_file(robot, arm_name, client):
    body = pybullet.loadURDF(str(urdf_of(arm_name)), useFixedBase=True, physicsClientId=client)
    info = [pybullet.getJointInfo(body, index, physicsClientId=client) for index in range(pybullet.getNumJoints(body))]
    joints = {entry[1].decode(): entry[0] for entry in info}
    flange = next(entry[0] for entry in info if entry[12].decode() == robot.flange)
    arm = Arm(robot, Pose())
    for q in configurations(robot, 20):
        for joint, angle in zip(robot.joints, q, strict=True):
            pybullet.resetJointState(body, joints[joint.name], angle, physicsClientId=client)
        state = pybullet.getLinkState(body, flange, computeForwardKinematics=True, physicsClientId=client)
        assert np.max(np.abs(arm.tool_matrix(q)[:3, 3] - state[4])) < 1e-5
        turn = np.array(pybullet.getMatrixFromQuaternion(state[5])).reshape(3, 3)
        assert np.max(np.abs(arm.tool_matrix(q)[:3, :3] - turn)) < 1e-5


def test_both_engines_have_the_same_convex_shapes(robot, client):
    shapes = convex_parts(robot.urdf)[1]
    assert len(shapes) >= 6
    parts = [part for part in arm_parts(build_model(robot), robot) if hasattr(part.shape, "num_points")]
    assert len(parts) == len(shapes)
    body = load_urdf_text(client, robot.urdf, position=(0, 0, 0), orientation=(0, 0, 0, 1), flags=0)
    loaded = 0
    for link in range(-1, pybullet.getNumJoints(body, physicsClientId=client)):
        loaded += len(pybullet.getCollisionShapeData(body, link, physicsClientId=client))
    assert loaded == len(shapes)
    # The least and greatest corner of each shape in the frame of its link, as the contact engine reports it at zero.
    for part, shape in zip(parts, shapes, strict=True):
        points = np.array(shape.vertices_m)
        assert part.name == shape.link
        part.shape.computeLocalAABB()
        box = part.shape.aabb_local
        assert np.allclose(box.min_, points.min(axis=0), atol=1e-9)
        assert np.allclose(box.max_, points.max(axis=0), atol=1e-9)


def test_neighbours_but_one_whose_hulls_always_overlap_are_left_out(projects):
    (path,) = (projects["seven with a hand"] / "scenes" / "robots").glob("*.yaml")
    robot = load_robot(path, base=Pose(), project=projects["seven with a hand"])
    assert {frozenset(("panda_link5", "panda_link7"))} >= set(lasting_contacts(robot))


def test_the_hand_of_the_urdf_is_left_out(projects):
    (path,) = (projects["seven with a hand"] / "scenes" / "robots").glob("*.yaml")
    robot = load_robot(path, base=Pose(), project=projects["seven with a hand"])
    assert robot.flange == "panda_link8"
    assert "panda_hand" not in robot.urdf
    assert len(robot.joints) == 7
