"""Alternatives as arrays of values, the input of robustness analyses, with validation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

SAME_VALUE = 1e-12
"""Alternatives whose single values differ by less are one and the same to an analysis."""


def checked_values(values: Array) -> Array:
    """Validated single values of alternatives.

    Args:
        values: One row for each alternative and one column for each measure, shape (n, m).

    Raises:
        TradeoffError: The array does not have two dimensions, or an entry is not a number from 0 to 1.
    """
    table = np.asarray(values, dtype=np.float64)
    if table.ndim != 2 or 0 in table.shape:
        raise TradeoffError(
            f"the values are not a table of alternatives by measures: their shape is {table.shape}",
            hint="give one row for each alternative and one column for each weighted measure",
        )
    wrong = ~((table >= 0.0) & (table <= 1.0))
    if wrong.any():
        row, column = (int(index) for index in np.argwhere(wrong)[0])
        raise TradeoffError(
            f"the values have {table[row, column]:g} in row {row}, column {column}",
            hint="a value is a number from 0 to 1; leave out alternatives in which it is unknown",
        )
    return table


def checked_weights(weights: Array, size: int) -> Array:
    """Weights, after a check.

    Raises:
        TradeoffError: Their number is another, one is negative, or they do not sum to 1.
    """
    row = np.asarray(weights, dtype=np.float64)
    if row.shape != (size,) or not (row >= 0.0).all() or abs(float(row.sum()) - 1.0) > 1e-9:
        raise TradeoffError(
            f"the weights {np.array2string(row, precision=6)} do not fit {size} measures",
            hint="give one non-negative weight for each measure; they sum to 1",
        )
    return row


def classes(values: Array) -> tuple[Array, NDArray[np.intp]]:
    """Alternatives with the same values, taken together.

    Args:
        values: Shape (n, m).

    Returns:
        The values of each class, in the order of its first member, shape (c, m); and the class of
        each alternative, shape (n,).
    """
    _, first, inverse = np.unique(
        np.round(values / SAME_VALUE) * SAME_VALUE, axis=0, return_index=True, return_inverse=True
    )
    order = np.argsort(first)
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return values[first[order]], place[np.asarray(inverse).reshape(-1)]
