"""Names in files for other viewers: frames of bodies, and plotted quantities with the unit at the end."""

from __future__ import annotations

import re

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


def series_key(name: str, unit: str) -> str:
    """Key of a series: ``finger_1_n`` of "finger 1" in N."""
    return f"{topic_of(name)}_{_UNIT_SUFFIXES[unit]}"
