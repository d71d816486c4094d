"""How robust a decision is: against weights, noise, assumptions, thresholds, and other variants."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rgss.assessment import VariantMeasures
from rgss.decision.choosing import trade_problem
from rgss.decision.robustness.assumptions import AssumptionFinding, CostBox, assumption_findings, cost_box
from rgss.decision.robustness.effects import StudyEffects, study_effects
from rgss.decision.robustness.parts import NotComputed, Part, PartComputer
from rgss.decision.robustness.remeasuring import Remeasuring
from rgss.errors import TradeoffError
from rgss.studies import Project
from rgss.tradeoff import AdditiveValue, Condition, Decision, TradeProblem
from rgss.tradeoff.problem import Comparison, EvidenceTable, Resamples, bootstrap
from rgss.tradeoff.programs import (
    condition_column,
    enumerate_alternatives,
    orderings_of,
    single_values,
    weighted_values,
)
from rgss.tradeoff.robustness import (
    Acceptability,
    Outcomes,
    OutcomeSource,
    ParetoFront,
    PriceStep,
    RankReversal,
    ResampledOutcomes,
    WeightRange,
    WeightShift,
    admitted_weights,
    condition_masks,
    pareto_front,
    price_list,
    rank_reversals,
    replicate_number,
    sample_anchored,
    smaa2,
    weight_ranges,
    weight_shifts,
)
from rgss.tradeoff.weights import WeightRegion, winning_regions

ITERATIONS = 20_000
"""Draws of weights and noise for the acceptability; its standard errors are below 0.0036."""

DRAWN_RESAMPLES = 1_000
"""Resamples of the replicates where not all can be taken."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RequirementPrice:
    """What a requirement costs.

    Attributes:
        condition: What is demanded.
        steps: How the choice and the feasible set change with its limit, from loose to tight; rows
            are those of the analysis.
    """

    condition: Condition
    steps: tuple[PriceStep, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WeightRobustness:
    """What other weights would do to a choice by weighted value.

    Attributes:
        elicited: Whether the weights are bounded by what was elicited; all weights otherwise.
        regions: The weights at which each alternative wins.
        shifts: The nearest weights at which each wins, the nearest first.
        ranges: How far each weight may move alone.
        acceptability: The indices of SMAA-2 over weights and noise; over weights alone where
            there is no noise to draw from.
        with_noise: Whether they are over noise too.

    A part that could not be computed is None, and `Robustness.not_computed` says why.
    """

    elicited: bool
    regions: tuple[WeightRegion, ...] | None
    shifts: tuple[WeightShift, ...] | None
    ranges: tuple[WeightRange, ...] | None
    acceptability: Acceptability | None
    with_noise: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Robustness:
    """How robust a decision is.

    Attributes:
        variants: The ids of the rows of everything below, ascending.
        measures: The measures with a weight above 0: the columns of weights.
        weights: Their weights.
        values: What each alternative is worth in them, shape (n, m); NaN where unknown.
        feasible: Which alternatives meet every demand.
        front: The Pareto front of the feasible ones.
        weighting: What other weights would do; None where `refused` says why.
        assumptions: How far each assumed number may be wrong; empty where `refused` says why.
        costs: How far all assumed costs together may be wrong; None where `refused` says why.
        prices: What each demand costs.
        reversals: Removals of an alternative that change the order of the others, under the
            study's program; none for values that are anchored on requirements.
        stretched: The same had the values been stretched between the extremes of the sample.
        effects: What each factor does to each measure.
        resamples: How many resamples of the replicates stand for the noise; 0 without noise.
        all_resamples: Whether these are all there are.
        refused: Why an analysis does not apply, by its name.
        not_computed: Why a part could not be computed; what stands for it here is empty.
    """

    variants: tuple[int, ...]
    measures: tuple[str, ...]
    weights: NDArray[np.float64]
    values: NDArray[np.float64]
    feasible: NDArray[np.bool_]
    front: ParetoFront
    weighting: WeightRobustness | None
    assumptions: tuple[AssumptionFinding, ...]
    costs: CostBox | None
    prices: tuple[RequirementPrice, ...]
    reversals: tuple[RankReversal, ...]
    stretched: tuple[RankReversal, ...]
    effects: StudyEffects
    resamples: int
    all_resamples: bool
    refused: Mapping[str, str]
    not_computed: Mapping[Part, NotComputed]


def analyse_robustness(
    project: Project,
    measured: Sequence[VariantMeasures],
    decision: Decision,
    *,
    problem: TradeProblem | None = None,
) -> Robustness:
    """Question a decision from every side.

    Nothing is simulated; randomness comes from the study's seed alone, so that the same evidence
    gives the same answers.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates and records, by ascending id.
        decision: What was decided.
        problem: What `trade_problem` gives for them, where it is there already.

    Raises:
        EvidenceError: Trials of the study have no evidence.
        TradeoffError: The choice is ill posed.
        DefinitionError: As for `trade_problem`.
    """
    problem = trade_problem(project, measured) if problem is None else problem
    enumeration = enumerate_alternatives(problem)
    table, feasible = enumeration.table, enumeration.feasible
    refused: dict[str, str] = {}
    generator = np.random.default_rng(project.study.seed)
    resamples = _resamples(table, generator, refused)
    values = single_values(problem, table)
    deciding = problem.weighting.deciding_measures
    weights = np.array([problem.weighting.weights[measure] for measure in deciding])
    chosen = None if decision.chosen is None else table.row_of(decision.chosen)

    parts = PartComputer()
    weighting: WeightRobustness | None = None
    assumptions: tuple[AssumptionFinding, ...] = ()
    costs: CostBox | None = None
    reason = _no_weights(problem, chosen)
    if chosen is not None and not reason:
        weighting = _weighting(problem, table, feasible, values, weights, chosen, resamples, generator, parts)
        remeasuring = Remeasuring.of(project, measured, table)
        assumptions = parts.compute(Part.ASSUMPTIONS, lambda: assumption_findings(remeasuring, problem, chosen), ())
        box = parts.compute(Part.COSTS, lambda: cost_box(remeasuring, problem, chosen), None)
        if isinstance(box, str):
            refused["costs"] = box
        else:
            costs = box
    else:
        refused.update(dict.fromkeys(("weights", "assumptions", "costs"), reason))
    no_effects = StudyEffects(factors=(), constants=(), measures=())
    return Robustness(
        variants=tuple(int(variant) for variant in table.variants),
        measures=deciding,
        weights=weights,
        values=values,
        feasible=feasible,
        front=parts.compute(Part.PARETO, lambda: pareto_front(values, feasible), ParetoFront(points=())),
        weighting=weighting,
        assumptions=assumptions,
        costs=costs,
        prices=parts.compute(Part.PRICES, lambda: _prices(problem, table), ()),
        reversals=parts.compute(Part.REVERSALS, lambda: _reversals(problem, table, feasible), ()),
        stretched=parts.compute(Part.STRETCHED, lambda: _stretched(problem, table, feasible, weights), ()),
        effects=parts.compute(Part.EFFECTS, lambda: study_effects(project, measured, resamples), no_effects),
        resamples=0 if resamples is None else len(resamples.probabilities),
        all_resamples=resamples is not None and resamples.exact,
        refused=refused,
        not_computed=parts.missing,
    )


def _no_weights(problem: TradeProblem, chosen: int | None) -> str:
    """Why weights, assumptions and costs are not analysed; empty where they are."""
    if chosen is None:
        return "no variant meets every requirement"
    if not isinstance(problem.program, AdditiveValue):
        return f"the {problem.program.name} program does not choose by weighted value"
    return ""


def _resamples(table: EvidenceTable, generator: np.random.Generator, refused: dict[str, str]) -> Resamples | None:
    try:
        number = replicate_number(table)
        return bootstrap(number, draws=DRAWN_RESAMPLES, generator=generator) if number else None
    except TradeoffError as error:
        refused["noise"] = str(error)
        return None


def _weighting(
    problem: TradeProblem,
    table: EvidenceTable,
    feasible: NDArray[np.bool_],
    values: NDArray[np.float64],
    weights: NDArray[np.float64],
    chosen: int,
    resamples: Resamples | None,
    generator: np.random.Generator,
    parts: PartComputer,
) -> WeightRobustness:
    admitted = admitted_weights(problem)
    outcomes: OutcomeSource = Outcomes.certain(values, feasible)
    if resamples is not None:
        outcomes = ResampledOutcomes.of(problem, table, resamples)
    return WeightRobustness(
        elicited=not admitted.is_simplex,
        regions=parts.compute(
            Part.REGIONS, lambda: winning_regions(values, feasible, admitted, generator=generator), None
        ),
        shifts=parts.compute(Part.NEAREST, lambda: weight_shifts(values, feasible, weights, among=admitted), None),
        ranges=parts.compute(Part.RANGES, lambda: weight_ranges(values, feasible, weights, chosen), None),
        acceptability=parts.compute(
            Part.ACCEPTABILITY,
            lambda: smaa2(outcomes, admitted, iterations=ITERATIONS, generator=generator),
            None,
        ),
        with_noise=resamples is not None,
    )


def _prices(problem: TradeProblem, table: EvidenceTable) -> tuple[RequirementPrice, ...]:
    totals = weighted_values(problem, table)
    masks = condition_masks(problem, table)
    known = ~np.isnan(totals)

    orderings = orderings_of(problem.program, problem, table)

    def best_of(among: NDArray[np.bool_]) -> NDArray[np.bool_]:
        return orderings(among).best(among)

    found = []
    for place, condition in enumerate(problem.conditions):
        others = np.logical_and.reduce([known, *(mask for other, mask in enumerate(masks) if other != place)])
        found.append(
            RequirementPrice(
                condition=condition,
                steps=price_list(
                    condition_column(condition, table),
                    totals,
                    others,
                    at_least=condition.sense is Comparison.AT_LEAST,
                    best_of=None if isinstance(problem.program, AdditiveValue) else best_of,
                ),
            )
        )
    return tuple(found)


def _reversals(problem: TradeProblem, table: EvidenceTable, feasible: NDArray[np.bool_]) -> tuple[RankReversal, ...]:
    """Removals under the study's own program: its best first, then the best of the rest, and so on."""
    rows = np.flatnonzero(feasible)
    totals = weighted_values(problem, table)[rows] if isinstance(problem.program, AdditiveValue) else None

    orderings = orderings_of(problem.program, problem, table)

    def score(there: NDArray[np.intp]) -> NDArray[np.float64]:
        if totals is not None:
            return totals[there]
        mask = np.zeros(len(table), dtype=np.bool_)
        mask[rows[there]] = True
        ranked = {int(row): -float(place) for place, row in enumerate(orderings(mask).ranked(mask, len(table)))}
        return np.array([ranked[int(rows[place])] for place in there])

    return _of_rows(rank_reversals(len(rows), score), rows)


def _stretched(
    problem: TradeProblem, table: EvidenceTable, feasible: NDArray[np.bool_], weights: NDArray[np.float64]
) -> tuple[RankReversal, ...]:
    """Removals had values been anchored on the sample; measures with a target are left as they are."""
    rows = np.flatnonzero(feasible)
    if not len(rows):
        return ()
    functions = [problem.value_function(measure) for measure in problem.weighting.deciding_measures]
    quantities = np.stack([table.column(function.measure)[rows] for function in functions], axis=1)
    directions = np.array([function.more_is_better is not False for function in functions])
    return _of_rows(rank_reversals(len(rows), sample_anchored(quantities, directions, weights)), rows)


def _of_rows(reversals: Sequence[RankReversal], rows: NDArray[np.intp]) -> tuple[RankReversal, ...]:
    """Reversals among some rows, told by the rows of the table."""
    return tuple(
        replace(
            one,
            removed=int(rows[one.removed]),
            best_before=int(rows[one.best_before]),
            best_after=int(rows[one.best_after]),
        )
        for one in reversals
    )
