"""Effects of the factors of a study on its measures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rgss.tradeoff.robustness import (
    FactorialAnalysis,
    SampledIndex,
)

_LEAST_SHARE = 0.01


@dataclass(frozen=True, slots=True, kw_only=True)
class FactorLevels:
    """Factor of the design space with its parameters and levels.

    Attributes:
        id: Its id.
        parameters: The design parameters that it sets together; their effects cannot be separated.
        levels: The ids of its levels.
    """

    id: str
    parameters: tuple[str, ...]
    levels: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MeasureEffects:
    """The effects of all factors on one measure.

    Attributes:
        measure: The measure.
        unit: Its unit.
        factors: The factors with the levels that were analysed.
        left_out: The levels that were omitted because a design with them has no estimate, as
            ``factor=level``; without them the design is balanced.
        designs: Number of analysed designs.
        analysis: The effects; None if no balanced block of designs has estimates, and if the
            designs are a sample.
        sampled: For a sample of designs, the share of each factor alone with its interval, by
            factor, without those that the measure's definition does not contain; empty otherwise, and if too few
            designs have estimates.
        not_computed: Reason why the effects were not computed, as part of a sentence; empty if they were.
    """

    measure: str
    unit: str
    factors: tuple[FactorLevels, ...]
    left_out: tuple[str, ...]
    designs: int
    analysis: FactorialAnalysis | None
    sampled: Mapping[str, SampledIndex] = field(default_factory=dict)
    not_computed: str = ""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StudyEffects:
    """The effects on every measure.

    Attributes:
        factors: The factors that vary.
        constants: The design parameters that do not vary, whose effects cannot be observed.
        measures: The effects on each measure, in the order of the file.
    """

    factors: tuple[FactorLevels, ...]
    constants: tuple[str, ...]
    measures: tuple[MeasureEffects, ...]


def leading_factors(effects: MeasureEffects) -> Mapping[str, float]:
    """The factors by their total-order share of a measure's variance, the largest first.

    For a sample of designs it is the share that each explains alone, of those that exceed what chance gives.
    """
    shares = sorted(_shares(effects).items(), key=lambda item: -item[1])
    return {factor: share for factor, share in shares if share >= _LEAST_SHARE}


def _shares(effects: MeasureEffects) -> Mapping[str, float]:
    if effects.analysis is not None:
        return effects.analysis.total_order
    return {factor: index.share for factor, index in effects.sampled.items() if index.share > index.by_chance}
