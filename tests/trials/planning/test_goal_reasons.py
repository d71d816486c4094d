"""Reasons why a pose has no valid configuration, of collision models whose answers are stated."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

import pytest

from rgss.kinematics import NearestPair
from rgss.scenes import Pose
from rgss.trials.planning.direct_moves import _obstacle
from rgss.trials.planning.goal_reasons import Obstacle, infeasibility_reason

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
