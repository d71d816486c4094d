"""Objects on whose tops a suction cup does not seal."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.documents import Document
from rgss.findings import Finding, Severity
from rgss.scenes import GripperGeometry, initial_placements, scene_about, unsealed
from rgss.studies.project import Project
from rgss.tasks import HandAction, stages_of

Location = tuple[str | int, ...]


def unsealed_objects(geometry: GripperGeometry, project: Project) -> tuple[tuple[str, str], ...]:
    """Gripped objects on whose top a cup does not seal with the stated grasp, each with the reason.

    Args:
        geometry: The gripper's shape; one with fingers has none.
        project: The project; where its task chooses among candidates, these have findings of their own.
    """
    scene = project.scene
    if geometry.cup is None or scene.task.candidates is not None:
        return ()
    placements, stages = initial_placements(scene), stages_of(project.study.task, scene.workpiece.id)
    gripped = dict.fromkeys(stage.object for stage in stages if stage.step.hand is HandAction.CLOSES)
    reasons = (
        (name, unsealed(geometry, scene_about(scene, name, place="", placements=placements))) for name in gripped
    )
    return tuple((name, reason) for name, reason in reasons if reason)


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
    return document.finding(
        "scene.seal",
        f"{reason} ({', '.join(sorted(grippers))})",
        location,
        hint="designs with this gripper fail at the grasp, and the others do not"
        if serves
        else "take a smaller cup, or let the task choose the grasp with 'grasp: automatic'",
        severity=Severity.INFO if serves else Severity.ERROR,
    )
