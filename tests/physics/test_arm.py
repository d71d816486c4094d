"""The arm: where it stands, how it follows, what it bears, against an independent model."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.physics import PhysicsSettings, World
from rgss.scenes.assembly import assembled_urdf

pytestmark = pytest.mark.engine

STILL = (0.0,) * 6


def random_configurations(cell, count: int) -> np.ndarray:
    generator = np.random.default_rng(7)
    return generator.uniform(cell.arm.lower_rad, cell.arm.upper_rad, (count, 6))


def test_the_tool_stands_where_forward_kinematics_says(cell):
    with cell.world() as world:
        for configuration in random_configurations(cell, 50):
            world.reset_arm(configuration.tolist())
            found, expected = world.tool_pose(), cell.arm.tool_pose(configuration)
            assert found.position_m == pytest.approx(expected.position_m, abs=1e-6)
            assert (expected.inverse() @ found).quaternion_xyzw[:3] == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)


def test_a_turned_base_turns_the_tool_with_it(three_fingers):
    robot = three_fingers.scene.robot
    turned = replace(robot, base=replace(robot.base, quaternion_xyzw=(0.0, 0.0, math.sin(0.35), math.cos(0.35))))
    with three_fingers.world(robot=turned) as world:
        world.reset_arm(robot.home_rad)
        arm = type(three_fingers.arm)(turned, three_fingers.gripper.geometry.grasp_centre)
        assert world.tool_pose().position_m == pytest.approx(arm.tool_pose(robot.home_rad).position_m, abs=1e-6)


def test_reset_puts_the_arm_at_rest_with_open_fingers_and_moves_nothing_else(cell):
    target = tuple(cell.near(cell.scene.grasp.raised(0.1)).tolist())
    with cell.world() as world:
        cell.close(world)
        world.drive_fingers(0.04, 3.0)
        world.command_arm(cell.scene.robot.home_rad, STILL)
        world.step()
        cup = world.workpiece_pose()
        world.reset_arm(target)
        positions, velocities, _ = world.arm_state()
        assert positions == pytest.approx(target, abs=1e-12)
        assert velocities == STILL
        assert world.finger_travel_m() == (0.0,) * cell.gripper.geometry.fingers
        assert world.workpiece_pose() == cup
        # The targets are reset too: the arm stays, and the fingers stay open.
        for _ in range(48):
            world.step()
        assert world.arm_state()[0] == pytest.approx(target, abs=1e-4)
        assert world.finger_travel_m() == pytest.approx([0.0] * cell.gripper.geometry.fingers, abs=1e-4)


def test_the_arm_follows_a_smooth_trajectory(cell):
    """The tool is never a tenth of a millimetre from the target of the step's end."""
    start = cell.near(cell.scene.grasp.raised(0.15))
    goal = start + np.array([0.8, -0.3, 0.4, -0.3, 0.3, -0.6])
    path = cell.path(start, goal, 1.2)
    with cell.world(bodies=cell.scene.bodies[:1]) as world:  # the floor alone, so that nothing is in the way
        world.reset_arm(start.tolist())
        poses = cell.follow(world, path)
        positions, velocities, _ = world.arm_state()
    expected = cell.arm.tool_position(path[1:])
    errors = np.linalg.norm(np.array([pose.position_m for pose in poses]) - expected, axis=1)
    assert errors.max() < 1e-4
    assert positions == pytest.approx(goal, abs=1e-5)
    assert velocities == pytest.approx(STILL, abs=1e-3)


def test_iterations_that_are_stated_serve_the_empty_hand_too(cell):
    """The motors of the arm need them; those that a light object adds are for the grip alone."""
    start = cell.near(cell.scene.grasp.raised(0.15))
    path = cell.path(start, start + np.array([0.8, -0.3, 0.4, -0.3, 0.3, -0.6]), 0.8)
    scene = replace(cell.scene, bodies=cell.scene.bodies[:1])

    def greatest_error_m(settings):
        with World(scene, cell.gripper, settings) as world:
            world.reset_arm(start.tolist())
            world.reduce_solver_effort(free=True)
            reached = [pose.position_m for pose in cell.follow(world, path)]
        return float(np.linalg.norm(np.array(reached) - cell.arm.tool_position(path[1:]), axis=1).max())

    few = PhysicsSettings(solver_iterations=5)
    light = few.passing(
        force_n=10.0, speed_m_s=0.04, lightest_kg=few.lightest_body_kg(force_n=10.0, speed_m_s=0.04) / 20
    )
    assert light.solver_iterations == 100
    assert greatest_error_m(light) == greatest_error_m(few)
    assert greatest_error_m(few.with_iterations(100)) < 0.1 * greatest_error_m(few)


