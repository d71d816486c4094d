"""Half turn of a two-finger hand about its approach: the same grasp, reached by other configurations of the arm."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from rgss.grasping.candidates.ranked_grasp import RankedGrasp
from rgss.scenes import GripperGeometry, Pose

_HALF_TURN = Pose(quaternion_xyzw=(0.0, 0.0, 1.0, 0.0))
_DIGITS = 6
_TOLERANCE_RAD = 1e-6


def has_opposed_fingers(geometry: GripperGeometry) -> bool:
    """True if a half turn about the approach exchanges the pads of a hand.

    So for two opposed fingers and for a linkage. The other links of a linkage may differ on both sides: the filters of
    a candidate have the hand as it is turned.

    Args:
        geometry: The gripper's shape.
    """
    if geometry.cup is not None or geometry.fingers != 2:
        return False
    one, other = geometry.azimuths_rad
    return abs(abs(math.remainder(other - one, math.tau)) - math.pi) < _TOLERANCE_RAD


def with_half_turns(grasps: Sequence[RankedGrasp], geometry: GripperGeometry) -> tuple[RankedGrasp, ...]:
    """Candidates, each followed by its half turn unless that is a candidate already; unchanged of other hands.

    Args:
        grasps: The candidates in their order.
        geometry: The gripper's shape.
    """
    if not has_opposed_fingers(geometry):
        return tuple(grasps)
    known = {_key(one.tool_in_object) for one in grasps}
    found: list[RankedGrasp] = []
    for one in grasps:
        found.append(one)
        turned = one.tool_in_object @ _HALF_TURN
        if _key(turned) not in known:
            found.append(replace(one, id=f"{one.id}:turned", tool_in_object=turned))
    return tuple(found)


def _key(pose: Pose) -> tuple[float, ...]:
    """Position and axes of a pose, equal for equal poses but for rounding."""
    axes = (*pose.rotate((1.0, 0.0, 0.0)), *pose.rotate((0.0, 0.0, 1.0)))
    return tuple(round(value, _DIGITS) + 0.0 for value in (*pose.position_m, *axes))
