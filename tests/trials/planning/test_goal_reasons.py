"""Reasons why a pose has no valid configuration, of collision models whose answers are stated."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

import pytest

from rgss.kinematics import Arm, NearestPair
from rgss.scenes import Pose
from rgss.studies.checks.scene_texts import remedy
from rgss.trials.planning.direct_moves import _obstacle
from rgss.trials.planning.goal_reasons import Obstacle, infeasibility_reason
from rgss.trials.scene_check import SceneProblem, SceneProblemKind
from tests.fixtures.serial_arms import SCARA, serial_robot

LIMIT_RAD = math.radians(45.0)
CLEARANCE_M = 0.008
AT_THE_LIMIT_M = CLEARANCE_M + 3e-16
FAR_M = 0.1


@dataclass(frozen=True)
class StatedModel:
    """Collision model whose answers for a configuration are its distance in m and its tilt in degrees."""

    situation = SimpleNamespace(largest_tilt_rad=LIMIT_RAD)

    def nearest_pair(self, q):
        return NearestPair(first="finger_1", second="tray", distance_m=q[0], clearance_m=CLEARANCE_M)

    def carried_tilt_rad(self, q):
        return math.radians(q[1])


def reason_of(*candidates):
    return infeasibility_reason(None, [StatedModel()], Pose(position_m=(0.0, 0.0, 0.0)), candidates)


def test_a_distance_exactly_at_the_clearance_violates_it_and_no_tilt_is_named():
    reason = reason_of((-0.002, 0.0), (AT_THE_LIMIT_M, 0.0))

    assert reason.obstacle is Obstacle.CLEARANCE
    assert str(reason) == (
        "clearance: finger_1 is 8.0 mm from tray, more than 8.0 mm must be kept, in the best of 2 configurations"
    )


def test_the_tilt_is_that_of_a_configuration_that_nothing_else_obstructs():
    reason = reason_of((-0.002, 0.0), (FAR_M, 90.0), (FAR_M, 60.0))

    assert reason.obstacle is Obstacle.TILT
    assert str(reason) == "the object would be tilted by 60°, in the best of 3 configurations"


def test_a_smaller_distance_is_named_with_the_clearance():
    assert str(reason_of((0.005, 60.0))) == (
        "clearance: finger_1 is 5.0 mm from tray, 8.0 mm must be kept, in the only one"
    )


@pytest.mark.parametrize(
    ("distance_m", "tilt_deg", "words"),
    [
        (AT_THE_LIMIT_M, 0.0, "finger_1 is 8.0 mm from tray, more than 8 mm must be kept"),
        (AT_THE_LIMIT_M, 60.0, "the object would be tilted by 60°"),
        (FAR_M, 0.0, "a joint leaves its range"),
    ],
)
def test_the_state_that_obstructs_a_direct_move_is_named_with_its_cause(distance_m, tilt_deg, words):
    assert _obstacle(StatedModel(), (distance_m, tilt_deg)) == words


# The tool of a scara points down, 0.6 m from its first axis at most, and at least where its elbow is at 2.9 rad.
NEAREST_M = math.hypot(0.35 + 0.25 * math.cos(2.9), 0.25 * math.sin(2.9))


@pytest.mark.parametrize(
    ("x_m", "words", "hint"),
    [
        (0.5, "the tool comes to this position in other orientations alone, ", "the vertical there ('grasp_yaw')"),
        (
            0.05,
            f"the tool comes no nearer to this position than {(NEAREST_M - 0.05) * 1e3:.0f} mm in any orientation, ",
            "turn the tool about the vertical there",
        ),
        (1.5, "out of reach: ", "move it nearer to the robot"),
    ],
)
def test_a_pose_that_nothing_reaches_is_named_with_what_is_measured(x_m, words, hint):
    arm = Arm(serial_robot(SCARA, base=Pose()), Pose())
    x, y, _ = arm.first_axis_m
    pose = Pose(position_m=(x + x_m, y, float(arm.tool_position(arm.robot.home_rad)[0][2])))
    from_m = math.dist(pose.position_m, arm.first_axis_m)

    reason = infeasibility_reason(SimpleNamespace(arm=arm, excess_of_ranges=lambda pose: ()), [], pose, [])

    told = f"{words}{from_m:.2f} m from the origin of the arm's first joint, reach {arm.reach_m:.2f} m from there "
    assert f"{told}with the gripper" in str(reason)
    assert hint in remedy(SceneProblem(kind=SceneProblemKind.UNSERVED, first="cup", is_yaw_stated=True, reason=reason))
