"""The planning clock."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.errors import MotionError
from rgss.motion import ClockKind, PlanningClock

WALL = PlanningClock(kind=ClockKind.WALL)


@pytest.mark.parametrize(
    ("limit_s", "charge_s", "checks"),
    [(4.0, 0.0001, 40_000), (8.0, 0.00025, 32_000), (0.3, 0.1, 3), (0.29, 0.1, 2), (0.0, 0.1, 0), (1.0, 3.0, 0)],
)
def test_checks_within_a_limit(limit_s, charge_s, checks):
    assert PlanningClock(charge_s=charge_s).checks_within(limit_s) == checks


@given(checks=st.integers(0, 10_000_000), charge_s=st.floats(1e-6, 1.0))
def test_the_time_of_a_number_of_checks_holds_that_number(checks, charge_s):
    clock = PlanningClock(charge_s=charge_s)
    assert clock.checks_within(clock.time_s(checks)) == checks


def test_a_counted_clock_tells_what_it_charges():
    assert PlanningClock(charge_s=0.002).start()(1500) == pytest.approx(3.0)


def test_a_wall_clock_tells_what_passes():
    elapsed_s = WALL.start()
    first = elapsed_s(10**9)
    assert 0.0 <= first < 60.0
    assert elapsed_s(0) >= first


@pytest.mark.parametrize("charge_s", [0.0, -0.1, float("nan")])
def test_a_charge_that_is_none(charge_s):
    with pytest.raises(MotionError) as caught:
        PlanningClock(charge_s=charge_s)
    assert caught.value.message == f"the charge of a counted clock must be above 0 s a check, got {charge_s:g} s"
    assert caught.value.hint == "give a time above zero, or use the wall clock"


@pytest.mark.parametrize("limit_s", [-1.0, float("inf"), float("nan")])
def test_a_limit_that_is_none(limit_s):
    with pytest.raises(MotionError) as caught:
        PlanningClock().checks_within(limit_s)
    assert caught.value.message == f"the planning time must be at least 0 s, got {limit_s:g} s"
    assert caught.value.hint == "give a time of zero or more"


def test_a_wall_clock_does_not_count():
    with pytest.raises(
        MotionError, match="the number of checks within a limit needs a counted clock, got a wall clock"
    ):
        WALL.checks_within(1.0)
    with pytest.raises(MotionError, match="the time of a number of checks needs a counted clock, got a wall clock"):
        WALL.time_s(1)
