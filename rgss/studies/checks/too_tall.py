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
        palm_m: Height of the palm above the grasp.
        clearance_m: Clearance of planned paths, which its top must keep from the palm.
    """

    object: str
    top_m: float
    palm_m: float
    clearance_m: float

    @property
    def most_m(self) -> float:
        """The greatest height of a top that keeps the clearance; negative if the clearance reaches below the grasp."""
        return self.palm_m - self.clearance_m

    def message(self, grippers: str) -> str:
        """The heights, for the grippers of some files."""
        text = f"{self.object} is too tall for {grippers}: held at its middle, its top is {_mm(self.top_m)} above the"
        clearance = f"the clearance of planned paths of {_mm(self.clearance_m)}"
        if self.most_m <= 0.0:
            return f"{text} grasp and the palm {_mm(self.palm_m)}, less than {clearance}"
        return f"{text} grasp, and the palm leaves {_mm(self.most_m)}"

    @property
    def hint(self) -> str:
        """Remedy: another gripper, or a lower clearance or object."""
        text = "a gripper with longer fingers, or let the task choose the grasp ('candidates' of the task)"
        room_m = self.palm_m - self.top_m
        lower = f"lower 'clearance' of 'planning' below {_mm(room_m)}"
        if self.most_m > 0.0:
            text = f"take an object of at most {_mm(2 * self.most_m)}, {text}"
            return f"{text}, or {lower}" if room_m > 0.0 else text
        return f"{lower}, take {text}" if room_m > 0.0 else f"take {text}"


def objects_too_tall(geometry: GripperGeometry, project: Project) -> tuple[TooTall, ...]:
    """Gripped objects whose top would reach the palm, or come nearer to it than the clearance.

    Args:
        geometry: The gripper's shape.
        project: The project.
    """
    found, clearance_m = [], project.study.planning.settings.clearance_m
    for name, view in gripped_views(project):
        fit = palm_fit(at_object(geometry, view), view)
        if fit is not None and fit.top_m > fit.palm_m - clearance_m:
            found.append(TooTall(object=name, top_m=fit.top_m, palm_m=fit.palm_m, clearance_m=clearance_m))
    return tuple(found)


def is_at_the_palm(problem: SceneProblem, name: str) -> bool:
    """True if a problem is that of palm and object, which has a finding of its own where the object is too tall."""
    pair = None if problem.reason is None else problem.reason.pair
    return pair is not None and {*pair} == {GRIPPER_BASE_LINK, name}


def _mm(metres: float) -> str:
    return f"{metres * 1e3:.4g} mm"
