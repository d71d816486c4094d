"""Separation of two designs by the evidence, the condition for a change of the choice.

Replicates are added where the choice is open, so that two designs seldom have the same seeds. They are compared on
common seeds, by the same posterior that determines ties in the study; but a seed in which only one of them
succeeded does not prove that it is better. The probability of meeting every requirement uses all seeds of each:
four successes in four seeds do not outweigh ninety in a hundred.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rgss.assessment import VariantMeasures, common_seeds
from rgss.decision.choosing import proportion_measures, trade_problem
from rgss.decision.level_structure import level_numbers
from rgss.studies import Project
from rgss.tradeoff import TradeProblem
from rgss.tradeoff.problem import EvidenceTable, tabulated
from rgss.tradeoff.programs import AdditiveValue, enumerate_alternatives, single_values
from rgss.tradeoff.robustness import PosteriorOutcomes, choice_uncertainty

FEWEST_REPLICATES = 2
"""Least number of common seeds that determine the noise; with fewer, only the estimates are compared."""

FEASIBILITY_DOUBT = 0.2
"""Probability of "former choice feasible, new one not" from which the two are not separated."""


def is_separated(project: Project, measured: Sequence[VariantMeasures], chosen: int, former: int) -> bool:
    """True if a choice is better than a former one by their common seeds.

    It is false if the former one meets every requirement and is within the practical margin by the estimates; if
    both are feasible and the former one has at least the same value with a probability of at least 5 %
    (`rgss.tradeoff.robustness.choice_uncertainty`); or if the former one is feasible and the choice is not with a
    probability of at least 20 %, by all seeds of each.

    Args:
        project: The project, under the suppositions that lead to the choice.
        measured: Every variant with its estimates and records under them.
        chosen: The choice.
        former: Choice without them.

    Returns:
        True too if the former one is not among the variants, or if the program is not the weighted value, the only one
        with a probability of a tie.

    Raises:
        TradeoffError: As for `trade_problem`.
        DefinitionError: As for `trade_problem`.
    """
    pair = [entry for entry in measured if entry.variant.id in (chosen, former)]
    if len(pair) != len({chosen, former}) or chosen == former:
        return chosen != former
    whole = replace(project.study.trade_off, choose_levels=False)
    project = replace(project, study=replace(project.study, trade_off=whole))
    pair = list(common_seeds(project, pair))
    problem = trade_problem(project, pair)
    if not isinstance(problem.program, AdditiveValue):
        return True
    # The posterior of two variants is drawn in a fraction of the time of that of all.
    return _is_ahead(project, pair, problem, chosen, former) and not _may_miss_alone(project, measured, chosen, former)


def _is_ahead(
    project: Project, pair: Sequence[VariantMeasures], problem: TradeProblem, chosen: int, former: int
) -> bool:
    """True if the choice is better than the former one by their common seeds."""
    table = tabulated(problem.alternatives)
    margin = project.study.trade_off.practical_margin
    replicates = np.array([len(entry.records) for entry in pair])
    if replicates.min() < FEWEST_REPLICATES:
        return not _is_near(problem, table, chosen, former, margin)
    rivals = choice_uncertainty(
        _posterior(project, problem, table),
        table.row_of(chosen),
        margin=margin,
        replicates=replicates,
        estimated=enumerate_alternatives(problem).feasible,
        single=single_values(problem, table),
    ).rivals
    # A lead only in draws in which the choice is infeasible does not count: by value the former one is behind.
    return all(rival.by_feasibility for rival in rivals)


def _may_miss_alone(project: Project, measured: Sequence[VariantMeasures], chosen: int, former: int) -> bool:
    """True if the choice may be infeasible while the former one is not, by all seeds of all variants."""
    if min(len(entry.records) for entry in measured) < FEWEST_REPLICATES:
        return False
    problem = trade_problem(project, measured)
    table = tabulated(problem.alternatives)
    feasible = _posterior(project, problem, table).outcomes.feasible
    alone = feasible[:, table.row_of(former)] & ~feasible[:, table.row_of(chosen)]
    return bool(alone.mean() >= FEASIBILITY_DOUBT)


def _posterior(project: Project, problem: TradeProblem, table: EvidenceTable) -> PosteriorOutcomes:
    """Posterior draws of the outcomes, by the study's seed."""
    return PosteriorOutcomes.of(
        problem,
        table,
        proportion_measures(project),
        generator=np.random.default_rng(project.study.seed),
        levels=level_numbers(project.designs, table.variants.tolist()),
        apart=True,
    )


def _is_near(problem: TradeProblem, table: EvidenceTable, chosen: int, former: int, margin: float) -> bool:
    enumeration = enumerate_alternatives(problem)
    worth = enumeration.values[table.row_of(chosen)] - enumeration.values[table.row_of(former)]
    return bool(enumeration.feasible[table.row_of(former)]) and abs(float(worth)) <= margin
