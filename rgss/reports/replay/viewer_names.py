"""Names in files for other viewers: frames of bodies, and plotted quantities with the unit at the end."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import count

from rgss.trials.replay import NodeTrack

_UNIT_SUFFIXES = {"rad": "rad", "m": "m", "rad/s": "rad_s", "m/s": "m_s", "N": "n", "1": "1"}


WORLD = "world"
"""Frame of the world, z up."""

LONGEST_ARROW_M = 0.22
"""Length of the arrow of the greatest force, as on the page."""

TOUCH_ARROW_M = 0.16
"""Length of the arrow of a contact that is no grip, as on the page."""


def frame_of(track: NodeTrack) -> str:
    """Frame of a body: its kind and its name, since a link and an object may have the same name."""
    return f"{track.kind.value}/{track.name}"


def topic_of(title: str) -> str:
    """Topic of a plot: ``joint_positions`` of "Joint positions"."""
    return re.sub(r"\W+", "_", title.lower())


def series_keys(named: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """Key of each series of a plot: ``finger_1_n`` of "finger 1" in N.

    Names that differ in capitals and signs alone, such as "A-1" and "a 1", would have the same key; the second has
    ``a_1_2_rad``, or the next number that is free.

    Args:
        named: Name and unit of each series.
    """
    found: dict[str, None] = {}
    for name, unit in named:
        topic, suffix = topic_of(name), _UNIT_SUFFIXES[unit]
        numbered = (f"{topic}_{number}_{suffix}" for number in count(2))
        key = f"{topic}_{suffix}"
        found[key if key not in found else next(each for each in numbered if each not in found)] = None
    return tuple(found)
