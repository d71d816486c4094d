"""Named frame of a scene."""

from __future__ import annotations

from dataclasses import dataclass, field

from rgss.scenes.pose import Pose


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedFrame:
    """Frame by name, fixed to the world or to an object.

    Attributes:
        id: Its name.
        pose: Transform of the frame to the world, or to the object. Of the frames of a robot file, to its base.
        object: The object; empty for a frame that does not move.
        is_on_robot: True if it moves with the base of the robot, where a design sets that.
    """

    id: str
    pose: Pose
    object: str = ""
    is_on_robot: bool = field(default=False, compare=False)
