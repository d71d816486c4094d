"""Findings about objects that slide or turn in the fingers of the designs, or tear off a cup, when they are lifted."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from rgss.documents import Document
from rgss.evidence import Fidelity
from rgss.findings import Finding, Severity
from rgss.scenes import Gripper
from rgss.scenes.uncertainty import NOTHING_UNCERTAIN, ONE_WORKLOAD
from rgss.studies.checks.bench_check import variants_text
from rgss.studies.checks.object_limit_check import mass_location, unborne_objects
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project

if TYPE_CHECKING:
    from rgss.trials import HeldLoad

_PADS = (
    "slides or turns between the pads of {variants}: they bear",
    "grip it nearer to its centre of mass, or with more force or friction",
)
_CUP = (
    "tears off the cup of {variants}: the seal bears",
    "take a lighter object or a cup with more force, or hold it nearer to its centre of mass",
)


@dataclass(frozen=True, slots=True)
class _Failing:
    """Way in which an object leaves the hand.

    Attributes:
        includes: True for a load that does.
        hand: What it leaves, with the variants, and the hint.
        load: What the hand bears, with the most that a variant bears.
        borne_1: That, divided by what it needs.
        is_note: True if the object may be carried all the same.
    """

    includes: Callable[[HeldLoad], bool]
    hand: tuple[str, str]
    load: str
    borne_1: Callable[[HeldLoad], float]
    is_note: bool = False


_LIFT = "{one.factor:.3g} times its weight at most, and a lift at full acceleration takes {one.needed:.3g} times"
_ASIDE = "{one.aside_1:.3g} times the load of a move aside at full acceleration at most"
_FIRST = (
    "{one.first_load:.3g} times its weight with the force of the grip and {one.factor:.3g} times once the hand has "
    "tightened, and a lift at full acceleration takes {one.needed:.3g} times"
)
_TURNS = (
    "turns, as its lift begins, between the pads of {variants}: they bear",
    "it is carried tilted or dropped: grip it nearer to its centre of mass, or with more force or friction",
)
_WAYS = (
    _Failing(lambda one: not one.is_borne and not one.has_cup, _PADS, _LIFT, lambda one: one.factor / one.needed),
    _Failing(lambda one: not one.is_borne and one.has_cup, _CUP, _LIFT, lambda one: one.factor / one.needed),
    _Failing(lambda one: one.is_borne and not one.is_carried, _CUP, _ASIDE, lambda one: one.aside_1),
    _Failing(
        lambda one: one.is_borne and not one.is_borne_at_first,
        _TURNS,
        _FIRST,
        lambda one: one.first_load / one.needed,
        is_note=True,
    ),
)


def held_load_findings(project: Project, document: Document) -> Iterator[Finding]:
    """Warn of objects that no hand can lift or carry at the tool's full acceleration; a note if some designs can.

    Args:
        project: The project with its study.
        document: The scene's file.
    """
    if project.study.fidelity is not Fidelity.CONTACT:
        return
    from rgss.trials import held_loads

    loads: dict[tuple[Gripper, float], tuple[HeldLoad, ...]] = {}
    unborne: dict[str, list[tuple[HeldLoad, int]]] = {}
    specs = trial_specs(project, seeds=(project.study.seed,))
    for spec in specs:
        alike = spec.gripper, spec.scene.robot.tool_acceleration_m_s2
        if alike not in loads:
            stated = replace(spec, uncertainty=NOTHING_UNCERTAIN, workload=ONE_WORKLOAD)
            loads[alike] = tuple(held_loads(stated))
        for load in loads[alike]:
            if not (load.is_borne and load.is_carried and load.is_borne_at_first):
                unborne.setdefault(load.object, []).append((load, spec.variant))
    unborne_at_rest = unborne_objects(project)
    for index, object_ in enumerate(project.scene.objects):
        name = object_.workpiece.id
        of_object = unborne.get(name, [])
        if not of_object or name in unborne_at_rest:
            continue
        is_of_all = len(of_object) == len(specs)
        for way in _WAYS:
            failing = [(load, variant) for load, variant in of_object if way.includes(load)]
            if not failing:
                continue
            best = max((load for load, _ in failing), key=way.borne_1)
            hand, hint = way.hand
            of_designs = hand.format(variants=variants_text([variant for _, variant in failing]))
            yield document.finding(
                "scene.grip-load",
                f"{name} {of_designs} {way.load.format(one=best)}",
                mass_location(document, index),
                severity=Severity.WARNING if is_of_all and not way.is_note else Severity.INFO,
                hint=hint
                if is_of_all or way.is_note
                else "these designs fail once it is lifted, and the others do not",
            )
