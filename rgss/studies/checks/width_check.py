"""Findings about objects that are too wide or too narrow for the fingers of a hand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rgss.documents import Document
from rgss.findings import Finding
from rgss.scenes import GripperGeometry, too_narrow, too_wide
from rgss.studies.checks.gripped_objects import unfit_finding, unfit_objects
from rgss.studies.project import Project

if TYPE_CHECKING:
    from rgss.trials import SceneProblem

Location = tuple[str | int, ...]


def objects_too_wide(geometry: GripperGeometry, project: Project) -> tuple[tuple[str, str], ...]:
    """Gripped objects that the open fingers cannot enclose with the stated grasp, each with the reason.

    Args:
        geometry: The gripper's shape; a cup has none.
        project: The project; where its task chooses among candidates, these have findings of their own.
    """
    return unfit_objects(project, lambda view: too_wide(geometry, view))


def objects_too_narrow(geometry: GripperGeometry, project: Project) -> tuple[tuple[str, str], ...]:
    """Gripped objects that the closed fingers do not touch with the stated grasp, each with the reason.

    Args:
        geometry: The gripper's shape; a cup has none.
        project: The project; where its task chooses among candidates, these have findings of their own.
    """
    return unfit_objects(project, lambda view: too_narrow(geometry, view))


def width_finding(
    document: Document, location: Location, reason: str, grippers: Sequence[str], *, serves: bool
) -> Finding:
    """Finding about an object that is too wide; a note if the designs have another gripper.

    Args:
        document: The scene's file.
        location: The object's place there.
        reason: Reason why the fingers do not enclose it, with both sizes.
        grippers: Files of the grippers for which it is too wide.
        serves: True if the designs have another gripper, for which the object is fit.
    """
    hint = "take a narrower object or a wider gripper, or turn the grasp about the vertical"
    return unfit_finding(document, location, "scene.too-wide", reason, grippers, serves=serves, hint=hint)


def narrow_finding(
    document: Document, location: Location, reason: str, grippers: Sequence[str], *, serves: bool
) -> Finding:
    """Finding about an object that is too narrow; a note if the designs have another gripper.

    Args:
        document: The scene's file.
        location: The object's place there.
        reason: Reason why the fingers do not touch it, with both sizes.
        grippers: Files of the grippers for which it is too narrow.
        serves: True if the designs have another gripper, for which the object is fit.
    """
    hint = "take a wider object, or a gripper that closes further ('stroke' of its file)"
    return unfit_finding(document, location, "scene.too-narrow", reason, grippers, serves=serves, hint=hint)


def is_of_fingers(problem: SceneProblem, name: str) -> bool:
    """True if a problem is that of the hand and an object, which has a finding of its own if it is too wide."""
    return problem.reason is not None and problem.reason.pair is not None and name in problem.reason.pair
