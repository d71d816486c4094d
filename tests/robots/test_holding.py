"""Weights that the joints of an arm hold, against another library's gravity torques in many configurations."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.cli.main import main
from rgss.scenes import Pose
from rgss.studies.robot_project.holding import payload_kg, weak_joints
from tests.fixtures.palletizer import palletizer
from tests.fixtures.serial_arms import SCARA, SEVEN, serial_urdf

TILTED = (
    '<link name="world"/><joint name="wall" type="fixed"><parent link="world"/><child link="base"/>{}</joint></robot>'
)
TURNS = ("0 0 0", "0 1.5707963 0", "0.7 0.3 0", "3.1415927 0 0")
MOUNTED = tuple(Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), turn) for turn in ((0.0, math.pi / 2, 0.0), (0.7, 0.3, 0.0)))


def tilted(rpy, text=None):
    """An arm whose URDF turns its base."""
    text = serial_urdf(SEVEN) if text is None else text
    return text.replace("</robot>", TILTED.format(f'<origin rpy="{rpy}"/>'))


def torques(text, flange="flange", count=20_000):
    """Torques of the arm itself and of a kilogram at the flange in configurations of another draw."""
    import pinocchio

    model = pinocchio.buildModelFromXML(text)
    data, flange = model.createData(), model.getFrameId(flange)
    draws = np.random.default_rng(7).uniform(model.lowerPositionLimit, model.upperPositionLimit, (count, model.nq))
    own, each = [], []
    for q in draws:
        own.append(pinocchio.computeGeneralizedGravity(model, data, q).copy())
        jacobian = pinocchio.computeFrameJacobian(model, data, q, flange, pinocchio.LOCAL_WORLD_ALIGNED)
        each.append(9.81 * jacobian[2])
    return np.array(own), np.array(each)


@pytest.mark.parametrize("rpy", TURNS)
def test_the_payload_is_the_least_over_the_configurations(draft, rpy):
    text = tilted(rpy)
    own, each = torques(text)
    carried = np.abs(each) > 1e-3
    expected = np.min((100.0 - np.sign(each) * own)[carried] / np.abs(each)[carried])
    # The drafted arm has 2,048 configurations, these are 20,000.
    assert expected * 0.98 < payload_kg(draft(text).robot) < expected * 1.06


@pytest.mark.parametrize("rpy", TURNS)
def test_joints_that_do_not_hold_the_arm_do_not_depend_on_how_the_base_is_turned(draft, rpy):
    text = tilted(rpy).replace('effort="100"', 'effort="10"')
    own, _ = torques(text)
    needed = np.max(np.abs(own), axis=0)
    robot = draft(text).robot
    found = {joint.name: joint.needed for joint in weak_joints(robot)}
    assert set(found) == {joint.name for joint, each in zip(robot.joints, needed, strict=True) if each > 10.0}
    assert "joint_2" in found
    for joint, each in zip(robot.joints, needed, strict=True):
        if joint.name in found:
            assert found[joint.name] == pytest.approx(each, rel=0.05)
    assert payload_kg(robot) == 0.0


@pytest.mark.parametrize("base", MOUNTED)
def test_a_base_that_the_scene_tilts_is_as_one_that_the_urdf_tilts(draft, base):
    level = replace(draft(serial_urdf(SEVEN)).robot, base=base)
    x, y, z = base.rotate((1.0, 0.0, 0.0)), base.rotate((0.0, 1.0, 0.0)), base.rotate((0.0, 0.0, 1.0))
    turn = np.array([x, y, z]).T
    roll, pitch = math.atan2(turn[2, 1], turn[2, 2]), math.asin(-turn[2, 0])
    other = draft(tilted(f"{roll!r} {pitch!r} 0")).robot
    assert payload_kg(level) == payload_kg(other)


def shown(capsys, path):
    status = main(["robot", str(path)])
    text = capsys.readouterr().out
    main(["robot", str(path), "--json"])
    return status, text, json.loads(capsys.readouterr().out)["payload_kg"]


def test_joints_that_do_not_hold_the_arm_hold_no_payload(capsys, tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(serial_urdf(SEVEN).replace('effort="100"', 'effort="10"'), encoding="utf-8")
    status, text, held = shown(capsys, path)
    assert (status, held) == (1, 0.0)
    assert "in the worst of 2048 configurations: none." in text
    assert "to hold the arm itself in the worst of 2048 configurations" in text


def test_joints_that_carry_no_weight_do_not_limit_the_payload(capsys, tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(serial_urdf(SCARA[:2]), encoding="utf-8")
    status, text, held = shown(capsys, path)
    assert (status, held) == (0, None)
    assert "configurations: not limited by the joints, which carry no weight." in text


def test_the_payload_is_limited_by_what_a_coupling_transmits(tmp_path):
    level = 'velocity="4.0" effort="300.0"'
    strong = payload_kg(palletizer(tmp_path))
    # The level joint of the shoulder holds the forearm, and what it carries at 0.4 m, when the forearm is level.
    own, per_kg = 9.81 * (3.0 * 0.2 + (0.8 + 0.3) * 0.4), 9.81 * 0.4
    assert strong > 20.0
    held = payload_kg(palletizer(tmp_path, (level, level.replace("300.0", "20.0"))))
    assert held == pytest.approx((20.0 - own) / per_kg, abs=0.1)
    (weak,) = weak_joints(palletizer(tmp_path, (level, level.replace("300.0", "9.0"))))
    assert (weak.name, weak.needed) == ("shoulder_level", pytest.approx(own, rel=0.01))
