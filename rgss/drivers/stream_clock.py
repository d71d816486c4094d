"""Clock of a stream of set points."""

from __future__ import annotations

import time
from typing import Protocol


class StreamClock(Protocol):
    """A clock that a stream reads and waits on."""

    def now_s(self) -> float:
        """Time from any fixed origin; never decreasing."""

    def wait_until(self, time_s: float) -> None:
        """Return at a time, or at once if it has passed."""


class MonotonicClock:
    """The system's monotonic clock, for robots that move in real time."""

    def now_s(self) -> float:
        """Seconds from an origin of the system's choice."""
        return time.monotonic()

    def wait_until(self, time_s: float) -> None:
        """Sleep until a time."""
        time.sleep(max(0.0, time_s - time.monotonic()))
