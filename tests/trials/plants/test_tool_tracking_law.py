"""Tracking of the tool: the error decays with the gain, at the tool and for a redundant arm too."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rgss.errors import DefinitionError
from rgss.kinematics import Arm
from rgss.scenes import Pose
from rgss.trials import ControlMode, JointController
from rgss.trials.plants.joint_controller import control_law

STEP_S = 1.0 / 500.0
CONTROLLER = JointController(mode=ControlMode.TOOL_TRACKING, position_gain_1_s=5.0, velocity_gain_1_s=100.0)


def tool_error(arm, q, target):
    here, there = arm.tool_matrix(q), arm.tool_matrix(target)
    turned = Rotation.from_matrix(there[:3, :3] @ here[:3, :3].T).as_rotvec()
    return np.concatenate([there[:3, 3] - here[:3, 3], turned])


def settled(law, start, target, steps):
    q, dq = np.array(start), np.zeros(len(start))
    zero, course = np.zeros(len(start)), []
    for _ in range(steps):
        dq = dq + STEP_S * law(target, zero, zero, q, dq)
        q = q + STEP_S * dq
        course.append(q)
    return np.array(course)


def test_the_error_of_the_tool_decays_with_the_gain_along_its_own_direction(shipped):
    robot = shipped.scene.robot
    arm = Arm(robot, Pose())
    target = np.array(robot.home_rad)
    start = target + np.array([0.03, -0.02, 0.04, 0.02, -0.03, 0.05])
    law = control_law(CONTROLLER, robot.joints, step_s=STEP_S, tool=arm)

    course = settled(law, start, target, 500)

    first = tool_error(arm, start, target)
    errors = np.array([tool_error(arm, q, target) for q in course])
    late, later = 0.4, 0.8
    one, other = (errors[round(at / STEP_S) - 1] for at in (late, later))
    # Its closed loop is s² + g s + g k: the slow pole of g = 100, k = 5 is 5.28.
    slow = (100.0 - np.sqrt(100.0**2 - 4 * 500.0)) / 2
    assert np.linalg.norm(other) / np.linalg.norm(one) == pytest.approx(np.exp(-slow * (later - late)), rel=0.03)
    # The tool goes straight: its error keeps its direction. Joint by joint it would not.
    assert one[:3] @ first[:3] / np.linalg.norm(one[:3]) / np.linalg.norm(first[:3]) > 0.9999


def test_tracking_the_tool_needs_its_kinematics(shipped):
    with pytest.raises(DefinitionError, match="needs the kinematics of the tool"):
        control_law(CONTROLLER, shipped.scene.robot.joints, step_s=STEP_S)


@pytest.mark.engine
@pytest.mark.slow
def test_a_whole_trial_tracks_the_tool(folder, edit, capsys):
    from rgss.cli.main import main

    edit("studies/pick_place.yaml", "fidelity: contact", "fidelity: dynamic")
    edit("studies/pick_place.yaml", "planning:\n", "control: {mode: tool_tracking, tracking_limit: 20 mm}\nplanning:\n")

    assert main(["run", "28", "--project", str(folder)]) == 0

    shown = capsys.readouterr().out
    assert "dynamic fidelity, control tool tracking" in shown
    assert "Success in" in shown
