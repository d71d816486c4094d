"""Arms and grippers that do not suit the task with the hulls of their collision meshes."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

from rgss.errors import DefinitionError
from rgss.studies.robot_project.urdf import has_concave_meshes


class UnfitShapesError(DefinitionError):
    """No layout was found for an arm, or no pads of a gripper.

    Attributes:
        is_concave: True if hulls that are much larger than the collision meshes may be the reason.
        is_gripper: True if the shapes of the gripper do not suit it.
    """

    def __init__(self, message: str, *, hint: str, is_concave: bool, is_gripper: bool = False) -> None:
        super().__init__(message, hint=hint)
        self.is_concave, self.is_gripper = is_concave, is_gripper


def is_any_mesh_concave(project: Path) -> bool:
    """True if the hull of a collision mesh of arm or gripper is much larger than the mesh.

    Args:
        project: The project that is being written.
    """
    return any(
        has_concave_meshes(ET.parse(urdf).getroot(), urdf.parent)  # noqa: S314 - written by this package
        for urdf in sorted((project / "scenes").glob("*/*.urdf"))
    )
