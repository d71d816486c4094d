"""Model gaps: differences between the values of an equation and of the simulation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rgss.measures.definitions import MeasureSet
from rgss.measures.estimates import Estimate

NOTABLE = 0.10
"""Relative difference above which an equation cannot replace the simulation."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelGap:
    """Difference between an equation and the simulation for one variant.

    Attributes:
        measure: Id of the measure defined by the equation.
        simulated_as: Id of the simulated measure.
        unit: Unit of both values: that of the measure.
        by_equation: Value of the equation.
        simulated: Value of the simulation.
    """

    measure: str
    simulated_as: str
    unit: str
    by_equation: float
    simulated: float

    @property
    def relative(self) -> float:
        """Simulation's value divided by the equation's, minus 1; infinite if only the equation gives 0."""
        if self.by_equation == 0.0:
            return 0.0 if self.simulated == 0.0 else float("inf")
        return self.simulated / self.by_equation - 1.0

    @property
    def is_notable(self) -> bool:
        """True if they differ by more than a tenth of the equation's value."""
        return abs(self.relative) > NOTABLE


def model_gaps(measures: MeasureSet, estimates: Mapping[str, Estimate]) -> tuple[ModelGap, ...]:
    """Differences of a variant, in the order of the measures, without those with an unknown value."""
    found = []
    for measure in measures.measures:
        if measure.simulated_as is None:
            continue
        twin = measures.measure(measure.simulated_as)
        by_equation, simulated = estimates[measure.id].value, estimates[twin.id].value
        if by_equation is not None and simulated is not None:
            found.append(
                ModelGap(
                    measure=measure.id,
                    simulated_as=twin.id,
                    unit=measure.unit,
                    by_equation=by_equation,
                    simulated=simulated * twin.si_per_unit / measure.si_per_unit,
                )
            )
    return tuple(found)
