"""Sensitivity of a decision: tornado, bent values, exchange rates, kept designs, stakeholders, flat weights."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.assessment import VariantMeasures
from rgss.decision.robustness import NotComputed, Part, PartComputer, Remeasuring, Robustness
from rgss.decision.sensitivity.bends import BentValue, bent_values_of
from rgss.decision.sensitivity.exchange_rates import ExchangeRates, exchange_rates_of
from rgss.decision.sensitivity.flat_weights import FlatWeight, flat_weights
from rgss.decision.sensitivity.ranges import RangeBook
from rgss.decision.sensitivity.standings import Standings, standings_of
from rgss.decision.sensitivity.tornado import Tornado, tornado_of
from rgss.decision.sensitivity.uncertain_inputs import uncertain_inputs, undecided_inputs
from rgss.errors import DocumentError
from rgss.studies import Project
from rgss.tradeoff import AdditiveValue, Decision, TradeProblem
from rgss.tradeoff.problem import tabulated
from rgss.tradeoff.robustness import (
    KeptAlternative,
    StakeholderAgreement,
    admitted_weights,
    stakeholder_agreement,
    worth_keeping,
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sensitivity:
    """Sensitivity of a decision by weighted value.

    Attributes:
        variants: The ids of the rows of everything below, ascending.
        measures: The measures with a weight above 0.
        weights: Their weights, shape (m,).
        tornado: Swing of the advantage over each input; None if `refused` or `not_computed` has the reason.
        bends: The choice under bent value functions.
        exchange: What better quantities are worth to the choice; None without two measures of which one can pay,
            or if it could not be computed.
        kept: The feasible designs, each with the reason to keep it or the designs that beat it; None if it
            could not be computed.
        keep_margin: Distance from the best within which a design is worth keeping.
        bounded_weights: True if elicitation bounds the weights for which designs are kept.
        agreement: The choices of the stakeholders; None if the study names none.
        weighed: The measures with a weight for the study or a stakeholder, in the order of the stakeholders' weights.
        accept_within: Distance from a stakeholder's best value up to which a design is accepted.
        flat: The weights that do not separate the designs.
        refused: Reason why the sensitivity to inputs is not analysed; empty if it is.
        not_computed: Reason for each part that could not be computed.
    """

    variants: tuple[int, ...]
    measures: tuple[str, ...]
    weights: NDArray[np.float64]
    tornado: Tornado | None
    bends: tuple[BentValue, ...]
    exchange: ExchangeRates | None
    kept: tuple[KeptAlternative, ...] | None
    keep_margin: float
    bounded_weights: bool
    agreement: StakeholderAgreement | None
    weighed: tuple[str, ...]
    accept_within: float
    flat: tuple[FlatWeight, ...]
    refused: str
    not_computed: Mapping[Part, NotComputed]


def analyse_sensitivity(
    project: Project,
    measured: Sequence[VariantMeasures],
    decision: Decision,
    found: Robustness,
    *,
    problem: TradeProblem,
    is_supposed: bool = False,
) -> Sensitivity:
    """Analyse the sensitivity of a decision to its inputs; nothing is simulated.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates and records, by ascending id.
        decision: The decision between them.
        found: Its robustness.
        problem: The trade-off.
        is_supposed: Whether suppositions have changed the study.

    Raises:
        DocumentError: A stated range names no input, or is wrong.
    """
    trade_off = project.study.trade_off
    refused = _refused(problem, decision)
    margin = trade_off.sensitivity.keep_within
    parts = PartComputer()
    tornado: Tornado | None = None
    bends: tuple[BentValue, ...] = ()
    exchange: ExchangeRates | None = None
    kept, agreement, bounded = None, None, False
    if not refused:
        table = tabulated(problem.alternatives)
        standings = standings_of(Remeasuring.of(project, measured, table), problem)
        moved = parts.compute(Part.TORNADO, lambda: _tornado(standings, decision, found, is_supposed=is_supposed), None)
        if isinstance(moved, DocumentError):
            raise moved
        tornado = moved
        if moved is not None:
            tied = _not_separated(decision, found)
            exchange = parts.compute(Part.EXCHANGE_RATES, lambda: exchange_rates_of(standings, moved, tied=tied), None)
        bends = () if tornado is None else bent_values_of(project, tornado, problem.value_functions)
        keep = trade_off.practical_margin if margin is None else margin
        kept = parts.compute(Part.KEPT, lambda: _kept(standings, keep), None)
        bounded = bool(problem.weight_bounds.intervals or problem.weight_bounds.orders)
        agreement = parts.compute(Part.STAKEHOLDERS, lambda: _agreement(standings), None)
    return Sensitivity(
        variants=found.variants,
        measures=problem.weighting.deciding_measures,
        weights=found.weights,
        tornado=tornado,
        bends=bends,
        exchange=exchange,
        kept=kept,
        keep_margin=trade_off.practical_margin if margin is None else margin,
        bounded_weights=bounded,
        agreement=agreement,
        weighed=_weighed(problem, [one.weights for one in trade_off.stakeholders]),
        accept_within=trade_off.accept_within,
        flat=flat_weights(project, measured, decision),
        refused=refused,
        not_computed=parts.missing,
    )


def _refused(problem: TradeProblem, decision: Decision) -> str:
    if decision.chosen is None:
        return "no variant meets every requirement by its estimates"
    if not isinstance(problem.program, AdditiveValue):
        return f"the {problem.program.name} program does not choose by weighted value"
    return ""


def _tornado(
    standings: Standings, decision: Decision, found: Robustness, *, is_supposed: bool
) -> Tornado | DocumentError:
    """The tornado; an error in a range that the user stated is returned in its place."""
    trade_off = standings.project.study.trade_off
    book = RangeBook(trade_off.sensitivity, trade_off.range_places, is_supposed=is_supposed)
    inputs = list(uncertain_inputs(standings, found, book))
    try:
        book.check(undecided_inputs(standings, found))
    except DocumentError as error:
        return error
    rows = {variant: row for row, variant in enumerate(found.variants)}
    tied = tuple(rows[variant] for variant in decision.ties)
    return tornado_of(inputs, standings.as_it_is(), tied[0], tied, found.variants)


def _not_separated(decision: Decision, found: Robustness) -> frozenset[int] | None:
    """The designs that the evidence does not separate from the choice; None where their uncertainty is not known."""
    uncertainty = None if found.weighting is None else found.weighting.uncertainty
    if uncertainty is None:
        return None
    return frozenset((*decision.ties, *(found.variants[one.row] for one in uncertainty.rivals if not one.separated)))


def _kept(standings: Standings, margin: float) -> tuple[KeptAlternative, ...]:
    return worth_keeping(
        standings.values,
        standings.feasible,
        standings.weights,
        among=admitted_weights(standings.problem),
        margin=margin,
    )


def _agreement(standings: Standings) -> StakeholderAgreement | None:
    trade_off = standings.project.study.trade_off
    if not trade_off.stakeholders:
        return None
    problem, table = standings.problem, standings.table
    weighed = _weighed(problem, [one.weights for one in trade_off.stakeholders])
    values = [problem.value_function(measure).values_at(table.column(measure)) for measure in weighed]
    named = [
        (one.name, np.array([one.weights.get(measure, 0.0) for measure in weighed])) for one in trade_off.stakeholders
    ]
    return stakeholder_agreement(np.stack(values, axis=1), standings.feasible, named, within=trade_off.accept_within)


def _weighed(problem: TradeProblem, of_stakeholders: Sequence[Mapping[str, float]]) -> tuple[str, ...]:
    """The measures with a weight for the study or for a stakeholder: a supposed weight of 0 is the study's alone."""
    weights = problem.weighting.weights
    return tuple(
        measure
        for measure, weight in weights.items()
        if weight > 0.0 or any(one.get(measure, 0.0) > 0.0 for one in of_stakeholders)
    )