@pytest.mark.parametrize("rate_hz", [240.0, 1000.0])
def test_the_tool_moves_as_the_joints_say(cell, rate_hz):
    """Its place is the engine's own, its velocity the Jacobian's times the speeds of the engine's joints."""
    start = cell.near(cell.scene.grasp.raised(0.15))
    path = cell.path(start, start + np.array([0.8, -0.3, 0.4, -0.3, 0.3, -0.6]), 1.2, rate_hz)
    velocities = np.diff(path, axis=0) * rate_hz
    fastest = 0.0
    with cell.world(rate_hz=rate_hz, bodies=cell.scene.bodies[:1]) as world:
        world.reset_arm(start.tolist())
        for position, velocity in zip(path[:-1].tolist(), velocities.tolist(), strict=True):
            world.command_arm(position, velocity)
            world.step()
            q, dq, _ = world.arm_state()
            expected = cell.arm.tool_jacobian(q)[:3] @ dq
            (where,), (found,) = cell.arm.tool_motion([q], [dq])
            assert found == pytest.approx(expected, abs=1e-12)
            # And by the engine's own account, which is of the flange's centre of mass.
            link = world._engine.getLinkState(world._robot, world._flange, 1, 1, physicsClientId=world._client)
            centre, linear, angular = (np.array(link[place]) for place in (0, 6, 7))
            assert linear + np.cross(angular, where - centre) == pytest.approx(found, abs=2e-5)
            assert where == pytest.approx(world.tool_pose().position_m, abs=1e-6)
            fastest = max(fastest, float(np.linalg.norm(expected)))
    assert fastest > 0.8


def test_the_arm_stays_where_it_is_commanded_while_carrying(cell):
    with cell.world() as world:
        up = cell.lift(world)
        assert math.dist(world.tool_pose().position_m, cell.arm.tool_pose(up).position_m) < 1e-5


@pytest.fixture
def torques_of(cell):
    """Torques of the arm by the recursive Newton-Euler algorithm on the same description, gripper included."""
    import pinocchio

    model = pinocchio.buildModelFromXML(assembled_urdf(cell.scene.robot, cell.gripper))
    model.gravity.linear = np.array([0.0, 0.0, -cell.scene.gravity_m_s2])
    data = model.createData()

    def compute(*motion: np.ndarray) -> np.ndarray:
        padded = [np.concatenate([part, np.zeros(model.nq - 6)]) for part in motion]
        return pinocchio.rnea(model, data, *padded)[:6]

    return compute


def test_torques_at_rest_are_those_of_the_whole_machine(cell, torques_of):
    configuration = cell.near(cell.scene.grasp.raised(0.1))
    expected = torques_of(configuration, np.zeros(6), np.zeros(6))
    with cell.world() as world:
        world.reset_arm(configuration.tolist())
        cell.hold(world, 60, configuration)
        _, _, torques = world.arm_state()
    assert np.abs(expected).max() > 20
    assert torques == pytest.approx(expected, rel=0.002, abs=0.01)


def test_torques_in_motion_are_those_of_the_whole_machine(cell, torques_of):
    """Inertia, Coriolis forces and weight, and nothing that damps."""
    start = cell.near(cell.scene.grasp.raised(0.15))
    rate_hz = 1000.0
    path = cell.path(start, start + np.array([0.8, -0.3, 0.4, -0.3, 0.3, -0.6]), 1.2, rate_hz)
    velocities = np.diff(path, axis=0) * rate_hz
    accelerations = np.diff(velocities, axis=0, prepend=np.zeros((1, 6))) * rate_hz
    errors, largest = [], np.zeros(6)
    with cell.world(rate_hz=rate_hz, bodies=cell.scene.bodies[:1]) as world:
        world.reset_arm(start.tolist())
        for index, velocity in enumerate(velocities):
            world.command_arm(path[index].tolist(), velocity.tolist())
            world.step()
            expected = torques_of(path[index], velocity, accelerations[index])
            largest = np.maximum(largest, np.abs(expected))
            errors.append(np.abs(np.array(world.arm_state()[2]) - expected))
    assert np.all(largest[:3] > 10)
    assert np.all(np.max(errors, axis=0) < 0.003 * largest + 0.005)


def test_a_joint_never_pulls_harder_than_its_limit(three_fingers):
    """Asked to carry what it cannot, the arm sinks."""
    robot = three_fingers.scene.robot
    weak = replace(robot, joints=tuple(replace(joint, torque_n_m=5.0) for joint in robot.joints))
    start = three_fingers.near(three_fingers.scene.grasp.raised(0.15))
    with three_fingers.world(robot=weak) as world:
        world.reset_arm(start.tolist())
        before = world.tool_pose().position_m[2]
        for _ in range(24):
            world.command_arm(start.tolist(), STILL)
            world.step()
            assert max(map(abs, world.arm_state()[2])) <= 5.0 * (1 + 1e-9)
        # Where it does not suffice, the torque is the limit itself, so that saturation can be told.
        assert max(map(abs, world.arm_state()[2])) >= 5.0 * (1 - 1e-9)
        assert world.tool_pose().position_m[2] < before - 0.005
