"""What is wrong with a planning problem or with limits is said in one line."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.errors import MotionError
from rgss.motion import MotionLimits, PlanningProblem


def problem(**changes):
    values = {"lower_rad": (-1.0, -1.0), "upper_rad": (1.0, 1.0), "start": (0.0, 0.0), "goal": (0.5, 0.5)}
    return PlanningProblem(**({"resolution_rad": 0.1} | values | changes))


def test_arrays_become_plain_numbers():
    made = problem(start=np.array([0.25, 0.5]))
    assert made.start == (0.25, 0.5)
    assert made == problem(start=(0.25, 0.5))


def test_numbers_of_joints_that_differ():
    with pytest.raises(MotionError) as caught:
        problem(goal=(0.5, 0.5, 0.5))
    assert caught.value.message == "ranges, start and goal must have the same number of joints"
    assert caught.value.hint == "found 2, 2, 2, 3"


def test_no_joints_at_all():
    with pytest.raises(MotionError, match="the same number of joints"):
        problem(lower_rad=(), upper_rad=(), start=(), goal=())


def test_a_range_that_is_empty():
    with pytest.raises(MotionError) as caught:
        problem(lower_rad=(-1.0, 1.0))
    assert caught.value.message == "a joint's planning range is empty"
    assert caught.value.hint == "let its lower limit be below its upper limit"


@pytest.mark.parametrize("resolution", [0.0, -0.1, math.inf, math.nan])
def test_a_resolution_that_is_none(resolution):
    with pytest.raises(MotionError) as caught:
        problem(resolution_rad=resolution)
    assert caught.value.message == f"the resolution must be above 0 rad, got {resolution:g} rad"
    assert caught.value.hint == "give a distance above zero"


def test_limits_of_different_numbers_of_joints():
    with pytest.raises(MotionError) as caught:
        MotionLimits(speed_rad_s=(1.0, 1.0), acceleration_rad_s2=(1.0,), tool_speed_m_s=1.0)
    assert caught.value.message == "joint speed and acceleration limits must be equally many, got 2 and 1"
    assert caught.value.hint == "give one of each for every joint"


@pytest.mark.parametrize(
    "changes", [{"speed_rad_s": (0.0,)}, {"acceleration_rad_s2": (-2.0,)}, {"tool_speed_m_s": 0.0}]
)
def test_a_limit_that_nothing_can_keep(changes):
    limits = MotionLimits(speed_rad_s=(1.0,), acceleration_rad_s2=(1.0,), tool_speed_m_s=1.0)
    with pytest.raises(MotionError, match="motion limits must be positive, got") as caught:
        replace(limits, **changes)
    assert caught.value.hint == "give every limit a value above zero"
