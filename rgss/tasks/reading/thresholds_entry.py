"""Document model of the default thresholds of a task's steps."""

from __future__ import annotations

from rgss.documents import DocumentModel, Metres, Radians


class ThresholdsEntry(DocumentModel):
    """Default thresholds of the task's steps."""

    joints: Radians | None = None
    gripper: Metres | None = None
