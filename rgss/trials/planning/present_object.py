"""Name of the present object in the details of failures."""

from __future__ import annotations

import re

from rgss.scenes import Scene

_PRESENT_OBJECT = re.compile(r"\bthe (?:placed )?object\b")


def with_object_named(detail: str, scene: Scene) -> str:
    """Detail of a failure with the id of the present object, if the scene has several.

    Args:
        detail: The detail, in which it is "the object".
        scene: The scene about that object.
    """
    return _PRESENT_OBJECT.sub(scene.workpiece.id, detail) if scene.others else detail
