"""Followers of an arm whose coupling gives way, since it does not transmit what they need."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rgss.scenes import Robot

SLIP = 2.0e-3
"""Deviation of a follower with a limited effort from its ratio, in rad or m, from which its coupling has given way.

In the contact world a coupling within its effort holds to 20 µrad.
"""


def slipped(robot: Robot, driven: Sequence[float], followers: Sequence[float]) -> str:
    """Name of the follower that has slipped farthest; empty if none has.

    Args:
        robot: The arm.
        driven: Positions of its driven joints in rad or m.
        followers: Positions of its followers.
    """
    wanted = robot.follower_positions(driven)
    errors = {
        one.name: abs(position - at)
        for one, position, at in zip(robot.followers, followers, wanted, strict=True)
        if math.isfinite(one.effort)
    }
    worst = max(errors, key=lambda name: errors[name], default="")
    return worst if errors.get(worst, 0.0) > SLIP else ""
