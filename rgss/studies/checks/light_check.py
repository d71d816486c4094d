"""Findings about fingers and objects that are too light for the contact physics to pass a force through them."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.documents import read_document
from rgss.evidence import Fidelity
from rgss.findings import Finding, Severity
from rgss.studies.checks.bench_check import variants_text
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project


def light_body_findings(project: Project) -> Iterator[Finding]:
    """Warn of fingers and objects through which no force passes, however long the solver runs in a step."""
    if project.study.fidelity is not Fidelity.CONTACT:
        return
    from rgss.physics import light_fingers, light_object

    found: dict[tuple[str, str], list[int]] = {}
    for spec in trial_specs(project, seeds=(project.study.seed,)):
        gripper, physics = spec.gripper, spec.settings.physics
        problems = [light_fingers(gripper, physics)]
        for workpiece in (one.workpiece for one in spec.scene.objects):
            problem = light_object(workpiece.mass_kg, gripper, physics)
            problems.append(None if problem is None else (f"{workpiece.id}: {problem[0]}", problem[1]))
        for problem in problems:
            if problem is not None:
                found.setdefault(problem, []).append(spec.variant)
    document = read_document(project.folder / project.study.label, label=project.study.label)
    for (message, hint), variants in found.items():
        yield document.finding(
            "study.light-body",
            f"{message} ({variants_text(variants)})",
            ("physics", "rate"),
            severity=Severity.WARNING,
            hint=hint,
        )
