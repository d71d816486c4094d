"""Planning clock: time charged for a search."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from rgss.errors import MotionError


class ClockKind(str, Enum):
    """Kind of a planning clock."""

    COUNTED = "counted"
    WALL = "wall"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanningClock:
    """Clock of the planning time of a search.

    A counted clock charges the same time for each state-validity check, so that a seed gives the same result on any
    machine. A wall clock measures the time, and its results differ from run to run.

    Attributes:
        kind: Kind of the clock.
        charge_s: Time that a counted clock charges for one check, in s.

    Raises:
        MotionError: A counted clock charges zero or less for a check.
    """

    kind: ClockKind = ClockKind.COUNTED
    charge_s: float = 0.001

    def __post_init__(self) -> None:
        if self.kind is ClockKind.COUNTED and not self.charge_s > 0.0:
            raise MotionError(
                f"the charge of a counted clock must be above 0 s a check, got {self.charge_s:g} s",
                hint="give a time above zero, or use the wall clock",
            )

    def checks_within(self, limit_s: float) -> int:
        """Greatest number of checks whose time is at most a limit.

        Args:
            limit_s: The limit in s, inclusive.

        Raises:
            MotionError: The limit is negative, or the clock does not count.
        """
        if self.kind is ClockKind.WALL:
            raise MotionError(
                "the number of checks within a limit needs a counted clock, got a wall clock",
                hint="use a counted clock",
            )
        if not 0.0 <= limit_s < math.inf:
            raise MotionError(
                f"the planning time must be at least 0 s, got {limit_s:g} s", hint="give a time of zero or more"
            )
        # 4 s at 0.1 ms are 40,000 checks, although 4 / 0.0001 is less in binary.
        return math.floor(limit_s / self.charge_s * (1 + 1e-12))

    def time_s(self, checks: int) -> float:
        """Time in s charged for a number of checks.

        Args:
            checks: Number of state-validity checks.

        Raises:
            MotionError: The clock does not count.
        """
        if self.kind is ClockKind.WALL:
            raise MotionError(
                "the time of a number of checks needs a counted clock, got a wall clock", hint="use a counted clock"
            )
        return checks * self.charge_s

    def start(self) -> Callable[[int], float]:
        """Start the clock.

        Returns:
            A function that returns the time in s since the start, given the number of checks made since then.
        """
        if self.kind is ClockKind.COUNTED:
            return self.time_s
        begun = time.perf_counter()
        return lambda _checks: time.perf_counter() - begun
