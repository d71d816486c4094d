"""Findings about objects that are too heavy for the robot or the fingers, or too weak for the grip of the designs."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.documents import Document, read_document
from rgss.evidence import Fidelity
from rgss.findings import Finding, Severity
from rgss.scenes import Gripper
from rgss.studies.checks.bench_check import variants_text
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project


def object_limit_findings(project: Project) -> Iterator[Finding]:
    """Warn of objects heavier than the payload of the robot or the friction of the fingers, or damaged by the grip."""
    label = project.study.scene
    document = read_document(project.folder / label, label=label)
    yield from _heavy(project, document)
    yield from _slippery(project, document)
    yield from _fragile(project, document)


def _heavy(project: Project, document: Document) -> Iterator[Finding]:
    """Objects heavier than the payload of an arm; a note where another arm of the designs takes them."""
    robots = [one.scene.robot for one in project.by_arm().values()]
    for index, object_ in enumerate(project.scene.objects):
        workpiece = object_.workpiece
        weak = [robot for robot in robots if workpiece.mass_kg > robot.payload_kg]
        is_of_all = len(weak) == len(robots)
        for robot in weak:
            of = "the robot" if len(robots) == 1 else robot.id
            yield document.finding(
                "scene.payload",
                f"{workpiece.id} of {workpiece.mass_kg:.3g} kg exceeds the payload of {of}, {robot.payload_kg:g} kg",
                mass_location(document, index),
                severity=Severity.WARNING if is_of_all else Severity.INFO,
                hint="take a lighter object, or a robot with a greater 'payload'"
                if is_of_all
                else "designs with another arm take it",
            )


def _slippery(project: Project, document: Document) -> Iterator[Finding]:
    """Objects that the friction of no design's fingers bears at rest, by Coulomb's law."""
    unborne = unborne_objects(project)
    for index, object_ in enumerate(project.scene.objects):
        workpiece = object_.workpiece
        if workpiece.id not in unborne:
            continue
        strongest, needed_n = unborne[workpiece.id]
        yield document.finding(
            "scene.grip",
            f"the friction of no design's fingers bears {workpiece.id} of {workpiece.mass_kg:.3g} kg: that takes "
            f"{needed_n:.3g} N on each, and they press with {strongest.finger_force_n:.3g} N at most",
            mass_location(document, index),
            severity=Severity.WARNING,
            hint="take a lighter object, or fingers with more force or friction",
        )


def unborne_objects(project: Project) -> dict[str, tuple[Gripper, float]]:
    """Objects whose weight the friction of no design's fingers bears, by Coulomb's law.

    Returns:
        By object the gripper that bears most, and the force of each finger in N that the weight takes.
    """
    if project.study.fidelity is not Fidelity.CONTACT:
        return {}
    found = {}
    grippers = {spec.gripper for spec in trial_specs(project, seeds=(project.study.seed,))}
    for workpiece in (one.workpiece for one in project.scene.objects):
        weight_n = workpiece.mass_kg * project.scene.gravity_m_s2
        borne_n = {
            gripper: gripper.geometry.fingers * gripper.finger_force_n * gripper.grip_coefficient(workpiece.friction)
            for gripper in grippers
        }
        strongest = max(borne_n, key=borne_n.__getitem__)
        if strongest.suction is None and borne_n[strongest] < weight_n:
            found[workpiece.id] = (strongest, weight_n * strongest.finger_force_n / borne_n[strongest])
    return found


def mass_location(document: Document, index: int) -> tuple[str | int, ...]:
    """Location of the mass or density of an object in its scene's file."""
    data = document.data if isinstance(document.data, dict) else {}
    others = data.get("workpieces")
    entry = data.get("workpiece") if index == 0 or not isinstance(others, list) else others[index - 1]
    states_mass = isinstance(entry, dict) and "mass" in entry
    at: tuple[str | int, ...] = ("workpieces", index - 1) if index else ("workpiece",)
    return (*at, "mass" if states_mass else "density")


def _fragile(project: Project, document: Document) -> Iterator[Finding]:
    """Grips that damage the first object at rest, whatever the impact of the fingers."""
    if project.study.fidelity is not Fidelity.CONTACT:
        return
    from rgss.trials import closing_impact

    specs = [spec for spec in trial_specs(project, seeds=(project.study.seed,)) if spec.gripper.suction is None]
    impacts = {spec.variant: closing_impact(spec) for spec in specs}
    damaging = [variant for variant, impact in impacts.items() if impact.least_n > impact.limit_n]
    if not damaging:
        return
    least_n = min(impacts[variant].least_n for variant in damaging)
    is_of_all = len(damaging) == len(impacts)
    yield document.finding(
        "scene.force-limit",
        f"{project.scene.workpiece.id} bears {project.scene.workpiece.force_limit_n:g} N, and the fingers hold it with "
        f"{least_n:.3g} N or more in {variants_text(damaging)}",
        ("workpiece", "force_limit"),
        severity=Severity.WARNING if is_of_all else Severity.INFO,
        hint="lower the force of the fingers"
        if is_of_all
        else "these designs fail at the grasp, and the others do not",
    )
