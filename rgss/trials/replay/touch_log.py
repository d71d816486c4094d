"""Log of what a robot touches that it is not meant to touch."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

from rgss.physics import RobotContact
from rgss.trials.replay.replay_scene import Touch

APART_S = 0.1
"""Contacts of the same pair that are less than this apart are one; a part that chatters touches once."""


class TouchLog:
    """Contacts of a robot's parts with the scene and of what is no finger with the workpiece, over a trial."""

    def __init__(self) -> None:
        """Start without contacts."""
        self._ended: list[Touch] = []
        self._last: dict[tuple[str, str], Touch] = {}

    def add(self, time_s: float, contacts: Iterable[RobotContact], *, workpiece: str) -> None:
        """Note the contacts of a step.

        Args:
            time_s: Time after the step.
            contacts: Its contacts.
            workpiece: Id of the object that is the workpiece.
        """
        for one in contacts:
            pair = (one.link, one.body or workpiece)
            last = self._last.get(pair)
            if last is not None and time_s - last.end_s >= APART_S:
                self._ended.append(last)
                last = None
            if last is None or math.hypot(*one.force_n) > math.hypot(*last.force_n):
                start_s = time_s if last is None else last.start_s
                self._last[pair] = Touch(
                    link=pair[0],
                    body=pair[1],
                    start_s=start_s,
                    end_s=time_s,
                    point_m=one.position_m,
                    force_n=one.force_n,
                )
            else:
                self._last[pair] = replace(last, end_s=time_s)

    def touches(self, end_s: float) -> tuple[Touch, ...]:
        """Contacts that began up to a time, by start, then by names."""
        found = [one for one in (*self._ended, *self._last.values()) if one.start_s <= end_s + 1e-9]
        return tuple(sorted(found, key=lambda one: (one.start_s, one.link, one.body)))
