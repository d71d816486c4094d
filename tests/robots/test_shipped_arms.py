"""The shipped arms: kinematics against published tables and poses, dynamics against another engine."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pybullet
import pytest

from rgss.cli.main import main
from rgss.findings import Severity
from rgss.kinematics import Arm, ArmDynamics, inverse_kinematics
from rgss.physics.engine import load_urdf_text
from rgss.scenes import Pose, load_robot
from rgss.studies.robot_project.description import unchecked_pairs

ROBOTS = Path(__file__).resolve().parents[2] / "scenes" / "robots"
ARMS = ("lite6", "yumi_right_arm")

# UFACTORY, "Kinematic and Dynamic Parameters of UFACTORY Lite 6", standard D-H parameters: offset and alpha in deg,
# d and a in mm. The description is made from the other, the modified table of that page.
LITE6 = (
    (0, 243.3, -90, 0),
    (-90, 0, 180, 200),
    (-90, 0, 90, 87),
    (0, 227.6, 90, 0),
    (0, 0, -90, 0),
    (0, 61.5, 0, 0),
)

# Joint positions in deg, and the flange's position in mm and roll, pitch and yaw in deg, as RobotStudio reports them:
# rpiRobotics/yumi-ik, unit_tests/compare_to_robotstudio.m. The arm stands on its own foot, 306 mm below the shoulder.
YUMI = (
    ((0, 0, 0, 0, 0, 0, 0), (341.50, 0.00, 598.00), (0.00, 90.00, 0.00)),
    ((20,) * 7, (292.46, 234.73, 348.75), (148.67, 16.13, 175.45)),
    ((30,) * 7, (165.49, 290.86, 255.37), (157.34, -19.80, -175.99)),
    ((-40,) * 7, (-219.17, 12.62, 796.12), (13.67, -3.39, -152.29)),
    ((-80,) * 7, (-126.60, 499.23, 441.88), (5.30, 17.08, 34.27)),
    ((104, -31, 1, -18, -55, 117, 69), (32.02, 91.43, 763.94), (157.59, 43.43, 170.70)),
    ((162, 1, -23, -88, 241, 98, -44), (45.84, 32.22, 846.74), (-98.58, 43.30, -76.21)),
    ((-20, -139, -144, 77, -263, 128, -104), (-47.12, -136.89, 270.77), (-106.88, -60.36, 122.56)),
    ((67, -142, 121, 78, -38, 113, -194), (-100.23, 3.25, 338.01), (43.05, -59.81, 44.29)),
    ((-58, -138, -35, 70, -283, 133, 207), (-123.66, 141.01, 425.04), (-118.25, -37.89, -10.09)),
)
SHOULDER_MM = 306.0


def turn(axis: int, angle: float) -> np.ndarray:
    """Rotation about a coordinate axis, shape (4, 4)."""
    cosine, sine = np.cos(angle), np.sin(angle)
    first, second = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(4)
    matrix[[first, first, second, second], [first, second, first, second]] = cosine, -sine, sine, cosine
    return matrix


def shift(x: float, y: float, z: float) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def rolled(roll: float, pitch: float, yaw: float) -> np.ndarray:
    return turn(2, yaw) @ turn(1, pitch) @ turn(0, roll)


def robot_of(name):
    return load_robot(ROBOTS / f"{name}.yaml", base=Pose(), project=ROBOTS.parents[1])


def configurations(robot, count, seed=3):
    ends = np.array([(joint.lower_rad, joint.upper_rad) for joint in robot.joints])
    return ends[:, 0] + np.random.default_rng(seed).random((count, len(ends))) * (ends[:, 1] - ends[:, 0])


def test_lite6_is_where_its_published_table_says():
    robot = robot_of("lite6")
    arm = Arm(robot, Pose())
    for q in configurations(robot, 500):
        expected = np.eye(4)
        for (offset, d, alpha, a), angle in zip(LITE6, q, strict=True):
            link = turn(2, np.radians(offset) + angle) @ shift(a / 1e3, 0, d / 1e3) @ turn(0, np.radians(alpha))
            expected = expected @ link
        assert np.max(np.abs(arm.tool_matrix(q) - expected)) < 1e-9


@pytest.mark.parametrize(("degrees", "position_mm", "angles"), YUMI)
def test_yumi_is_where_robotstudio_says(degrees, position_mm, angles):
    tree = ET.parse(ROBOTS / "yumi_right_arm.urdf")  # noqa: S314 - a file of ours
    (origin,) = tree.findall("joint[@name='joint_1']/origin")
    xyz, rpy = (np.array([float(each) for each in origin.get(key).split()]) for key in ("xyz", "rpy"))
    shoulder = shift(*xyz) @ rolled(*rpy)
    arm = Arm(robot_of("yumi_right_arm"), Pose())

    found = shift(0, 0, SHOULDER_MM / 1e3) @ np.linalg.inv(shoulder) @ arm.tool_matrix(np.radians(degrees))

    assert found[:3, 3] == pytest.approx(np.array(position_mm) / 1e3, abs=1e-5)
    expected = rolled(*np.radians(angles))
    apart = np.arccos(np.clip((np.trace(expected[:3, :3].T @ found[:3, :3]) - 1) / 2, -1, 1))
    assert np.degrees(apart) < 0.02


@pytest.mark.parametrize("name", ARMS)
def test_every_pose_of_the_arm_has_a_configuration(name):
    robot = robot_of(name)
    arm = Arm(robot, Pose())
    inverse = inverse_kinematics(arm)
    found = 0
    for q in configurations(robot, 60):
        pose = arm.tool_pose(q)
        for solution in inverse.solve(pose):
            assert np.max(np.abs(arm.tool_matrix(solution) - arm.tool_matrix(q))) < 1e-6
            found += 1
        assert inverse.nearest(pose, robot.home_rad) is not None
    assert found >= 60


@pytest.mark.parametrize("name", ARMS)
def test_torques_are_those_of_another_engine(name):
    robot = robot_of(name)
    dynamics = ArmDynamics(robot, (), gravity_m_s2=9.81)
    client = pybullet.connect(pybullet.DIRECT)
    try:
        pybullet.setGravity(0, 0, -9.81, physicsClientId=client)
        flags = pybullet.URDF_USE_INERTIA_FROM_FILE
        body = load_urdf_text(client, robot.urdf, position=(0, 0, 0), orientation=(0, 0, 0, 1), flags=flags)
        rng = np.random.default_rng(1)
        for q in configurations(robot, 20):
            speed, acceleration = rng.normal(size=(2, len(robot.joints)))
            given = [list(map(float, each)) for each in (q, speed, acceleration)]
            expected = pybullet.calculateInverseDynamics(body, *given, physicsClientId=client)
            assert dynamics.torques(q, speed, acceleration) == pytest.approx(expected, abs=1e-6)
    finally:
        pybullet.disconnect(client)


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("ending", ["urdf", "yaml"])
def test_nothing_is_wrong_with_its_description(name, ending, capsys):
    assert main(["robot", str(ROBOTS / f"{name}.{ending}")]) == 0
    assert "Reach:" in capsys.readouterr().out


@pytest.fixture
def thick(tmp_path):
    """A Lite6 whose flange is so long that it always touches the link before the wrist."""
    for ending in ("urdf", "yaml"):
        text = (ROBOTS / f"lite6.{ending}").read_text(encoding="utf-8")
        (tmp_path / f"lite6.{ending}").write_text(text.replace('length="0.018"', 'length="0.2"'), encoding="utf-8")
    return load_robot(tmp_path / "lite6.yaml", base=Pose(), project=tmp_path), tmp_path / "lite6.urdf"


def test_links_that_always_touch_are_noted(thick):
    (finding,) = unchecked_pairs(*thick, "scenes/robots/lite6.urdf")

    assert (finding.rule, finding.severity) == ("robot.unchecked-pair", Severity.INFO)
    assert finding.message.startswith("link4 and link6 touch in every configuration, and are not checked")
    assert finding.line == 1 + thick[1].read_text(encoding="utf-8").splitlines().index('  <link name="link4">')
    for name in ARMS:
        assert unchecked_pairs(robot_of(name), ROBOTS / f"{name}.urdf", name) == ()


def test_without_engines_no_pair_is_noted(thick, monkeypatch):
    def missing(robot):
        raise ImportError("No module named 'coal'", name="coal")

    monkeypatch.setattr("rgss.studies.robot_project.description.lasting_contacts", missing)
    assert unchecked_pairs(*thick, "scenes/robots/lite6.urdf") == ()
