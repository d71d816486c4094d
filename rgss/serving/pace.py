"""Pace of a sweep, and the time that is left at it."""

from __future__ import annotations

from collections import deque

_SPAN_S = 300.0
"""The pace is that of the last five minutes."""

_LEAST_S = 10.0


class Pace:
    """Progress over time."""

    def __init__(self) -> None:
        self._seen: deque[tuple[float, int]] = deque()

    def left(self, now_s: float, done: int, planned: int) -> str:
        """The time that is left, in words; empty while it cannot be known.

        Args:
            now_s: The time, of a clock that never goes back.
            done: The trials that are done.
            planned: All trials.
        """
        if self._seen and done < self._seen[-1][1]:
            self._seen.clear()
        self._seen.append((now_s, done))
        # What is older than the span counts no more, but for the last such look, from which the span is reached.
        while len(self._seen) > 2 and now_s - self._seen[1][0] > _SPAN_S:
            self._seen.popleft()
        begun_s, before = self._seen[0]
        if done >= planned or done == before or now_s - begun_s < _LEAST_S:
            return ""
        left_s = (planned - done) * (now_s - begun_s) / (done - before)
        minutes = round(left_s / 60)
        if minutes < 1:
            return "At this pace less than a minute is left."
        if minutes < 120:
            return f"At this pace about {minutes} {'minute is' if minutes == 1 else 'minutes are'} left."
        return f"At this pace about {round(left_s / 3600)} hours are left."
