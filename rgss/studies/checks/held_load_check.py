"""Findings about objects that slide or turn in the fingers of the designs, or tear off a cup, when they are lifted."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from rgss.documents import Document
from rgss.evidence import Fidelity
from rgss.findings import Finding, Severity
from rgss.scenes import Gripper
from rgss.scenes.uncertainty import NOTHING_UNCERTAIN, ONE_WORKLOAD
from rgss.studies.checks.bench_check import variants_text
from rgss.studies.checks.object_limit_check import mass_location, unborne_objects
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project

_PADS = (
    "slides or turns between the pads of {variants}: they bear",
    "grip it nearer to its centre of mass, or with more force or friction",
)
_CUP = (
    "tears off the cup of {variants}: the seal bears",
    "take a lighter object or a cup with more force, or hold it nearer to its centre of mass",
)


def held_load_findings(project: Project, document: Document) -> Iterator[Finding]:
    """Warn of objects that no hand can lift at the tool's full acceleration; a note if some designs can.

    Args:
        project: The project with its study.
        document: The scene's file.
    """
    if project.study.fidelity is not Fidelity.CONTACT:
        return
    from rgss.trials import HeldLoad, held_loads

    loads: dict[tuple[Gripper, float], tuple[HeldLoad, ...]] = {}
    unborne: dict[str, list[tuple[HeldLoad, int]]] = {}
    specs = trial_specs(project, seeds=(project.study.seed,))
    for spec in specs:
        alike = spec.gripper, spec.scene.robot.tool_acceleration_m_s2
        if alike not in loads:
            stated = replace(spec, uncertainty=NOTHING_UNCERTAIN, workload=ONE_WORKLOAD)
            loads[alike] = tuple(held_loads(stated))
        for load in loads[alike]:
            if not load.is_borne:
                unborne.setdefault(load.object, []).append((load, spec.variant))
    unborne_at_rest = unborne_objects(project)
    for index, object_ in enumerate(project.scene.objects):
        name = object_.workpiece.id
        of_object = unborne.get(name, [])
        if not of_object or name in unborne_at_rest:
            continue
        is_of_all = len(of_object) == len(specs)
        for has_cup in (False, True):
            failing = [(load, variant) for load, variant in of_object if load.has_cup is has_cup]
            if not failing:
                continue
            best = max((load for load, _ in failing), key=lambda load: load.factor / load.needed)
            hand, hint = _CUP if has_cup else _PADS
            of_designs = hand.format(variants=variants_text([variant for _, variant in failing]))
            yield document.finding(
                "scene.grip-load",
                f"{name} {of_designs} {best.factor:.3g} times its weight at most, and a lift at full acceleration "
                f"takes {best.needed:.3g} times",
                mass_location(document, index),
                severity=Severity.WARNING if is_of_all else Severity.INFO,
                hint=hint if is_of_all else "these designs fail once it is lifted, and the others do not",
            )
