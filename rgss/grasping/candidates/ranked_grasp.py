"""Grasp candidate with its quality."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes import Approach, Pose, SuctionPoint


@dataclass(frozen=True, slots=True, kw_only=True)
class RankedGrasp:
    """A candidate with its quality.

    Attributes:
        id: Its name.
        tool_in_object: Transform of the grasp-centre frame to the object's frame.
        opening_m: Distance of the pads from the gripper's axis.
        approach: Kind of its approach.
        quality_1: Smallest maximum wrench for finger forces of 1 N; for a cup, the weight that it holds divided by its
        force.
        com_distance_m: Distance of the centre of mass from the line or the centre of the contacts.
        suction: Pose of a suction cup on the object; None for fingers.
    """

    id: str
    tool_in_object: Pose
    opening_m: float
    approach: Approach
    quality_1: float
    com_distance_m: float
    suction: SuctionPoint | None = None
