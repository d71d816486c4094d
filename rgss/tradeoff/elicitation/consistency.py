"""Inconsistency of ratio answers: indices with their thresholds, the worst triad, the worst answer."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from rgss.tradeoff.elicitation.answers import PairwiseAnswer
from rgss.tradeoff.elicitation.difference_bounds import implied_bounds, least_missing
from rgss.tradeoff.elicitation.least_squares import design_matrix, fitted_logs

_ROUNDING = 1e-6

GREATEST_RATIO = 0.10
"""Saaty, *The Analytic Hierarchy Process*, 1980: a matrix with a greater consistency ratio is to be revised."""

RANDOM_INDEX = MappingProxyType(
    {
        3: 0.5245, 4: 0.8815, 5: 1.1086, 6: 1.2479, 7: 1.3417, 8: 1.4056, 9: 1.4499, 10: 1.4854,
        11: 1.5140, 12: 1.5365, 13: 1.5551, 14: 1.5713, 15: 1.5838,
    }
)  # fmt: skip
"""Mean index of random matrices by size: Alonso and Lamata, "Consistency in the analytic hierarchy process", 2006."""

GREATEST_INDEX = MappingProxyType({3: 0.3147, 4: 0.3526})
GREATEST_INDEX_BEYOND = 0.3700
"""The index at a ratio of 0.10: Aguarón and Moreno-Jiménez, "The geometric consistency index", 2003."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Triad:
    """Three answers around three criteria.

    Attributes:
        answers: The answers.
        factor: The product around the circle or its inverse, at least 1; 1 where they agree.
        mends: For each answer, the ratio with which the three would agree.
    """

    answers: tuple[PairwiseAnswer, PairwiseAnswer, PairwiseAnswer]
    factor: float
    mends: tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class WorstAnswer:
    """The answer that is farthest from the weights that fit all of them.

    Attributes:
        answer: The answer.
        factor: By how much its ratio and that of the weights differ, at least 1.
        fitted: The ratio of the weights.
        implied: The ratio that the other answers imply; None if they do not connect the two criteria.
    """

    answer: PairwiseAnswer
    factor: float
    fitted: float
    implied: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class RatioBeyondBounds:
    """A ratio that the orders and ranges exclude.

    Attributes:
        answer: The answer.
        least: The least ratio that they allow; 0 without one.
        most: The greatest; infinite without one.
    """

    answer: PairwiseAnswer
    least: float
    most: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Consistency:
    """Consistency of ratio answers.

    Attributes:
        criteria: Number n of criteria that ratio answers name.
        answers: Number of ratio answers.
        checks: Number of redundant answers, which check the others.
        ratio: Saaty's consistency ratio; None unless each of the n (n - 1) / 2 pairs has one answer and 3 <= n <= 15.
        index: The geometric consistency index, the residual variance of the logarithms (Crawford and Williams, "A note
            on the analysis of subjective judgment matrices", 1985); None without redundant answers.
        index_limit: The index above which answers should be revised; exact for complete matrices.
        worst_triad: The least consistent triad of answers; None if there is none.
        worst_answer: The least consistent answer; None without redundant answers.
        bounds: Number of orders and ranges.
        bound_factor: By how much more the worst ratio must be missed because of them, at least 1.
        beyond_bounds: The ratios that they exclude by themselves.
    """

    criteria: int
    answers: int
    checks: int
    ratio: float | None
    index: float | None
    index_limit: float
    worst_triad: Triad | None
    worst_answer: WorstAnswer | None
    bounds: int = 0
    bound_factor: float = 1.0
    beyond_bounds: tuple[RatioBeyondBounds, ...] = ()

    @property
    def greatest_bound_factor(self) -> float:
        """The factor above which the answers should be revised: that of one residual at the limit of the index."""
        return math.exp(math.sqrt(self.index_limit))

    @property
    def is_contradicted(self) -> bool:
        """True if orders and ranges contradict the ratios, by however little."""
        return self.bound_factor > 1.0 + _ROUNDING

    @property
    def is_acceptable(self) -> bool | None:
        """True if all figures are within their limits; None if no ratio checks another and no bound contradicts one."""
        if self.bound_factor > self.greatest_bound_factor:
            return False
        if self.index is None:
            return True if self.is_contradicted else None
        return self.index <= self.index_limit and (self.ratio is None or self.ratio <= GREATEST_RATIO)


