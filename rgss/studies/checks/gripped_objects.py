"""Objects that the task grips, as a hand meets them, and findings about those that it cannot hold."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rgss.documents import Document
from rgss.findings import Finding, Severity
from rgss.scenes import GripperGeometry, Scene, initial_placements, scene_about, too_narrow, too_wide, unsealed
from rgss.studies.project import Project
from rgss.tasks import HandAction, stages_of

if TYPE_CHECKING:
    from rgss.trials import SceneProblem


def gripped_views(project: Project) -> Iterator[tuple[str, Scene]]:
    """The name of every object that the task grips, each once, and the scene about it as it stands at the start."""
    scene = project.scene
    placements, stages = initial_placements(scene), stages_of(project.study.task, scene.workpiece.id)
    for name in dict.fromkeys(stage.object for stage in stages if stage.step.hand is HandAction.CLOSES):
        yield name, scene_about(scene, name, place="", placements=placements)


@dataclass(frozen=True, slots=True, kw_only=True)
class Misfit:
    """Kind of misfit: why a hand does not hold an object with the stated grasp.

    Attributes:
        rule: Id of the finding.
        reason_of: Reason for a hand and the object that a scene is about; empty if the hand holds it.
        hint: Remedy if the designs have no other gripper.
    """

    rule: str
    reason_of: Callable[[GripperGeometry, Scene], str]
    hint: str

    def objects(self, geometry: GripperGeometry, project: Project) -> tuple[tuple[str, str], ...]:
        """Gripped objects that a hand does not hold, each with the reason.

        Args:
            geometry: The gripper's shape.
            project: The project; where its task chooses among candidates, these have findings of their own.
        """
        if project.scene.task.candidates is not None:
            return ()
        reasons = ((name, self.reason_of(geometry, view)) for name, view in gripped_views(project))
        return tuple((name, reason) for name, reason in reasons if reason)

    def finding(
        self, document: Document, location: tuple[str | int, ...], reason: str, grippers: Sequence[str], *, serves: bool
    ) -> Finding:
        """Finding about an object that a hand does not hold; a note if the designs have another gripper.

        Args:
            document: The scene's file.
            location: The object's place there.
            reason: Reason why it is not held.
            grippers: Files of the grippers that do not hold it.
            serves: True if the designs have another gripper, for which the object is fit.
        """
        return document.finding(
            self.rule,
            f"{reason} ({', '.join(sorted(grippers))})",
            location,
            hint="designs with this gripper fail at the grasp, and the others do not" if serves else self.hint,
            severity=Severity.INFO if serves else Severity.ERROR,
        )


def _unsealed(geometry: GripperGeometry, scene: Scene) -> str:
    # The place of a cup on the object is not determined for fingers.
    return "" if geometry.cup is None else unsealed(geometry, scene)


NOT_SEALED = Misfit(
    rule="scene.seal",
    reason_of=_unsealed,
    hint="take a smaller cup, or let the task choose the grasp with 'grasp: automatic'",
)
TOO_WIDE = Misfit(
    rule="scene.too-wide",
    reason_of=too_wide,
    hint="take a narrower object or a wider gripper, or turn the grasp about the vertical",
)
TOO_NARROW = Misfit(
    rule="scene.too-narrow",
    reason_of=too_narrow,
    hint="take a wider object, or a gripper that closes further ('stroke' of its file)",
)
MISFITS = (NOT_SEALED, TOO_WIDE, TOO_NARROW)
"""Every kind."""


def is_of_fingers(problem: SceneProblem, name: str) -> bool:
    """True if a problem is that of the hand and an object, which has a finding of its own if it is too wide."""
    return problem.reason is not None and problem.reason.pair is not None and name in problem.reason.pair
