"""Objects on whose tops a suction cup does not seal."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.documents import Document
from rgss.findings import Finding
from rgss.scenes import GripperGeometry, unsealed
from rgss.studies.checks.gripped_objects import unfit_finding, unfit_objects
from rgss.studies.project import Project

Location = tuple[str | int, ...]


def unsealed_objects(geometry: GripperGeometry, project: Project) -> tuple[tuple[str, str], ...]:
    """Gripped objects on whose top a cup does not seal with the stated grasp, each with the reason.

    Args:
        geometry: The gripper's shape; one with fingers has none.
        project: The project; where its task chooses among candidates, these have findings of their own.
    """
    if geometry.cup is None:
        return ()
    return unfit_objects(project, lambda view: unsealed(geometry, view))


def seal_finding(
    document: Document, location: Location, reason: str, grippers: Sequence[str], *, serves: bool
) -> Finding:
    """Finding about an object on which a cup does not seal; a note if the designs have another gripper.

    Args:
        document: The scene's file.
        location: The object's place there.
        reason: Reason why the cup does not seal.
        grippers: Files of the grippers with such a cup.
        serves: True if the designs have another gripper, for which the object is fit.
    """
    hint = "take a smaller cup, or let the task choose the grasp with 'grasp: automatic'"
    return unfit_finding(document, location, "scene.seal", reason, grippers, serves=serves, hint=hint)
