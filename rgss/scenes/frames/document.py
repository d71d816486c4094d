"""Document model of a named frame."""

from __future__ import annotations

from rgss.documents import DocumentModel, Identifier, Metres, Radians


class FrameEntry(DocumentModel):
    """Pose of a frame in its parent; the default parent is the world in a scene, the base in a robot file."""

    parent: Identifier | None = None
    position: tuple[Metres, Metres, Metres]
    roll: Radians = 0.0
    pitch: Radians = 0.0
    yaw: Radians = 0.0