def consistency_of(names: Sequence[str], answers: Sequence[PairwiseAnswer]) -> Consistency | None:
    """Consistency of the ratio answers; None if there are none."""
    ratios = [answer for answer in answers if answer.is_ratio]
    named = [name for name in names if any(name in (one.swing_of, one.over) for one in ratios)]
    if not ratios:
        return None
    matrix, logs = design_matrix(named, ratios)
    checks = len(ratios) - int(np.linalg.matrix_rank(matrix))
    fitted = matrix @ fitted_logs(matrix, logs)
    residuals = logs - fitted
    index = float(residuals @ residuals) / checks if checks else None
    bounds = [answer for answer in answers if not answer.is_ratio]
    return Consistency(
        criteria=len(named),
        answers=len(ratios),
        checks=checks,
        ratio=_saaty_ratio(named, ratios),
        index=index,
        index_limit=GREATEST_INDEX.get(len(named), GREATEST_INDEX_BEYOND),
        worst_triad=_worst_triad(named, ratios),
        worst_answer=None if index is None else _worst_answer(named, ratios, residuals, fitted),
        bounds=len(bounds),
        bound_factor=least_missing(names, ratios, bounds)[1] / least_missing(names, ratios, ())[1] if bounds else 1.0,
        beyond_bounds=_beyond_bounds(names, ratios, bounds),
    )


def _beyond_bounds(
    names: Sequence[str], ratios: Sequence[PairwiseAnswer], bounds: Sequence[PairwiseAnswer]
) -> tuple[RatioBeyondBounds, ...]:
    lower = implied_bounds(names, bounds)
    found = []
    for one in ratios:
        of, over = names.index(one.swing_of), names.index(one.over)
        least, most = math.exp(lower[over, of]), math.exp(-lower[of, over])
        if not least * (1.0 - _ROUNDING) <= one.ratio <= most * (1.0 + _ROUNDING):
            found.append(RatioBeyondBounds(answer=one, least=least, most=most))
    return tuple(found)


def _saaty_ratio(names: Sequence[str], ratios: Sequence[PairwiseAnswer]) -> float | None:
    size = len(names)
    pairs = {frozenset((one.swing_of, one.over)) for one in ratios}
    if size not in RANDOM_INDEX or len(ratios) != len(pairs) or len(pairs) != size * (size - 1) // 2:
        return None
    matrix = np.ones((size, size))
    for one in ratios:
        row, column = names.index(one.swing_of), names.index(one.over)
        matrix[row, column], matrix[column, row] = one.ratio, 1.0 / one.ratio
    largest = float(np.linalg.eigvals(matrix).real.max())
    return max(0.0, (largest - size) / (size - 1)) / RANDOM_INDEX[size]


def _worst_triad(names: Sequence[str], ratios: Sequence[PairwiseAnswer]) -> Triad | None:
    # A pair may be answered twice.
    given: dict[frozenset[str], list[PairwiseAnswer]] = {}
    for answer in ratios:
        given.setdefault(frozenset((answer.swing_of, answer.over)), []).append(answer)
    worst: Triad | None = None
    for three in itertools.combinations(names, 3):
        pairs = [frozenset(pair) for pair in itertools.combinations(three, 2)]
        for one, across, other in itertools.product(*(given.get(pair, ()) for pair in pairs)):
            # Around the circle first → second → third → first.
            around = _log(one, three[0]) + _log(other, three[1]) - _log(across, three[0])
            if worst is None or math.exp(abs(around)) > worst.factor * (1.0 + 1e-12):
                turns = (_turn(one, three[0]), -_turn(across, three[0]), _turn(other, three[1]))
                answers = (one, across, other)
                mends = tuple(
                    answer.ratio * math.exp(-around * turn) for answer, turn in zip(answers, turns, strict=True)
                )
                worst = Triad(answers=answers, factor=math.exp(abs(around)), mends=(mends[0], mends[1], mends[2]))
    return worst


def _turn(answer: PairwiseAnswer, heavier: str) -> int:
    return 1 if answer.swing_of == heavier else -1


def _log(answer: PairwiseAnswer, heavier: str) -> float:
    """The logarithm of the ratio with the criterion that is named as the first."""
    return _turn(answer, heavier) * math.log(answer.ratio)


def _worst_answer(
    names: Sequence[str], ratios: Sequence[PairwiseAnswer], residuals: np.ndarray, fitted: np.ndarray
) -> WorstAnswer:
    place = int(np.argmax(np.round(np.abs(residuals), 12)))
    others = [one for number, one in enumerate(ratios) if number != place]
    matrix, logs = design_matrix(names, others)
    row = design_matrix(names, [ratios[place]])[0]
    known = np.linalg.matrix_rank(np.vstack([matrix, row])) == np.linalg.matrix_rank(matrix) if others else False
    implied = float(np.exp(row @ fitted_logs(matrix, logs))[0]) if known else None
    return WorstAnswer(
        answer=ratios[place],
        factor=math.exp(abs(float(residuals[place]))),
        fitted=math.exp(float(fitted[place])),
        implied=implied,
    )
