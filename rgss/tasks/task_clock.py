"""Clock of a task: planning and motion so far, against the time that the task allows."""

from __future__ import annotations

import math


class TaskClock:
    """The time since a task began."""

    def __init__(self, limit_s: float | None) -> None:
        """Begin at zero.

        Args:
            limit_s: Longest time of the task; None if it has no limit.
        """
        self._limit_s = limit_s
        self._spent_s: list[float] = []

    def spend(self, duration_s: float | None) -> None:
        """Add a time.

        Args:
            duration_s: The time; None where nothing took any.
        """
        if duration_s is not None:
            self._spent_s.append(duration_s)

    @property
    def overrun(self) -> str:
        """The times in words if the limit is passed, else an empty text."""
        if self._limit_s is None or (spent_s := math.fsum(self._spent_s)) <= self._limit_s:
            return ""
        return f"the task had taken {spent_s:.3g} s, and may take {self._limit_s:g} s"
