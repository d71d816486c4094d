"""Weights that do not separate the designs, with a remedy for each."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from rgss.assessment import VariantMeasures
from rgss.studies import Project
from rgss.tradeoff import Decision, FlatMeasure

_WORST = 1e-9
"""A value up to this is the worst."""


class FlatRemedy(str, Enum):
    """Change that would let a weight separate designs.

    Attributes:
        MOVE_ENDS: The quantities differ, but all lie beyond one end of the value function: move the ends to them.
        VARY_THE_WORLD: Trials give the same value for all, above the worst: the task is too easy for the designs.
        EASE_THE_TASK: Trials give the worst value for all: the task is too hard for the designs.
        OTHER_DESIGNS: The quantity follows from the design, and the feasible designs do not differ in it.
    """

    MOVE_ENDS = "move_ends"
    VARY_THE_WORLD = "vary_the_world"
    EASE_THE_TASK = "ease_the_task"
    OTHER_DESIGNS = "other_designs"


@dataclass(frozen=True, slots=True, kw_only=True)
class FlatWeight:
    """Weight that does not separate the designs.

    Attributes:
        measure: The measure.
        unit: Its unit.
        weight: Its weight.
        low: The least quantity among the designs that it does not separate.
        high: The greatest.
        all_low: The least quantity among all designs; NaN if none is known.
        all_high: The greatest.
        among_feasible: True if only the feasible designs do not differ.
        remedy: Change that would let it separate designs.
        effective: The effective weights, without all flat ones; they sum to 1, or are empty
            if every weight is flat, or a weighted measure has no value in any design.
    """

    measure: str
    unit: str
    weight: float
    low: float
    high: float
    all_low: float
    all_high: float
    among_feasible: bool
    remedy: FlatRemedy
    effective: tuple[tuple[str, float], ...]


def flat_weights(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> tuple[FlatWeight, ...]:
    """The weights that do not separate the designs, in the order of the study.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.
        decision: The decision between them.
    """
    flat = {one.measure for one in decision.flat_measures}
    unvalued = decision.conflicts is not None and decision.conflicts.unvalued
    weights = {
        name: weight
        for name, weight in project.study.trade_off.weighting.weights.items()
        if weight > 0.0 and name not in flat and not unvalued
    }
    total = math.fsum(weights.values())
    effective = tuple((name, weight / total) for name, weight in weights.items())
    return tuple(_weight(project, measured, one, effective) for one in decision.flat_measures)


def _weight(
    project: Project, measured: Sequence[VariantMeasures], one: FlatMeasure, effective: tuple[tuple[str, float], ...]
) -> FlatWeight:
    measure = project.measures.measure(one.measure)
    estimates = (entry.estimates[one.measure].value for entry in measured)
    known = [value for value in estimates if value is not None]
    if one.high - one.low > 1e-9 * max(abs(one.low), abs(one.high)):
        remedy = FlatRemedy.MOVE_ENDS
    elif not measure.from_trials:
        remedy = FlatRemedy.OTHER_DESIGNS
    else:
        remedy = FlatRemedy.EASE_THE_TASK if one.value <= _WORST else FlatRemedy.VARY_THE_WORLD
    return FlatWeight(
        measure=one.measure,
        unit=measure.unit,
        weight=one.weight,
        low=one.low,
        high=one.high,
        all_low=min(known, default=math.nan),
        all_high=max(known, default=math.nan),
        among_feasible=one.among_feasible,
        remedy=remedy,
        effective=effective,
    )
