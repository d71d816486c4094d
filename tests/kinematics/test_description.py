"""What is wrong between a robot's data and its description is said in one line."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.errors import DefinitionError
from rgss.kinematics import Arm, inverse_kinematics
from rgss.kinematics.analytic_inverse import AnalyticInverse
from rgss.kinematics.numerical_inverse import NumericalInverse
from rgss.scenes import Pose


def test_a_text_that_is_no_description(new_robot, capfd):
    with pytest.raises(DefinitionError, match="the URDF of the robot ur10 cannot be read"):
        Arm(new_robot(urdf="<robot name='x'><link"), Pose())


def test_joints_that_the_description_does_not_have(new_robot, robot):
    joints = (replace(robot.joints[0], name="waist"), *robot.joints[1:])
    with pytest.raises(DefinitionError) as caught:
        Arm(new_robot(joints=joints), Pose())
    assert caught.value.message.startswith("the robot ur10 has the joints waist, shoulder_lift_joint")
    assert "its URDF has shoulder_pan_joint" in caught.value.message
    assert caught.value.hint == "name the movable joints as the URDF does, from base to flange"


def test_a_flange_that_is_not_there(new_robot):
    with pytest.raises(DefinitionError) as caught:
        Arm(new_robot(flange="tool0"), Pose())
    assert caught.value.message == "the robot ur10 has no link tool0 to carry the gripper"
    assert "wrist_3_link" in caught.value.hint
    assert "flange" in caught.value.hint


def test_an_arm_whose_inverse_kinematics_are_not_analytic(new_robot):
    # The middle axes are no longer parallel, and the wrist has no common point.
    twisted = new_robot().urdf.replace(
        '<origin xyz="-0.612 0 0" rpy="0 0 0"/>', '<origin xyz="-0.612 0.1 0.05" rpy="0.4 0.3 0"/>'
    )
    twisted = twisted.replace('<origin xyz="-0.5723 0 0" rpy="0 0 0"/>', '<origin xyz="-0.5 0 0.1" rpy="0.5 0.2 0"/>')
    arm = Arm(new_robot(urdf=twisted), Pose())
    with pytest.raises(DefinitionError) as caught:
        AnalyticInverse(arm)
    assert caught.value.message == "the robot ur10 has no known analytic inverse kinematics"
    assert caught.value.hint == "use an arm with a spherical wrist or three parallel axes, or the numerical one"
    assert isinstance(inverse_kinematics(arm), NumericalInverse)
