"""How the grasp of an object is stated, and the grasp that is taken."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from rgss.scenes.pose import Pose


class Approach(str, Enum):
    """Direction of the tool on the way to the object, by its angle with straight down."""

    ABOVE = "above"
    OBLIQUE = "oblique"
    SIDE = "side"


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenGrasp:
    """A grasp that the file of an object gives.

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
    """Which grasps are tried.

    Attributes:
        approaches: Directions of the tool.
        heights: Places along the approach.
        yaws: Turns about the axis of a cylinder, or about the line between the pads on a mesh.
        samples: Points of a mesh's surface from which opposite points are looked for; 0 for the given grasps alone.
    """

    approaches: tuple[Approach, ...] = (Approach.ABOVE, Approach.SIDE)
    heights: int = 3
    yaws: int = 8
    samples: int = 64


@dataclass(frozen=True, slots=True, kw_only=True)
class SuctionPoint:
    """A place of a suction cup on a flat face of an object.

    Attributes:
        position_m: Middle of the cup on the object, in the object's frame.
        normal: Unit normal of the face, out of the object.
        room_m: Distance to the nearest edge of the face.
    """

    position_m: tuple[float, float, float]
    normal: tuple[float, float, float]
    room_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class TakenGrasp:
    """The grasp that is taken.

    Attributes:
        id: Its name.
        tool_in_object: Transform of the grasp-centre frame to the object's frame.
        opening_m: Distance of the pads from the gripper's axis when they touch.
        place_yaw_rad: Turn of the object about the vertical at its place, in the world.
        quality_1: Smallest maximum wrench for finger forces of 1 N; of a suction cup, the weight that it bears over the
            force of its vacuum.
        com_distance_m: Distance of the centre of mass from the middle of the contacts, or from the cup's axis.
        candidates: How many candidates there were.
        rejected: How many of them were rejected before it.
        suction: The place of the cup; None for fingers.
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
