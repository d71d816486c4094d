"""Success criterion of a requirement: a bound on one measure."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from enum import Enum

from rgss.documents import DocumentModel, Identifier
from rgss.figures import exact_figure
from rgss.quantities import conversion_factor
from rgss.requirements.comparison import Comparison
from rgss.requirements.fields import ThresholdText, split_quantity


class Statistic(str, Enum):
    """Compared statistic of an estimate: its value, or an end of its interval."""

    VALUE = "value"
    LOW = "low"
    HIGH = "high"


@dataclass(frozen=True, slots=True, kw_only=True)
class Criterion:
    """Bound on a measure for the requirement to be met.

    Attributes:
        measure: Id of the measure, such as ``P_max``.
        statistic: Compared statistic of the measure's estimate.
        comparison: Required relation of the statistic to the threshold.
        threshold: The bound, in ``unit``.
        unit: The unit of the bound in the file; ``"1"`` for a pure number.
    """

    measure: str
    statistic: Statistic
    comparison: Comparison
    threshold: float
    unit: str

    def threshold_in(self, unit: str) -> float:
        """Threshold in another unit, usually that of the measure.

        Raises:
            QuantityError: The dimensions of the units differ.
        """
        # Decimal, so that 35 mm is the float nearest to 0.035 m.
        return float(Decimal(repr(self.threshold)) * Decimal(repr(conversion_factor(self.unit, unit))))

    def __str__(self) -> str:
        unit = "" if self.unit == "1" else f" {self.unit}"
        plain = self.statistic is Statistic.VALUE
        number = self.measure if plain else f"{self.statistic.value}({self.measure})"
        return f"{number} {self.comparison.value} {exact_figure(self.threshold)}{unit}"


class CriterionFile(DocumentModel):
    """The success criterion of a system requirement."""

    measure: Identifier
    statistic: Statistic = Statistic.VALUE
    comparison: Comparison
    threshold: ThresholdText

    def criterion(self) -> Criterion:
        """Criterion with its threshold split into number and unit."""
        threshold, unit = split_quantity(self.threshold)
        return Criterion(
            measure=self.measure, statistic=self.statistic, comparison=self.comparison, threshold=threshold, unit=unit
        )
