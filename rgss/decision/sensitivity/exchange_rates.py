"""Exchange rates: what a better quantity of each measure is worth to the chosen design, in units of one measure."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.currencies import is_currency
from rgss.decision.sensitivity.standings import Standings
from rgss.decision.sensitivity.tornado import Tornado
from rgss.tradeoff.problem import EVIDENCE_PREFIX, TIE_TOLERANCE, ValueFunction
from rgss.tradeoff.programs import violations

_HALVINGS = 200
_EQUAL = 1e-9
"""Quantities nearer to each other than this share of them are equal."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Worth:
    """Change of value, paid in units of the reference measure.

    Attributes:
        amount: The least amount by which the reference may get worse for the same loss of value, at least 0.
        is_bound: True if even the worst end of the reference's value function, at that amount, loses less.
    """

    amount: float
    is_bound: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class BetterDesign:
    """Design that is better in a measure, for the least worsening of the reference.

    Attributes:
        variant: Its id.
        quantity: Its quantity of the measure.
        extra: Its quantity of the reference minus that of the chosen design, in the reference's unit.
        value_change: Its weighted value minus that of the chosen design; NaN if a quantity is unknown.
        misses: The requirements that it misses; empty if it is feasible.
        is_tied: Whether the evidence does not separate its value from that of the chosen design; None if there is too
            little evidence to tell.
    """

    variant: int
    quantity: float
    extra: float
    value_change: float
    misses: tuple[str, ...]
    is_tied: bool | None


@dataclass(frozen=True, slots=True, kw_only=True)
class ExchangeRate:
    """Worth of a better quantity of one measure.

    Attributes:
        measure: The measure.
        unit: Its unit.
        quantity: The quantity of the chosen design.
        step: A change for the better, in the measure's unit: a tenth of the range of its value function, rounded to
            1, 2 or 5 times a power of ten, or what is left to the quantity with the value 1; 0 if nothing is left.
        gain: The weighted value that it adds.
        worth: The same in the reference.
        better: The design with a better quantity, at the least worsening of the reference: of the feasible designs,
            or of all if no feasible one is better. None if none is.
    """

    measure: str
    unit: str
    quantity: float
    step: float
    gain: float
    worth: Worth
    better: BetterDesign | None


@dataclass(frozen=True, slots=True, kw_only=True)
class ExchangeRates:
    """Worth of better quantities to the chosen design: pricing out, in the measure that serves as currency.

    Keeney, Raiffa, *Decisions with Multiple Objectives*, 1976, chapter 3: two changes that cancel in value are worth
    the same. The rates follow from weights and value functions alone; they are a test of both, as nobody who would
    pay less for a step holds these weights.

    Attributes:
        variant: The chosen design.
        reference: The measure in which all is paid.
        unit: Its unit.
        more_is_better: Whether more of it is better; if so, paying reduces it.
        rates: One for each other measure with a weight above 0, in the order of the study.
        rival: The best rival that is not tied with the chosen design; None if there is none.
        lead: Its lead over the rival, in the reference; None without a rival.
    """

    variant: int
    reference: str
    unit: str
    more_is_better: bool
    rates: tuple[ExchangeRate, ...]
    rival: int | None
    lead: Worth | None


def exchange_rates_of(
    standings: Standings, tornado: Tornado, *, tied: Collection[int] | None = None
) -> ExchangeRates | None:
    """The exchange rates at the chosen design.

    The reference is the measure that the study names, or the first in money, or the one with the greatest weight;
    more or less of it is better throughout.

    Args:
        standings: The designs of the study.
        tornado: The sensitivity of the choice, with its lead.
        tied: Ids of the designs that the evidence does not separate from the choice; None if that is not known.

    Returns:
        The rates; None if each measure with a weight has a target, or only one measure has a weight.
    """
    reference = _reference(standings)
    if reference is None or len(standings.measures) < 2:
        return None
    pricing = _Pricing(standings, reference, standings.table.row_of(tornado.chosen), tied)
    return ExchangeRates(
        variant=tornado.chosen,
        reference=reference,
        unit=_unit(standings, reference),
        more_is_better=pricing.direction > 0.0,
        rates=tuple(pricing.rate(measure) for measure in standings.measures if measure != reference),
        rival=tornado.rival,
        lead=None if tornado.lead is None else pricing.worth(tornado.lead),
    )


