"""Estimate of the remaining time of a long command, in words."""

from __future__ import annotations

from dataclasses import dataclass

ESTIMATING = "estimating"
"""Text before anything is done."""

_LEAST = 1e-6
"""Part of a step below which nothing is left: sums of parts are not exact."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RemainingTime:
    """Estimate of the time for the remaining steps, at the mean pace of those that are done.

    Attributes:
        total: Number of steps.
        begun_s: Time of the beginning.
        done: Number of steps that are done, also in parts.
        reached_s: Time at which they were done.
    """

    total: int
    begun_s: float
    done: float = 0.0
    reached_s: float = 0.0

    @property
    def in_words(self) -> str:
        """Such as "1:05 left"; "estimating" before anything is done, empty at the end."""
        if self.done <= 0.0:
            return ESTIMATING
        left = self.total - self.done
        return left_in_words((self.reached_s - self.begun_s) / self.done * left) if left > _LEAST else ""


def left_in_words(seconds: float) -> str:
    """Remaining time in minutes and seconds, such as "1:05 left".

    Args:
        seconds: The time in s.
    """
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes}:{rest:02d} left"
