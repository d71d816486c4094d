"""Objects that the task grips, as a hand meets them, and findings about those that it cannot hold."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from rgss.documents import Document
from rgss.findings import Finding, Severity
from rgss.scenes import Scene, initial_placements, scene_about
from rgss.studies.project import Project
from rgss.tasks import HandAction, stages_of


def gripped_views(project: Project) -> Iterator[tuple[str, Scene]]:
    """The name of every object that the task grips, each once, and the scene about it as it stands at the start."""
    scene = project.scene
    placements, stages = initial_placements(scene), stages_of(project.study.task, scene.workpiece.id)
    for name in dict.fromkeys(stage.object for stage in stages if stage.step.hand is HandAction.CLOSES):
        yield name, scene_about(scene, name, place="", placements=placements)


def unfit_objects(project: Project, reason_of: Callable[[Scene], str]) -> tuple[tuple[str, str], ...]:
    """Gripped objects that a hand does not hold with the stated grasp, each with the reason.

    Args:
        project: The project; where its task chooses among candidates, these have findings of their own.
        reason_of: Reason for the object that a scene is about; empty if the hand holds it.
    """
    if project.scene.task.candidates is not None:
        return ()
    reasons = ((name, reason_of(view)) for name, view in gripped_views(project))
    return tuple((name, reason) for name, reason in reasons if reason)


def unfit_finding(
    document: Document,
    location: tuple[str | int, ...],
    rule: str,
    reason: str,
    grippers: Sequence[str],
    *,
    serves: bool,
    hint: str,
) -> Finding:
    """Finding about an object that a hand does not hold; a note if the designs have another gripper.

    Args:
        document: The scene's file.
        location: The object's place there.
        rule: Id of the finding.
        reason: Reason why it is not held.
        grippers: Files of the grippers that do not hold it.
        serves: True if the designs have another gripper, for which the object is fit.
        hint: Remedy if they have none.
    """
    return document.finding(
        rule,
        f"{reason} ({', '.join(sorted(grippers))})",
        location,
        hint="designs with this gripper fail at the grasp, and the others do not" if serves else hint,
        severity=Severity.INFO if serves else Severity.ERROR,
    )
