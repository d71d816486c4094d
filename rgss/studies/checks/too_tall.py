"""Objects that a hand cannot reach round, because they would touch its palm."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from rgss.scenes import GRIPPER_BASE_LINK, GripperGeometry, at_object, palm_fit
from rgss.studies.checks.gripped_objects import gripped_views
from rgss.studies.project import Project

if TYPE_CHECKING:
    from rgss.trials import SceneProblem


@dataclass(frozen=True, slots=True, kw_only=True)
class TooTall:
    """An object that is too tall for a hand.

    Attributes:
        object: The object.
        top_m: Height of its top above the grasp.
        most_m: The greatest height that leaves the clearance below the palm.
    """

    object: str
    top_m: float
    most_m: float


def objects_too_tall(geometry: GripperGeometry, project: Project) -> tuple[TooTall, ...]:
    """Gripped objects whose top would reach the palm, or come nearer to it than the clearance.

    Args:
        geometry: The gripper's shape.
        project: The project.
    """
    found = []
    for name, view in gripped_views(project):
        fit = palm_fit(at_object(geometry, view), view)
        most_m = 0.0 if fit is None else fit.palm_m - project.study.planning.clearance_m
        if fit is not None and fit.top_m > most_m:
            found.append(TooTall(object=name, top_m=fit.top_m, most_m=most_m))
    return tuple(found)


def is_at_the_palm(problem: SceneProblem, name: str) -> bool:
    """True if a problem is that of palm and object, which has a finding of its own where the object is too tall.

    Args:
        problem: The problem of the arm with the hand.
        name: The object.
    """
    pair = None if problem.reason is None else problem.reason.pair
    return pair is not None and {*pair} == {GRIPPER_BASE_LINK, name}
