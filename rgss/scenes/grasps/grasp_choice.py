"""Specification of an object's grasp candidates, and the chosen grasp."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from rgss.scenes.pose import Pose


class Approach(str, Enum):
    """Approach direction of the tool, by its angle to straight down."""

    ABOVE = "above"
    OBLIQUE = "oblique"
    SIDE = "side"


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenGrasp:
    """Grasp given in the file of an object.

    Attributes:
        id: Its name.
        tool_in_object: Transform of the grasp-centre frame to the object's frame.
        width_m: Distance of the pads, twice their opening, as stated.
    """

    id: str
    tool_in_object: Pose
    width_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspCandidates:
    """Specification of the grasp candidates.

    Attributes:
        approaches: Approach directions of the tool.
        heights: Number of positions along the approach.
        yaws: Number of angles about the axis of a cylinder, or about the line between the pads on a mesh.
        samples: Number of sampled surface points of a mesh for antipodal pairs; 0 for the given grasps only.
    """

    approaches: tuple[Approach, ...] = (Approach.ABOVE, Approach.SIDE)
    heights: int = 3
    yaws: int = 8
    samples: int = 64


@dataclass(frozen=True, slots=True, kw_only=True)
class SuctionPoint:
    """Position of a suction cup on a flat face of an object.

    Attributes:
        position_m: Centre of the cup on the object, in the object's frame.
        normal: Unit normal of the face, out of the object.
        room_m: Distance to the nearest edge of the face.
    """

    position_m: tuple[float, float, float]
    normal: tuple[float, float, float]
    room_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ChosenGrasp:
    """The chosen grasp.

    Attributes:
        id: Its name.
        tool_in_object: Transform of the grasp-centre frame to the object's frame.
        opening_m: Distance of the pads from the gripper's axis when they touch.
        place_yaw_rad: Yaw of the object at its place, in the world.
        quality_1: Smallest maximum wrench for finger forces of 1 N; for a suction cup, the weight that it holds divided
        by the force of its vacuum.
        com_distance_m: Distance of the centre of mass from the centre of the contacts, or from the cup's axis.
        candidates: Number of candidates.
        rejected: Number of candidates rejected before it.
        suction: Position of the cup; None for fingers.
    """

    id: str
    tool_in_object: Pose
    opening_m: float
    place_yaw_rad: float
    quality_1: float
    com_distance_m: float
    candidates: int
    rejected: int
    suction: SuctionPoint | None = None
