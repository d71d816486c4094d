"""Work limit of a search: counted operations, and seconds only where the user limits them."""

from __future__ import annotations

import time
from enum import Enum

MOST_WORK = 2_000_000_000
"""Default work limit to prove a portfolio best, in evaluated values of members in tasks: some 20 seconds."""


class Cut(str, Enum):
    """The limit that ended a search before its proof was complete."""

    WORK = "work limit"
    TIME = "time limit"


class WorkBudget:
    """Counter of operations with a limit.

    Args:
        most: So many operations; None for any number.
        deadline: The reading of the monotonic clock at which the work ends; None for no such limit.

    Attributes:
        cut: The limit that is reached; None while none is.
        done: The operations that were counted.
    """

    def __init__(self, most: int | None, deadline: float | None = None) -> None:
        self._most = most
        self._deadline = deadline
        self.done = 0
        self.cut: Cut | None = None

    def spend(self, count: int) -> None:
        """Count operations."""
        self.done += count
        if self._most is not None and self.done >= self._most:
            self.cut = self.cut or Cut.WORK
        if self._deadline is not None and time.monotonic() >= self._deadline:
            self.cut = self.cut or Cut.TIME

    def part(self, parts: int) -> WorkBudget:
        """A counter with one of so many parts of the limit, whose operations count here as well."""
        deadline = self._deadline
        if deadline is not None:
            now = time.monotonic()
            deadline = now + max(0.0, deadline - now) / parts
        return _Part(self, None if self._most is None else self._most // parts, deadline)

    @property
    def spent(self) -> bool:
        """True if a limit is reached."""
        return self.cut is not None


class _Part(WorkBudget):
    """Counter whose operations count for another one as well."""

    def __init__(self, whole: WorkBudget, most: int | None, deadline: float | None) -> None:
        super().__init__(most, deadline)
        self._whole = whole

    def spend(self, count: int) -> None:
        """Count operations of the part and of the whole."""
        super().spend(count)
        self._whole.spend(count)
        self.cut = self.cut or self._whole.cut
