"""Requirements that are verified by an equation although a simulation of the same measure is defined."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.assessment import VariantMeasures, requirements_with_criteria
from rgss.measures import MeasureSet, meets, model_gaps
from rgss.requirements import Criterion, Statistic
from rgss.studies import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class EquationVerification:
    """A requirement that an equation verifies, compared with the simulation of its measure.

    Attributes:
        requirement: Its id.
        measure: The measure, by an equation.
        simulated_as: The simulated measure.
        is_of_design: Whether the equation follows from the design alone, so that it has a value without trials.
        compared: Number of designs of which both are known.
        otherwise: Those that keep the threshold by one of them only.
        greatest: The greatest difference, as a share of the equation's value.
    """

    requirement: str
    measure: str
    simulated_as: str
    is_of_design: bool
    compared: int
    otherwise: tuple[int, ...]
    greatest: float


def equation_verifications(project: Project, measured: Sequence[VariantMeasures]) -> tuple[EquationVerification, ...]:
    """The requirements on a value whose measure is an equation with a simulation."""
    found = []
    for requirement in requirements_with_criteria(project):
        criterion = requirement.criterion
        if criterion is None or criterion.statistic is not Statistic.VALUE:
            continue
        measure = project.measures.measure(criterion.measure)
        if measure.simulated_as is not None:
            found.append(_compared(requirement.id, criterion, project.measures, measured))
    return tuple(found)


def _compared(
    requirement: str, criterion: Criterion, measures: MeasureSet, measured: Sequence[VariantMeasures]
) -> EquationVerification:
    gaps = {
        entry.variant.id: gap
        for entry in measured
        for gap in model_gaps(measures, entry.estimates)
        if gap.measure == criterion.measure
    }
    measure = measures.measure(criterion.measure)
    return EquationVerification(
        requirement=requirement,
        measure=measure.id,
        simulated_as=measure.simulated_as or "",
        is_of_design=not measure.from_trials,
        compared=len(gaps),
        otherwise=tuple(
            variant
            for variant, gap in gaps.items()
            if meets(criterion, gap.by_equation, gap.unit) is not meets(criterion, gap.simulated, gap.unit)
        ),
        greatest=max((abs(gap.relative) for gap in gaps.values()), default=0.0),
    )
