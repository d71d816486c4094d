"""Results of the robustness analyses of a decision, with the reasons for missing parts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.decision.robustness.assumptions import AssumptionFinding
from rgss.decision.robustness.cost_box import CostBox
from rgss.decision.robustness.effect_findings import StudyEffects
from rgss.decision.robustness.parts import NotComputed, Part
from rgss.tradeoff import Condition
from rgss.tradeoff.robustness import (
    Acceptability,
    ChoiceUncertainty,
    ParetoFront,
    PriceStep,
    RankReversal,
    WeightRange,
    WeightShift,
)
from rgss.tradeoff.weights import WeightRegion


@dataclass(frozen=True, slots=True, kw_only=True)
class RequirementPrice:
    """Price of a requirement.

    Attributes:
        condition: The requirement as a condition.
        steps: Choice and feasible set as functions of its limit, from loose to tight; rows
            are those of the analysis.
        anchored: Measures whose value functions are anchored on the requirement; they are as at its present limit in
            every step.
    """

    condition: Condition
    steps: tuple[PriceStep, ...]
    anchored: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WeightRobustness:
    """Effect of other weights on a choice by weighted value.

    Attributes:
        elicited: True if the weights are bounded by elicitation; all weights otherwise.
        regions: The weights at which each alternative wins.
        shifts: The nearest weights at which each wins, the nearest first.
        ranges: Range of each weight alone.
        acceptability: The indices of SMAA-2 over weights and noise; over weights alone without noise.
        first_errors: The standard error of each alternative's first-rank acceptability over
            repetitions of the study, shape (n,); that of the draws of weights without noise.
        uncertainty: The uncertainty of the choice at the study's weights; None without noise.
        with_noise: True if they are over noise too.

    A part that could not be computed is None, with its reason in `Robustness.not_computed`.
    """

    elicited: bool
    regions: tuple[WeightRegion, ...] | None
    shifts: tuple[WeightShift, ...] | None
    ranges: tuple[WeightRange, ...] | None
    acceptability: Acceptability | None
    first_errors: NDArray[np.float64] | None
    uncertainty: ChoiceUncertainty | None
    with_noise: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Robustness:
    """Robustness of a decision.

    Attributes:
        variants: The ids of the rows of everything below, ascending.
        measures: The measures with a weight above 0: the columns of weights.
        weights: Their weights.
        values: Values of each alternative in them, shape (n, m); NaN where unknown.
        feasible: Mask of the alternatives that are feasible by their estimates.
        more_is_better: Whether more of each of these measures is worth more; None of one with a target.
        front: The Pareto front of the feasible ones.
        weighting: Effects of other weights; None if `refused` has the reason.
        assumptions: Range of each assumed number that keeps the choice; empty if `refused` has the reason.
        costs: Range of all assumed costs together that keeps the choice; None if `refused` has the reason.
        prices: Price of each requirement.
        reversals: Removals of an alternative that change the order of the others, under the
            study's program; none for values that are anchored on requirements.
        stretched: The same for values stretched between the extremes of the sample.
        effects: Effects of each factor on each measure.
        draws: Number of posterior draws of the noise; 0 without noise.
        resamples: Number of resamples of the replicates for the effects; 0 without noise.
        all_resamples: True if the resamples are enumerated completely.
        refused: Reason why an analysis does not apply, by its name.
        not_computed: Reason for each part that could not be computed; its value here is empty.
    """

    variants: tuple[int, ...]
    measures: tuple[str, ...]
    weights: NDArray[np.float64]
    values: NDArray[np.float64]
    feasible: NDArray[np.bool_]
    more_is_better: tuple[bool | None, ...]
    front: ParetoFront
    weighting: WeightRobustness | None
    assumptions: tuple[AssumptionFinding, ...]
    costs: CostBox | None
    prices: tuple[RequirementPrice, ...]
    reversals: tuple[RankReversal, ...]
    stretched: tuple[RankReversal, ...]
    effects: StudyEffects
    draws: int
    resamples: int
    all_resamples: bool
    refused: Mapping[str, str]
    not_computed: Mapping[Part, NotComputed]
