"""Choice among alternatives of the same value by the quantities beyond the ends of value functions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem.alternatives import Array
from rgss.tradeoff.problem.dominance import nondominated
from rgss.tradeoff.problem.evidence_table import EvidenceTable
from rgss.tradeoff.problem.values import ValueFunction

_SAME = 1e-6
"""Relative difference of quantities that are practically equal."""

_NONE = 1e-9
"""The same as a share of the largest quantity: the tolerance of a tie, and more than binary rounding about 0."""


def chosen_of_equals(
    table: EvidenceTable, value_functions: Sequence[ValueFunction], rows: NDArray[np.intp], *, last_of_equals: bool
) -> int | None:
    """The alternative that is chosen of those of the same value; None if there is none.

    Args:
        table: The alternatives.
        value_functions: The value functions of the measures that decide.
        rows: Rows of the alternatives of the same value, in rising order of their ids, shape (k,).
        last_of_equals: Whether the largest id of those that no other surpasses is chosen; the smallest otherwise.
    """
    if not len(rows):
        return None
    kept = rows[~surpassed_equals(table, value_functions, rows)]
    return int(table.variants[kept[-1 if last_of_equals else 0]])


def surpassed_equals(
    table: EvidenceTable, value_functions: Sequence[ValueFunction], rows: NDArray[np.intp]
) -> NDArray[np.bool_]:
    """Mask of the alternatives, all of the same value, that another of them surpasses.

    Another surpasses it if it is at least as good in the quantity of every valued measure and better in one. A
    measure of which more is worth more up to a target and less beyond counts by its value.

    Args:
        table: The alternatives.
        value_functions: The value functions of the measures that decide.
        rows: Rows of the alternatives of the same value, shape (k,).

    Returns:
        Shape (k,).
    """
    columns = []
    for function in value_functions:
        column = table.column(function.measure)[rows]
        known = column[np.isfinite(column)]
        scale = float(np.abs(known).max()) if len(known) else 0.0
        if len(known) < len(column) or scale == 0.0:
            continue
        oriented = column / scale if function.more_is_better else -column / scale
        if function.more_is_better is None:
            oriented = function.values_at(column)
        columns.append(_places(oriented))
    if not columns or len(rows) <= 1:
        return np.zeros(len(rows), dtype=np.bool_)
    return ~nondominated(np.column_stack(columns))


def _places(quantities: Array) -> Array:
    """Place of each quantity among those that differ, from the least; shape (k,)."""
    order = np.argsort(quantities, kind="stable")
    rising = quantities[order]
    larger = np.maximum(np.abs(rising[1:]), np.abs(rising[:-1]))
    steps = np.diff(rising) > np.maximum(_SAME * larger, _NONE)
    places = np.empty(len(quantities))
    places[order] = np.concatenate([[0.0], np.cumsum(steps)])
    return places