class _Pricing:
    """Values of changes at the chosen design, in the reference."""

    def __init__(self, standings: Standings, reference: str, chosen: int, tied: Collection[int] | None) -> None:
        self._standings = standings
        self._functions = _functions(standings)
        self._weights: dict[str, float] = dict(zip(standings.measures, standings.weights.tolist(), strict=True))
        self._chosen = chosen
        self._reference = reference
        self._tied = tied
        self.direction = 1.0 if self._functions[reference].more_is_better else -1.0

    def worth(self, gain: float) -> Worth:
        """The amount of the reference that is worth a gain of value."""
        if gain <= TIE_TOLERANCE:
            return Worth(amount=0.0, is_bound=False)
        function, weight = self._functions[self._reference], self._weights[self._reference]
        quantity = self._quantity(self._reference)
        before = function.value_at(quantity)

        def lost(amount: float) -> float:
            return weight * (before - function.value_at(quantity - self.direction * amount))

        most = max(self.direction * (quantity - function.ends_at(quantity)[0]), 0.0)
        if lost(most) < gain - TIE_TOLERANCE:
            return Worth(amount=most, is_bound=True)
        low, high = 0.0, most
        for _ in range(_HALVINGS):
            middle = (low + high) / 2.0
            if middle in (low, high):
                break
            low, high = (low, middle) if lost(middle) >= gain else (middle, high)
        return Worth(amount=high, is_bound=False)

    def rate(self, measure: str) -> ExchangeRate:
        """The worth of a step in one measure."""
        function, quantity = self._functions[measure], self._quantity(measure)
        step = _step(function, quantity)
        gained = function.value_at(quantity + step) - function.value_at(quantity)
        gain = self._weights[measure] * max(gained, 0.0)
        return ExchangeRate(
            measure=measure,
            unit=_unit(self._standings, measure),
            quantity=quantity,
            step=step,
            gain=gain,
            worth=self.worth(gain),
            better=self._better(measure),
        )

    def _quantity(self, measure: str) -> float:
        return float(self._standings.table.column(measure)[self._chosen])

    def _better(self, measure: str) -> BetterDesign | None:
        table, feasible = self._standings.table, self._standings.feasible
        quantities, extra = table.column(measure), table.column(self._reference) - self._quantity(self._reference)
        goodness = _goodness(self._functions[measure], quantities)
        mine = goodness[self._chosen]
        better = (goodness > mine + _EQUAL * max(abs(mine), abs(quantities[self._chosen]))) & ~np.isnan(extra)
        rows = np.flatnonzero(better & feasible) if (better & feasible).any() else np.flatnonzero(better)
        if not len(rows):
            return None
        totals = self._standings.as_it_is().totals
        # The least worsening of the reference, then the highest value, then the least id.
        # Differences below the rounding of the quantities, of whatever magnitude, are none.
        grain = _EQUAL * max(float(np.abs(table.column(self._reference)[rows]).max()), 1e-300)
        worse = np.round(-self.direction * extra[rows] / grain)
        row = int(rows[np.lexsort((rows, -np.nan_to_num(totals[rows], nan=-np.inf), worse))[0]])
        variant = int(table.variants[row])
        return BetterDesign(
            variant=variant,
            quantity=float(quantities[row]),
            extra=float(extra[row]),
            value_change=float(totals[row] - totals[self._chosen]),
            misses=self._misses(row),
            is_tied=None if self._tied is None else variant in self._tied,
        )

    def _misses(self, row: int) -> tuple[str, ...]:
        problem = self._standings.problem
        missed = violations(problem, self._standings.table)[row]
        named = zip(problem.requirements, missed, strict=True)
        return tuple(name.removeprefix(EVIDENCE_PREFIX) for name, is_missed in named if is_missed)


def _functions(standings: Standings) -> dict[str, ValueFunction]:
    return {function.measure: function for function in standings.problem.value_functions}


def _unit(standings: Standings, measure: str) -> str:
    return standings.project.measures.measure(measure).unit


def _reference(standings: Standings) -> str | None:
    """The measure in which all is paid."""
    named = standings.project.study.trade_off.sensitivity.priced_in
    if named is not None:
        return named
    functions = _functions(standings)
    monotone = [measure for measure in standings.measures if functions[measure].more_is_better is not None]
    money = [measure for measure in monotone if is_currency(_unit(standings, measure))]
    weights = dict(zip(standings.measures, standings.weights.tolist(), strict=True))
    return money[0] if money else max(monotone, key=weights.__getitem__, default=None)


def _goodness(function: ValueFunction, quantities: NDArray[np.float64]) -> NDArray[np.float64]:
    """Numbers that rise with how good quantities are, also where the value function is level.

    On both sides of a target the distance from it counts as a share of the range there, as in the value, in units of
    the wider range.
    """
    if function.peak is not None:
        ranges = np.array([abs(function.ends_at(one)[0] - function.peak) for one in quantities.tolist()])
        return np.asarray(-np.abs(quantities - function.peak) * (ranges.max() / ranges), dtype=np.float64)
    return quantities if function.more_is_better else -quantities


def _step(function: ValueFunction, quantity: float) -> float:
    """A change for the better: a round tenth of the range, or what is left to the quantity with the value 1."""
    worst, best = function.ends_at(quantity)
    left = best - quantity
    if (best - worst) * left <= 0.0:
        return 0.0
    tenth = abs(best - worst) / 10.0
    scale = 10.0 ** math.floor(math.log10(tenth))
    rounded = min((1.0, 2.0, 5.0, 10.0), key=lambda times: abs(math.log(times * scale / tenth))) * scale
    return math.copysign(min(rounded, abs(left)), left)
