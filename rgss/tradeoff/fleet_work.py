"""Work limit of a search: counted operations, and seconds only where the user limits them."""

from __future__ import annotations

import time
from enum import Enum

MOST_WORK = 1_000_000_000
"""So many entries of members in tasks are looked at by default to prove a portfolio best: about ten seconds."""


class Cut(str, Enum):
    """The limit that ended a search before its proof was complete."""

    WORK = "work limit"
    TIME = "time limit"


class Work:
    """What is left of a work limit.

    Args:
        most: So many operations; None for any number.
        deadline: The reading of the monotonic clock at which the work ends; None for no such limit.

    Attributes:
        cut: The limit that ended the search; None while none has.
    """

    def __init__(self, most: int | None, deadline: float | None = None) -> None:
        self._most = most
        self._left = most
        self._deadline = deadline
        self.cut: Cut | None = None

    def spend(self, count: int) -> None:
        """Count operations."""
        if self._left is not None:
            self._left -= count
            if self._left <= 0:
                self.cut = self.cut or Cut.WORK
        if self._deadline is not None and time.monotonic() >= self._deadline:
            self.cut = self.cut or Cut.TIME

    def part(self, parts: int) -> Work:
        """A part of the whole work, which is spent of it as well."""
        return _Part(self, parts)

    @property
    def spent(self) -> bool:
        """Whether a limit is reached."""
        return self.cut is not None


class _Part(Work):
    """A part of a work limit: one of so many parts of the operations or of the seconds that are left."""

    def __init__(self, whole: Work, parts: int) -> None:
        deadline = whole._deadline  # noqa: SLF001 - the same concept
        if deadline is not None:
            now = time.monotonic()
            deadline = now + max(0.0, deadline - now) / parts
        super().__init__(None if whole._most is None else whole._most // parts, deadline)  # noqa: SLF001
        self._whole = whole

    def spend(self, count: int) -> None:
        """Count operations of the part and of the whole."""
        super().spend(count)
        self._whole.spend(count)
        self.cut = self.cut or self._whole.cut
