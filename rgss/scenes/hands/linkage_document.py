"""Document model of grippers whose mechanism is a URDF."""

from __future__ import annotations

from typing import Literal

from rgss.documents import Dimensionless, DocumentModel, Identifier, Metres, MetresPerSecond, Newtons, Radians, Text
from rgss.scenes.document import AssumptionEntry, CollisionShapes, FirmGraspEntry


class MountEntry(DocumentModel):
    """Pose of the palm's frame at the flange, with rotations about x, y and z of the flange in this order."""

    at: tuple[Metres, Metres, Metres] = (0.0, 0.0, 0.0)
    roll: Radians = 0.0
    pitch: Radians = 0.0
    yaw: Radians = 0.0


class LinkageGripperDocument(DocumentModel):
    """Gripper file of a mechanism in a URDF with one driven joint."""

    gripper: Identifier
    kind: Literal["linkage"]
    description: Text
    palm: Text | None = None
    pads: tuple[Text, Text]
    mount: MountEntry = MountEntry()
    collision: CollisionShapes = CollisionShapes.HULL
    grasp_from_tip: Metres | None = None
    friction: Dimensionless | None = None
    force: Newtons | None = None
    speed: MetresPerSecond | None = None
    firm_grasp: FirmGraspEntry | None = None
    mounting: Identifier | None = None
    assumptions: tuple[AssumptionEntry, ...] = ()
