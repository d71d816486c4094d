"""Robustness of a decision against weights, noise, assumptions, thresholds, and other variants."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rgss.assessment import VariantMeasures, common_seeds
from rgss.decision.choosing import proportion_measures, trade_problem
from rgss.decision.level_structure import level_numbers
from rgss.decision.preference_model import anchored_measures
from rgss.decision.robustness.assumptions import AssumptionFinding, assumption_findings
from rgss.decision.robustness.cost_box import CostBox, cost_box
from rgss.decision.robustness.effect_findings import StudyEffects
from rgss.decision.robustness.effects import study_effects
from rgss.decision.robustness.findings import RequirementPrice, Robustness, WeightRobustness
from rgss.decision.robustness.parts import Part, PartComputer
from rgss.decision.robustness.pricing import requirement_prices
from rgss.decision.robustness.remeasuring import Remeasuring
from rgss.errors import TradeoffError
from rgss.studies import Project
from rgss.tradeoff import AdditiveValue, Decision, TradeProblem
from rgss.tradeoff.problem import FEWEST_REPLICATES, EvidenceTable, Resamples, bootstrap
from rgss.tradeoff.programs import (
    enumerate_alternatives,
    orderings_of,
    single_values,
    weighted_values,
)
from rgss.tradeoff.robustness import (
    ChoiceUncertainty,
    Outcomes,
    ParetoFront,
    PosteriorOutcomes,
    RankReversal,
    admitted_weights,
    choice_uncertainty,
    common_replicates,
    pareto_front,
    rank_reversals,
    replication_gains,
    sample_anchored,
    smaa2,
    weight_ranges,
    weight_shifts,
)
from rgss.tradeoff.weights import winning_regions

ITERATIONS = 20_000
"""Number of draws of weights and noise for the acceptability; its standard errors are below 0.0036."""

DRAWN_RESAMPLES = 1_000
"""Number of resamples of the replicates if not all can be enumerated."""

_NO_EFFECTS = StudyEffects(factors=(), constants=(), measures=())


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Posed:
    """A trade-off by weighted value with its values by the estimates.

    Attributes:
        problem: The trade-off.
        values: Single values, shape (n, m).
        feasible: Mask of the alternatives that are feasible by their estimates, shape (n,).
        weights: The weights, shape (m,).
        margin: The practical margin.
        replicates: Replicates of each alternative, shape (n,).
    """

    problem: TradeProblem
    values: NDArray[np.float64]
    feasible: NDArray[np.bool_]
    weights: NDArray[np.float64]
    margin: float
    replicates: NDArray[np.int64]

    def uncertainty(self, found: PosteriorOutcomes, chosen: int, generator: np.random.Generator) -> ChoiceUncertainty:
        """The uncertainty of a choice."""
        return choice_uncertainty(
            found,
            chosen,
            margin=self.margin,
            replicates=self.replicates,
            estimated=self.feasible,
            single=self.values,
            proportions=found.proportions,
            gains=replication_gains(found, chosen, generator=generator),
        )


_Assumed = tuple[tuple[AssumptionFinding, ...], CostBox | None]


def analyse_robustness(
    project: Project,
    measured: Sequence[VariantMeasures],
    decision: Decision,
    *,
    problem: TradeProblem | None = None,
) -> Robustness:
    """Analyse the robustness of a decision; nothing is simulated, and randomness comes from the study's seed alone.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates and records, by ascending id.
        decision: The decision.
        problem: Result of `trade_problem` for them, if it was computed already.

    Raises:
        EvidenceError: Trials of the study have no evidence.
        TradeoffError: The choice is ill posed.
        DefinitionError: As for `trade_problem`.
    """
    problem = trade_problem(project, measured) if problem is None else problem
    enumeration = enumerate_alternatives(problem)
    table, feasible = enumeration.table, enumeration.feasible
    refused: dict[str, str] = {}
    parts = PartComputer()
    resamples = _resamples(table, np.random.default_rng(project.study.seed), refused)
    generator = np.random.default_rng(project.study.seed)  # the posterior is drawn first, as by a sweep until decided
    values = single_values(problem, table)
    weights = np.array([problem.weighting.weights[measure] for measure in problem.weighting.deciding_measures])
    chosen = None if decision.chosen is None else table.row_of(decision.chosen)
    weighting: WeightRobustness | None = None
    assumed: _Assumed = (), None
    reason = _no_weights(problem, chosen)
    draws = 0
    if chosen is not None and not reason:
        posterior = _posterior(project, problem, table, generator)
        posed = _Posed(
            problem=problem,
            values=values,
            feasible=feasible,
            weights=weights,
            margin=project.study.trade_off.practical_margin,
            replicates=np.array([len(entry.records) for entry in measured]),
        )
        weighting = _weighting(posed, chosen, posterior, generator, parts)
        draws = 0 if posterior is None else posterior.outcomes.shape[0]
        # The draws are the largest arrays of the analysis, and are not used below.
        del posterior
        assumed = _assumed(Remeasuring.of(project, measured, table), problem, chosen, parts, refused)
    else:
        refused.update(dict.fromkeys(("weights", "assumptions", "costs"), reason))
    return Robustness(
        variants=tuple(int(variant) for variant in table.variants),
        measures=problem.weighting.deciding_measures,
        weights=weights,
        values=values,
        feasible=feasible,
        more_is_better=tuple(function.more_is_better for function in problem.deciding_functions),
        front=parts.compute(Part.PARETO, lambda: pareto_front(values, feasible), ParetoFront(points=())),
        weighting=weighting,
        assumptions=assumed[0],
        costs=assumed[1],
        prices=parts.compute(Part.PRICES, lambda: _prices(project, problem, table), ()),
        reversals=parts.compute(Part.REVERSALS, lambda: _reversals(problem, table, feasible), ()),
        stretched=parts.compute(Part.STRETCHED, lambda: _stretched(problem, table, feasible, weights), ()),
        effects=parts.compute(Part.EFFECTS, lambda: _effects(project, measured, resamples), _NO_EFFECTS),
        draws=draws,
        resamples=0 if resamples is None else len(resamples.probabilities),
        all_resamples=resamples is not None and resamples.exact,
        refused=refused,
        not_computed=parts.missing,
    )


def _prices(project: Project, problem: TradeProblem, table: EvidenceTable) -> tuple[RequirementPrice, ...]:
    return requirement_prices(problem, table, anchored_measures(project))


def _effects(project: Project, measured: Sequence[VariantMeasures], resamples: Resamples | None) -> StudyEffects:
    # Levels are compared on common seeds, since replicates may have been added to some variants only.
    return study_effects(project, common_seeds(project, measured), resamples)


def _assumed(
    remeasuring: Remeasuring, problem: TradeProblem, chosen: int, parts: PartComputer, refused: dict[str, str]
) -> _Assumed:
    """The range of each assumed number, and of all costs together."""
    none: tuple[AssumptionFinding, ...] = ()
    assumptions = parts.compute(Part.ASSUMPTIONS, lambda: assumption_findings(remeasuring, problem, chosen), none)
    box = parts.compute(Part.COSTS, lambda: cost_box(remeasuring, problem, chosen), None)
    if isinstance(box, str):
        refused["costs"] = box
        return assumptions, None
    return assumptions, box


def _no_weights(problem: TradeProblem, chosen: int | None) -> str:
    """Reason why weights, assumptions and costs are not analysed; empty if they are."""
    if chosen is None:
        return "no variant meets every requirement by its estimates"
    if not isinstance(problem.program, AdditiveValue):
        return f"the {problem.program.name} program does not choose by weighted value"
    return ""


def _resamples(table: EvidenceTable, generator: np.random.Generator, refused: dict[str, str]) -> Resamples | None:
    try:
        number = common_replicates(table)
        return bootstrap(number, draws=DRAWN_RESAMPLES, generator=generator) if number else None
    except TradeoffError as error:
        refused["noise"] = str(error)
        return None


def _posterior(
    project: Project, problem: TradeProblem, table: EvidenceTable, generator: np.random.Generator
) -> PosteriorOutcomes | None:
    """Posterior draws of the evidence; None if no variant has two observations."""
    if max((int(samples.ran.sum(axis=1).max()) for samples in table.samples.values()), default=0) < FEWEST_REPLICATES:
        return None
    levels = level_numbers(project.designs, table.variants.tolist())
    return PosteriorOutcomes.of(problem, table, proportion_measures(project), generator=generator, levels=levels)


def _weighting(
    posed: _Posed,
    chosen: int,
    posterior: PosteriorOutcomes | None,
    generator: np.random.Generator,
    parts: PartComputer,
) -> WeightRobustness:
    problem, values, feasible, weights = posed.problem, posed.values, posed.feasible, posed.weights
    admitted = admitted_weights(problem)
    outcomes = Outcomes.certain(values, feasible) if posterior is None else posterior.outcomes
    regions = parts.compute(
        Part.REGIONS, lambda: winning_regions(values, feasible, admitted, generator=generator), None
    )
    acceptability = parts.compute(
        Part.ACCEPTABILITY, lambda: smaa2(outcomes, admitted, iterations=ITERATIONS, generator=generator), None
    )
    errors = None if acceptability is None else acceptability.rank_errors[:, 0]
    uncertainty = None
    if posterior is not None:
        if errors is not None:
            drawn: NDArray[np.float64] = errors
            errors = np.hypot(drawn, posterior.first_errors(admitted, generator))
        uncertainty = parts.compute(Part.UNCERTAINTY, lambda: posed.uncertainty(posterior, chosen, generator), None)
    return WeightRobustness(
        elicited=not admitted.is_simplex,
        regions=regions,
        shifts=parts.compute(Part.NEAREST, lambda: weight_shifts(values, feasible, weights, among=admitted), None),
        ranges=parts.compute(Part.RANGES, lambda: weight_ranges(values, feasible, weights, chosen), None),
        acceptability=acceptability,
        first_errors=errors,
        uncertainty=uncertainty,
        with_noise=posterior is not None,
    )


def _reversals(problem: TradeProblem, table: EvidenceTable, feasible: NDArray[np.bool_]) -> tuple[RankReversal, ...]:
    """Rank reversals under the study's own program, which ranks by repeated choice among the rest."""
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
    """Rank reversals for values anchored on the sample; measures with a target are unchanged."""
    rows = np.flatnonzero(feasible)
    if not len(rows):
        return ()
    functions = [problem.value_function(measure) for measure in problem.weighting.deciding_measures]
    quantities = np.stack([table.column(function.measure)[rows] for function in functions], axis=1)
    directions = np.array([function.more_is_better is not False for function in functions])
    return _of_rows(rank_reversals(len(rows), sample_anchored(quantities, directions, weights)), rows)


def _of_rows(reversals: Sequence[RankReversal], rows: NDArray[np.intp]) -> tuple[RankReversal, ...]:
    """Reversals among some rows, by the rows of the table."""
    return tuple(
        replace(
            one,
            removed=int(rows[one.removed]),
            best_before=int(rows[one.best_before]),
            best_after=int(rows[one.best_after]),
        )
        for one in reversals
    )
