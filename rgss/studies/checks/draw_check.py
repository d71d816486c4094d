"""Findings about draws that the geometry of the scene excludes, or that no joint of the arm has."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from rgss.documents import read_document
from rgss.findings import Finding, Severity
from rgss.scenes import JointKind
from rgss.scenes.uncertainty import quantity_of
from rgss.studies.project import Project

_OFFSETS: Mapping[JointKind, tuple[str, str]] = MappingProxyType(
    {
        JointKind.REVOLUTE: ("turning", "robot.slide_offset for sliding joints"),
        JointKind.PRISMATIC: ("sliding", "robot.joint_offset for turning joints"),
    }
)


def draw_findings(project: Project) -> Iterator[Finding]:
    """Warn of draws with the centre of mass outside the object, or the object beside its support, or of no joint."""
    if not project.uncertainty.values:
        return
    yield from _joint_findings(project)
    try:
        from rgss.trials import draw_problems
    except ImportError:  # the check of the scene says that an engine is missing
        return
    for problem in draw_problems(project.scene, project.uncertainty):
        message = (
            f"{problem.share * 100:.3g} % of the draws of {problem.quantity} have the centre of mass "
            f"{f'beyond the edge of {problem.support}' if problem.support else f'outside {problem.object}'}, "
            f"by up to {problem.farthest_m * 1e3:.4g} mm"
        )
        hint = "narrow the distribution, such as by truncated_normal or uniform"
        yield _warning(project, "uncertainty.outside", problem.quantity, message, hint)


def _joint_findings(project: Project) -> Iterator[Finding]:
    """Warn of offsets of joints of a kind that no arm of the designs has."""
    arms = [one.scene.robot for one in project.by_arm().values()]
    kinds = {joint.kind for robot in arms for joint in robot.joints}
    for name in project.uncertainty.names:
        kind = quantity_of(name).joint_kind
        if kind is None or kind in kinds:
            continue
        joints, other = _OFFSETS[kind]
        message = f"{name} has no effect: {'the arm has no' if len(arms) == 1 else 'no arm has a'} {joints} joint"
        yield _warning(project, "uncertainty.no-joint", name, message, f"use {other}, or remove it")


def _warning(project: Project, rule: str, name: str, message: str, hint: str) -> Finding:
    """Warning at an uncertain quantity, in the file that states it."""
    label = project.study.label if name in project.study.uncertainty.names else project.study.scene
    document = read_document(project.folder / label, label=label)
    return document.finding(rule, message, ("uncertainty", name), severity=Severity.WARNING, hint=hint)
