"""Price of a requirement: the best value and the feasible set as functions of its threshold."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.tradeoff.problem import TIE_TOLERANCE, Array, Mask


@dataclass(frozen=True, slots=True, kw_only=True)
class PriceStep:
    """A range of thresholds over which nothing changes.

    Attributes:
        loosest: The loosest threshold of the range, which is not part of it; infinite where the
            range has no end.
        tightest: The tightest, which is; infinite where nothing is feasible however tight.
        best: The best alternatives, ascending; empty where none is feasible.
        value: Their value; None where none is feasible.
        feasible: Number of feasible alternatives.
        leaving: The alternatives that a tighter threshold than `tightest` excludes, ascending.
    """

    loosest: float
    tightest: float
    best: tuple[int, ...]
    value: float | None
    feasible: int
    leaving: tuple[int, ...]


def price_list(
    quantities: Array,
    totals: Array,
    otherwise_feasible: Mask,
    *,
    at_least: bool,
    best_of: Callable[[Mask], Mask] | None = None,
) -> tuple[PriceStep, ...]:
    """The best value as an exact step function of one threshold, all others staying as they are.

    It falls (or stays) as the threshold tightens, and jumps only at quantities of alternatives.

    Args:
        quantities: Quantities that the threshold bounds, shape (n,); NaN where unknown, and
            then no threshold is met.
        totals: The weighted values, shape (n,); NaN only where not feasible.
        otherwise_feasible: Mask of the alternatives that meet everything else, shape (n,).
        at_least: Whether the threshold is a lower bound; an upper one otherwise.
        best_of: Callback that returns the best of some alternatives, where it is not those of the highest
            weighted value; the value then need not fall.

    Returns:
        The steps from the loosest thresholds to the tightest; the last one is where nothing is
        feasible any more. Together they cover every threshold once.

    Raises:
        TradeoffError: The value of an alternative that could be chosen is not known.
    """
    rows = np.flatnonzero(otherwise_feasible & ~np.isnan(quantities))
    if np.isnan(totals[rows]).any():
        raise TradeoffError(
            "a price list needs the value of every alternative that a threshold could admit",
            hint="an alternative with an unknown weighted measure cannot be chosen",
        )
    # Larger is looser or tighter by the sense of the threshold; as tightness, larger is tighter.
    tightness = quantities[rows] if at_least else -quantities[rows]
    sign = 1.0 if at_least else -1.0
    steps = []
    before = -math.inf
    for level in np.unique(tightness):
        here = rows[tightness >= level]
        best = _highest(totals, here) if best_of is None else np.flatnonzero(best_of(_mask(here, len(totals))))
        steps.append(
            PriceStep(
                loosest=sign * before,
                tightest=sign * float(level),
                best=tuple(int(row) for row in best),
                value=float(totals[best].max()),
                feasible=len(here),
                leaving=tuple(int(row) for row in rows[tightness == level]),
            )
        )
        before = float(level)
    steps.append(
        PriceStep(
            loosest=sign * before,
            tightest=sign * math.inf,
            best=(),
            value=None,
            feasible=0,
            leaving=(),
        )
    )
    return tuple(steps)


def changes_of_best(steps: tuple[PriceStep, ...]) -> tuple[PriceStep, ...]:
    """The steps with neighbours of the same best alternatives joined.

    Args:
        steps: Those of `price_list`.

    Returns:
        One step for each change of the best; `feasible` is the number at its loose end, `leaving`
        what leaves over the whole of it.
    """
    joined: list[PriceStep] = []
    for step in steps:
        if joined and joined[-1].best == step.best:
            last = joined[-1]
            joined[-1] = PriceStep(
                loosest=last.loosest,
                tightest=step.tightest,
                best=last.best,
                value=last.value,
                feasible=last.feasible,
                leaving=tuple(sorted((*last.leaving, *step.leaving))),
            )
        else:
            joined.append(step)
    return tuple(joined)


def step_at(steps: tuple[PriceStep, ...], threshold: float, *, at_least: bool) -> PriceStep:
    """The step that a threshold lies in.

    Args:
        steps: Those of `price_list` or `changes_of_best`.
        threshold: The threshold; finite.
        at_least: As for `price_list`.
    """
    tightness = threshold if at_least else -threshold
    return next(step for step in steps if tightness <= (step.tightest if at_least else -step.tightest))


def _highest(totals: Array, rows: NDArray[np.intp]) -> NDArray[np.intp]:
    return np.asarray(rows[totals[rows] >= totals[rows].max() - TIE_TOLERANCE], dtype=np.intp)


def _mask(rows: NDArray[np.intp], size: int) -> Mask:
    mask = np.zeros(size, dtype=np.bool_)
    mask[rows] = True
    return mask
