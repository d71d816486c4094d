"""Side-by-side comparison of chosen variant and runner-up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.assessment import VariantMeasures
from rgss.studies import Project
from rgss.tradeoff import Decision


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterRow:
    """A design parameter that differs between the study's variants.

    Attributes:
        name: Its name, in words.
        unit: Its unit.
        cells: Its value in each compared variant.
    """

    name: str
    unit: str
    cells: tuple[float | str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class WeightedRow:
    """A weighted measure.

    Attributes:
        measure: Its id.
        unit: Its unit.
        weight: Its weight.
        cells: Its estimate for each compared variant; None if unknown.
    """

    measure: str
    unit: str
    weight: float
    cells: tuple[float | None, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ObjectiveRow:
    """An objective of a program that does not decide by weighted value alone.

    Attributes:
        place: Its place in the order of the program, from 1.
        name: The objective.
        cells: Its value for each compared variant.
    """

    place: int
    name: str
    cells: tuple[float, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class SideBySide:
    """The chosen variant and, if there is one, the runner-up.

    Attributes:
        variants: Their ids, the chosen one first.
        parameters: The parameters that vary.
        measures: The weighted measures.
        values: The weighted values; None if a weighted measure is unknown.
        objectives: The objectives of the program; empty for the additive one.
    """

    variants: tuple[int, ...]
    parameters: tuple[ParameterRow, ...]
    measures: tuple[WeightedRow, ...]
    values: tuple[float | None, ...]
    objectives: tuple[ObjectiveRow, ...]


def side_by_side(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> SideBySide | None:
    """Comparison of the chosen variant with the runner-up; None if nothing is chosen.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.
        decision: The decision between them.
    """
    if decision.chosen is None:
        return None
    shown = tuple(variant for variant in (decision.chosen, decision.runner_up) if variant is not None)
    by_id = {entry.variant.id: entry for entry in measured}
    ranked = {one.variant: one for one in decision.ranking}
    return SideBySide(
        variants=shown,
        parameters=tuple(
            ParameterRow(
                name=definition.name.replace("_", " "),
                unit=definition.unit,
                cells=tuple(by_id[variant].variant.parameters[definition.id] for variant in shown),
            )
            for definition in project.designs.parameters
            if len({str(entry.variant.parameters[definition.id]) for entry in measured}) > 1
        ),
        measures=tuple(
            WeightedRow(
                measure=measure,
                unit=by_id[shown[0]].estimates[measure].unit,
                weight=weight,
                cells=tuple(by_id[variant].estimates[measure].value for variant in shown),
            )
            for measure, weight in project.study.trade_off.weighting.weights.items()
        ),
        values=tuple(ranked[variant].value for variant in shown),
        objectives=()
        if decision.program == "additive"
        else tuple(
            ObjectiveRow(
                place=place, name=name, cells=tuple(ranked[variant].objectives[place - 1] for variant in shown)
            )
            for place, name in enumerate(decision.objectives, start=1)
            if name != "value"
        ),
    )
