"""Clock of a task: accumulated planning and motion time, compared with the time limit."""

from __future__ import annotations

import math


class TaskClock:
    """Elapsed time of a task."""

    def __init__(self, limit_s: float | None) -> None:
        """Start at zero.

        Args:
            limit_s: Time limit of the task; None for no limit.
        """
        self._limit_s = limit_s
        self._spent_s: list[float] = []

    def spend(self, duration_s: float | None) -> None:
        """Add a time.

        Args:
            duration_s: The time; None counts as zero.
        """
        if duration_s is not None:
            self._spent_s.append(duration_s)

    @property
    def overrun(self) -> str:
        """Message with both times if the limit is exceeded, else empty."""
        if self._limit_s is None or (spent_s := math.fsum(self._spent_s)) <= self._limit_s:
            return ""
        return f"the task took {spent_s:.3g} s, which exceeds its limit of {self._limit_s:g} s"
