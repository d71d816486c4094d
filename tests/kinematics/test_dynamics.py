"""Joint torques of the arm with loads, against other engines, hand calculation and the laws that any dynamics obey."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rgss.errors import DefinitionError
from rgss.kinematics import Arm, ArmDynamics, Load, gripper_loads, workpiece_load
from rgss.scenes import Gripper, Pose, load_gripper, load_scene
from rgss.scenes.assembly import assembled_urdf, finger_joint

SCENES = Path(__file__).parents[2] / "scenes"
GRAVITY_M_S2 = 9.81
REST = np.zeros(6)


@pytest.fixture(scope="module")
def cell():
    return load_scene(SCENES / "restaurant.yaml")


@pytest.fixture(scope="module")
def ur10(cell):
    return cell.robot


@pytest.fixture(scope="module", params=[2, 3], ids=["two fingers", "three fingers"])
def hand(request):
    return Gripper(
        geometry=load_gripper(SCENES / "grippers" / f"kg-{request.param}.yaml"),
        base_mass_kg=0.55,
        finger_mass_kg=0.3,
        finger_velocity_m_s=0.04,
        finger_force_n=10.0,
        friction=0.7,
    )


@pytest.fixture
def states():
    """Random positions, speeds and accelerations."""

    def draw(count, seed=0):
        random = np.random.default_rng(seed)
        return [(random.uniform(-3, 3, 6), random.uniform(-2, 2, 6), random.uniform(-5, 5, 6)) for _ in range(count)]

    return draw


def dynamics(robot, *loads, gravity_m_s2=GRAVITY_M_S2):
    return ArmDynamics(robot, loads, gravity_m_s2=gravity_m_s2)


def point(mass_kg, *position_m):
    return Load(mass_kg=mass_kg, moments_kg_m2=(0.0, 0.0, 0.0), pose=Pose(position_m=position_m))


def mass_matrix(model, q):
    return np.array([model.torques(q, REST, unit) - model.torques(q, REST, REST) for unit in np.eye(6)])


@pytest.mark.engine
@pytest.mark.parametrize(("travel_m", "tilt_rad"), [(0.0, 0.0), (0.035, 0.0), (0.035, 0.6)])
def test_with_a_gripper_it_agrees_with_another_engine(ur10, hand, states, tmp_path, travel_m, tilt_rad):
    import pybullet

    # The other engine is given an upright arm and gravity that is tilted instead.
    robot = replace(ur10, base=Pose.from_roll_pitch_yaw((0.1, 0.2, 0.9), (tilt_rad, 0.0, 0.0)))
    gravity = (0.0, -GRAVITY_M_S2 * math.sin(tilt_rad), -GRAVITY_M_S2 * math.cos(tilt_rad))
    file = tmp_path / "arm.urdf"
    file.write_text(assembled_urdf(robot, hand), encoding="utf-8")
    client = pybullet.connect(pybullet.DIRECT)
    try:
        pybullet.setGravity(*gravity, physicsClientId=client)
        flags = pybullet.URDF_USE_INERTIA_FROM_FILE
        body = pybullet.loadURDF(str(file), useFixedBase=True, flags=flags, physicsClientId=client)
        infos = [pybullet.getJointInfo(body, i, client) for i in range(pybullet.getNumJoints(body, client))]
        movable = [info[1].decode() for info in infos if info[3] >= 0]
        arm = [joint.name for joint in robot.joints]
        fingers = [finger_joint(finger) for finger in range(hand.geometry.fingers)]
        assert movable == arm + fingers
        still = [0.0] * len(fingers)
        ours = dynamics(robot, *gripper_loads(hand, hand.geometry.largest_opening_m - travel_m))
        for q, dq, ddq in states(40, seed=1):
            theirs = pybullet.calculateInverseDynamics(
                body, [*q, *[travel_m] * len(fingers)], [*dq, *still], [*ddq, *still], client
            )
            assert ours.torques(q, dq, ddq) == pytest.approx(theirs[:6], abs=1e-6)
    finally:
        pybullet.disconnect(client)


def test_a_load_in_hand_calculation(ur10):
    # Stretched out, the load hangs 1.1843 m before the second axis and 0.5723 m before the third; the fourth axis
    # is above it, the others are vertical or pass through it.
    model, bare = dynamics(ur10, point(2.0, 0.0, 0.0, 0.145)), dynamics(ur10)
    added = model.torques(REST, REST, REST) - bare.torques(REST, REST, REST)
    assert np.abs(added) == pytest.approx([0.0, 2.0 * 9.81 * 1.1843, 2.0 * 9.81 * 0.5723, 0.0, 0.0, 0.0], abs=1e-9)
    # With the fifth joint at a right angle the load is also 92.2 mm + 145 mm beside the fourth axis.
    bent = np.array([0.0, 0.0, 0.0, 0.0, math.pi / 2, 0.0])
    added = model.torques(bent, REST, REST) - bare.torques(bent, REST, REST)
    assert abs(added[3]) == pytest.approx(2.0 * 9.81 * (0.0922 + 0.145), abs=1e-9)


def test_a_load_weighs_on_each_joint_by_its_lever(ur10, configurations, link_frames):
    # The weight's moment about each axis of the Denavit-Hartenberg convention, by plain vectors.
    mass, offset = 1.3, np.array([0.03, -0.02, 0.15, 1.0])
    model, bare = dynamics(ur10, point(mass, *offset[:3])), dynamics(ur10)
    for q in configurations(50, seed=2):
        frames = link_frames(q)
        place = (frames[6] @ offset)[:3]
        weight = np.array([0.0, 0.0, -mass * GRAVITY_M_S2])
        levers = [np.dot(frame[:3, 2], np.cross(place - frame[:3, 3], weight)) for frame in frames[:6]]
        added = model.torques(q, REST, REST) - bare.torques(q, REST, REST)
        assert added == pytest.approx(-np.array(levers), abs=1e-9)


def test_without_gravity_a_resting_arm_needs_no_torque(ur10, hand, configurations):
    model = dynamics(ur10, *gripper_loads(hand, 0.05), gravity_m_s2=0.0)
    for q in configurations(10):
        assert model.torques(q, REST, REST) == pytest.approx(REST, abs=1e-12)


def test_the_mass_matrix_is_symmetric_and_positive(ur10, hand, cell, configurations):
    model = dynamics(ur10, *gripper_loads(hand, 0.035), workpiece_load(cell.workpiece, hand.geometry.grasp_centre))
    for q in configurations(20, seed=3):
        matrix = mass_matrix(model, q)
        assert matrix == pytest.approx(matrix.T, abs=1e-10)
        assert np.linalg.eigvalsh(matrix)[0] > 0.0


def test_the_power_of_the_joints_becomes_energy(ur10, hand, cell, states):
    # dE/dt = τ·q̇ with E = ½ q̇ᵀ M q̇ + V; M changes along the motion, V by the torque that holds the arm at rest.
    model = dynamics(ur10, *gripper_loads(hand, 0.035), workpiece_load(cell.workpiece, hand.geometry.grasp_centre))
    step = 1e-5
    for q, dq, ddq in states(20, seed=4):
        change = (mass_matrix(model, q + step * dq) - mass_matrix(model, q - step * dq)) / (2 * step)
        kinetic = dq @ mass_matrix(model, q) @ ddq + 0.5 * dq @ change @ dq
        potential = model.torques(q, REST, REST) @ dq
        assert model.torques(q, dq, ddq) @ dq == pytest.approx(kinetic + potential, abs=1e-6)


def test_a_round_load_may_be_turned_about_its_axis(ur10, cell, states):
    pose = Pose(position_m=(0.01, 0.02, 0.15))
    turned = Pose.from_roll_pitch_yaw(pose.position_m, (0.0, 0.0, 0.7))
    upside_down = Pose.from_roll_pitch_yaw(pose.position_m, (math.pi, 0.0, 0.0))
    lying = Pose.from_roll_pitch_yaw(pose.position_m, (math.pi / 2, 0.0, 0.0))
    one, *same, other = (dynamics(ur10, workpiece_load(cell.workpiece, p)) for p in (pose, turned, upside_down, lying))
    for q, dq, ddq in states(10, seed=5):
        for model in same:
            assert model.torques(q, dq, ddq) == pytest.approx(one.torques(q, dq, ddq), abs=1e-10)
        assert np.max(np.abs(other.torques(q, dq, ddq) - one.torques(q, dq, ddq))) > 1e-6


def test_a_load_may_be_cut_in_two(ur10, cell, states):
    whole = cell.workpiece
    shape = replace(whole.shape, height_m=whole.shape.height_m / 2)
    half = replace(whole, shape=shape, mass_kg=whole.mass_kg / 2)
    turn = (0.4, -0.3, 0.2)
    centre = Pose.from_roll_pitch_yaw((0.01, 0.02, 0.15), turn)
    quarter = whole.shape.height_m / 4
    ends = (centre @ Pose(position_m=(0.0, 0.0, quarter)), centre @ Pose(position_m=(0.0, 0.0, -quarter)))
    one = dynamics(ur10, workpiece_load(whole, centre))
    two = dynamics(ur10, *(workpiece_load(half, end) for end in ends))
    for q, dq, ddq in states(10, seed=6):
        assert two.torques(q, dq, ddq) == pytest.approx(one.torques(q, dq, ddq), abs=1e-10)


def test_moments_are_those_of_points_off_the_centre(ur10, states):
    # Six points at ±d on the axes, m / 6 each: every principal moment is 4 (m / 6) d².
    mass, arm = 1.2, 0.05
    points = [
        point(mass / 6, *(sign * arm * axis + np.array([0.0, 0.0, 0.1]))) for axis in np.eye(3) for sign in (1.0, -1.0)
    ]
    moment = 4 * mass / 6 * arm**2
    ball = Load(
        mass_kg=mass, moments_kg_m2=(moment,) * 3, pose=Pose.from_roll_pitch_yaw((0.0, 0.0, 0.1), (1.0, 0.2, 3))
    )
    one, six = dynamics(ur10, ball), dynamics(ur10, *points)
    for q, dq, ddq in states(10, seed=7):
        assert six.torques(q, dq, ddq) == pytest.approx(one.torques(q, dq, ddq), abs=1e-10)


def test_loads_of_a_gripper_are_its_parts(hand):
    base, *fingers = gripper_loads(hand, 0.05)
    assert base.mass_kg == 0.55
    assert base.pose.position_m == pytest.approx((0.0, 0.0, 0.0425))
    assert [finger.mass_kg for finger in fingers] == [0.3] * hand.geometry.fingers
    assert sum(load.mass_kg for load in (base, *fingers)) == pytest.approx(hand.mass_kg)
    for finger in fingers:
        x, y, z = finger.pose.position_m
        assert math.hypot(x, y) == pytest.approx(0.05 + 0.006)
        assert z == pytest.approx(0.085 + 0.045)
    # A cylinder of 50 mm and 85 mm, a box of 12 mm, 20 mm and 90 mm.
    across = 0.55 * (3 * 0.05**2 + 0.085**2) / 12
    assert base.moments_kg_m2 == pytest.approx((across, across, 0.55 * 0.05**2 / 2))
    moments = [0.3 * (a**2 + b**2) / 12 for a, b in ((0.020, 0.090), (0.012, 0.090), (0.012, 0.020))]
    assert fingers[0].moments_kg_m2 == pytest.approx(moments)


def test_a_robot_that_is_ill_defined_is_refused(ur10):
    with pytest.raises(DefinitionError, match="has no link hand to carry the gripper"):
        dynamics(replace(ur10, flange="hand"))


def test_the_gradient_of_the_potential_energy_is_the_torque_at_rest(ur10, hand, states):
    arm = ArmDynamics(ur10, gripper_loads(hand, 0.03), gravity_m_s2=GRAVITY_M_S2)
    step = 1e-5
    for q, _, _ in states(10):
        gradient = [
            (arm.potential_energy_j(q + step * axis) - arm.potential_energy_j(q - step * axis)) / (2 * step)
            for axis in np.eye(6)
        ]
        assert gradient == pytest.approx(arm.torques(q, REST, REST), abs=1e-4)


def test_a_load_adds_its_weight_times_the_height_of_the_flange(ur10):
    mass_kg = 3.0
    load = Load(mass_kg=mass_kg, moments_kg_m2=(0.0, 0.0, 0.0), pose=Pose())
    bare, loaded = (ArmDynamics(ur10, loads, gravity_m_s2=GRAVITY_M_S2) for loads in ((), (load,)))
    arm = Arm(ur10, Pose())
    for q in np.random.default_rng(4).uniform(-2, 2, (5, 6)):
        added = loaded.potential_energy_j(q) - bare.potential_energy_j(q)
        assert added == pytest.approx(mass_kg * GRAVITY_M_S2 * arm.tool_position(q[None])[0, 2], abs=1e-9)
