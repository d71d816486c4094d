"""Findings about steps of a task that no design can carry out, at their places in the task's file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from rgss.findings import Finding, Severity
from rgss.studies.project import Project
from rgss.tasks import HandAction

if TYPE_CHECKING:
    from rgss.trials import CheckStepProblem, HandStepProblem


def step_findings(
    project: Project, problems: Mapping[HandStepProblem, Sequence[str]], *, grippers: int
) -> Iterator[Finding]:
    """Findings about grips beside the object, and releases beside or high above the place.

    Args:
        project: The project; the task of the package, which has no file, has no such steps.
        problems: The gripper files that have each problem.
        grippers: Number of gripper files of the designs.
    """
    loaded = project.study.task_file
    if loaded is None:
        return
    for problem, files in problems.items():
        step, at = loaded.program.steps[problem.step], loaded.places[problem.step]
        is_of_all = len(files) == grippers
        of = "" if is_of_all else f" with {', '.join(files)}"
        millimetres = f"{problem.distance_m * 1e3:.4g} mm"
        if problem.hand is HandAction.CLOSES:
            rule = "task.grip-beside"
            what = "the lip of the cup is" if problem.has_cup else "the ends of the fingers are"
            message = f"{step.name!r} grips nothing{of}: {what} {millimetres} from {problem.object}"
            hint = "move to grasp before it"
        elif problem.is_aside:
            rule = "task.release-place"
            message = (
                f"{step.name!r} releases {problem.object} {millimetres} from its place on {problem.support}{of}, "
                f"at most {problem.most_m * 1e3:g} mm"
            )
            hint = "move to that place before it, or release at the place of the move with 'release: {place: …}'"
        else:
            rule = "task.release-height"
            message = (
                f"{step.name!r} releases {problem.object} {millimetres} above its place on {problem.support}{of}, "
                f"at most {problem.most_m * 1e3:g} mm"
            )
            hint = "move to place before it, or increase largest_drop of the place region"
        severity = Severity.ERROR if is_of_all else Severity.INFO
        yield loaded.document.finding(rule, message, at, hint=hint, severity=severity)


def check_step_findings(project: Project, problems: Iterable[CheckStepProblem]) -> Iterator[Finding]:
    """Findings about conditions of check steps that the task itself excludes.

    Args:
        project: The project; the task of the package, which has no file, has no check.
        problems: The violated conditions.
    """
    loaded = project.study.task_file
    if loaded is None:
        return
    reported: set[tuple[str | int, ...]] = set()
    for problem in problems:
        step, at = loaded.program.steps[problem.step], loaded.places[problem.step]
        # The cycles of a repetition share the step of the file: the first one is enough.
        if (*at, problem.key) in reported:
            continue
        reported.add((*at, problem.key))
        message = f"{step.name!r} is violated even if every step is exact: {problem.detail}"
        hint = "move the check, or change the condition, the place or the position of the object"
        yield loaded.document.finding("task.check-violated", message, (*at, problem.key), hint=hint)
