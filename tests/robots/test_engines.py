"""The same arm in every engine: where its convex shapes are, and how far they are from a ball."""

from __future__ import annotations

import mujoco
import numpy as np
import pybullet
import pytest

from rgss.errors import SimulationError
from rgss.kinematics.description import build_model
from rgss.kinematics.geometry import arm_parts
from rgss.physics import PhysicsSettings
from rgss.physics.engine import load_urdf_text
from rgss.physics.mujoco.engine import compiled
from rgss.physics.mujoco.model import world_model
from rgss.physics.stage import Posture, Stage
from rgss.scenes import Gripper, Pose, convex_parts, load_gripper, load_scene

MARGIN_M = 1.2e-3


@pytest.fixture
def scene(projects, arm_name):
    return load_scene(projects[arm_name] / "scenes" / "kitchen.yaml", project=projects[arm_name])


@pytest.fixture
def gripper(projects, arm_name):
    return Gripper(
        geometry=load_gripper(projects[arm_name] / "scenes" / "grippers" / "kg-2.yaml"),
        base_mass_kg=0.4,
        finger_mass_kg=0.2,
        finger_velocity_m_s=0.04,
        finger_force_n=10.0,
        friction=0.7,
    )


def placed_corners(robot, q):
    """Bounds of each convex shape in the world, by link."""
    import pinocchio

    model = build_model(robot)
    data = model.createData()
    pinocchio.framesForwardKinematics(model, data, np.array(q))
    found = {}
    for part in convex_parts(robot.urdf)[1]:
        frame = data.oMf[model.getFrameId(part.link)]
        points = np.array([(part.pose @ Pose(position_m=vertex)).position_m for vertex in part.vertices_m])
        found.setdefault(part.link, []).append(points @ frame.rotation.T + frame.translation)
    return found


def test_the_second_engine_has_the_shapes_at_the_same_places(scene, gripper, arm_name):
    if arm_name == "six":
        # Its description has inertias that no body has, as `rgss robot` says.
        with pytest.raises(SimulationError) as caught:
            compiled(world_model(scene, gripper, PhysicsSettings(), contact_time_constant_s=0.01).text)
        assert "inertia must satisfy A + B >= C" in f"{caught.value.message} {caught.value.hint}"
        return
    text = world_model(scene, gripper, PhysicsSettings(), contact_time_constant_s=0.01).text
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    for joint, angle in zip(scene.robot.joints, scene.robot.home_rad, strict=True):
        data.qpos[model.joint(joint.name).qposadr[0]] = angle
    mujoco.mj_forward(model, data)
    wanted = placed_corners(scene.robot, scene.robot.home_rad)
    checked = 0
    for link, shapes in wanted.items():
        for index, points in enumerate(shapes):
            geom = model.geom(f"link:{link}:{index}")
            mesh = model.mesh(int(geom.dataid[0]))
            first, count = int(mesh.vertadr[0]), int(mesh.vertnum[0])
            corners = model.mesh_vert[first : first + count] @ data.geom_xmat[geom.id].reshape(3, 3).T
            corners = corners + data.geom_xpos[geom.id]
            assert np.allclose(corners.min(axis=0), points.min(axis=0), atol=1e-5)
            assert np.allclose(corners.max(axis=0), points.max(axis=0), atol=1e-5)
            checked += 1
    assert checked >= 6


def test_distances_agree_between_planning_and_contact(scene):
    import coal
    import pinocchio

    robot = scene.robot
    model = build_model(robot)
    data = model.createData()
    pinocchio.forwardKinematics(model, data, np.array(robot.home_rad))
    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = load_urdf_text(
            client, robot.urdf, position=robot.base.position_m, orientation=robot.base.quaternion_xyzw, flags=0
        )
        info = [pybullet.getJointInfo(body, index, client) for index in range(pybullet.getNumJoints(body, client))]
        numbers = {entry[1].decode(): entry[0] for entry in info}
        names = {entry[12].decode(): entry[0] for entry in info}
        names[pybullet.getBodyInfo(body, client)[0].decode()] = -1
        for joint, angle in zip(robot.joints, robot.home_rad, strict=True):
            pybullet.resetJointState(body, numbers[joint.name], angle, physicsClientId=client)
        at = np.array(robot.base.position_m) + np.array([0.9, 0.5, 0.4])
        shape = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=0.05, physicsClientId=client)
        ball = pybullet.createMultiBody(0.0, shape, basePosition=at.tolist(), physicsClientId=client)
        for part in arm_parts(model, robot):
            placed = data.oMi[part.joint] * part.placement
            distance = coal.distance(
                part.shape,
                coal.Transform3s(placed.rotation, placed.translation),
                coal.Sphere(0.05),
                coal.Transform3s(np.eye(3), at),
                coal.DistanceRequest(),
                coal.DistanceResult(),
            )
            points = pybullet.getClosestPoints(body, ball, 5.0, names[part.name], physicsClientId=client)
            assert min(point[8] for point in points) == pytest.approx(distance, abs=MARGIN_M)
    finally:
        pybullet.disconnect(client)


def test_an_arm_of_convex_shapes_is_shown(scene, gripper):
    stage = Stage(scene, gripper)
    try:
        travel = (0.0,) * gripper.geometry.fingers
        stage.take(Posture(joints_rad=scene.robot.home_rad, finger_travel_m=travel, workpiece=scene.workpiece.pose))
        assert pybullet.getNumBodies(stage.moving) > len(convex_parts(scene.robot.urdf)[1])
    finally:
        stage.close()
