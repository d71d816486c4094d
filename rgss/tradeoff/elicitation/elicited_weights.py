"""Weights that follow from pairwise answers, as a value."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING

from rgss.documents import digest
from rgss.tradeoff.elicitation.answers import PairwiseAnswer

if TYPE_CHECKING:
    from rgss.tradeoff.elicitation.consistency import Consistency


class FitMethod(str, Enum):
    """Method that turned answers into weights.

    Attributes:
        LEAST_SQUARES: Least squares of the logarithms of the ratios, within the bounds.
        CENTRE: The centroid of all weights that agree with the answers.
    """

    LEAST_SQUARES = "least_squares"
    CENTRE = "centre"


@dataclass(frozen=True, slots=True, kw_only=True)
class ElicitedWeights:
    """Weights of the members of a group from pairwise answers.

    Attributes:
        answers: The answers.
        weights: The weight of each member; all are positive and they sum to 1.
        method: Method that found them.
        factor: By how much the worst ratio is missed, at least 1.
        low: The least weight of each: over the weights that agree with all bounds, and with each ratio within
            `factor`, and over the fits without any one of the ratios.
        high: The greatest such weight.
        consistency: Consistency of the ratios; None if no ratio was stated.
    """

    answers: tuple[PairwiseAnswer, ...]
    weights: Mapping[str, float] = field(hash=False)
    method: FitMethod
    factor: float
    low: Mapping[str, float] = field(hash=False)
    high: Mapping[str, float] = field(hash=False)
    consistency: Consistency | None

    @property
    def digest(self) -> str:
        """SHA-256 of the answers, which identifies them in a decision."""
        # As floats, so that 2 and 2.0 are one answer; JSON has no number for a bound that is not there.
        ends = ((one, float(one.most) if math.isfinite(one.most) else None) for one in self.answers)
        return digest([[one.swing_of, one.over, float(one.least), most] for one, most in ends])

    @property
    def bounds(self) -> tuple[PairwiseAnswer, ...]:
        """The answers that are bounds: orders and ranges."""
        return tuple(answer for answer in self.answers if not answer.is_ratio)
