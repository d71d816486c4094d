"""Pareto dominance among many alternatives, exact however many they are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError


def nondominated(values: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Mask of the rows that no other row dominates.

    A row dominates another if it is at least as high in every column and higher in one. Rows that
    are equal do not dominate each other, so duplicates of an undominated row are all kept.

    The divide-and-conquer algorithm of Kung, Luccio and Preparata ("On finding the maxima of a set
    of vectors", 1975), O(n log^(m-2) n) for four columns and more, as moocore implements it. Only
    comparisons are made, no arithmetic, so the answer is exact.

    Args:
        values: One row for each alternative and one column for each measure, shape (n, m), more
            being better in every column. The entries are finite.

    Returns:
        Whether each row is undominated, shape (n,).

    Raises:
        TradeoffError: The values are not a table of finite numbers with at least one column.
    """
    table = np.ascontiguousarray(values, dtype=np.float64)
    if table.ndim != 2 or table.shape[1] == 0:
        raise TradeoffError(
            f"dominance needs a table of alternatives by measures, not one of shape {table.shape}",
            hint="give one row for each alternative and at least one column",
        )
    if not np.isfinite(table).all():
        row, column = (int(index) for index in np.argwhere(~np.isfinite(table))[0])
        raise TradeoffError(
            f"dominance needs finite numbers: row {row}, column {column} is {table[row, column]:g}",
            hint="leave out alternatives with an unknown measure",
        )
    if table.shape[0] == 0:
        return np.zeros(0, dtype=np.bool_)
    if table.shape[1] == 1:
        return np.asarray(table[:, 0] == table[:, 0].max(), dtype=np.bool_)
    import moocore

    return np.asarray(moocore.is_nondominated(table, maximise=True, keep_weakly=True), dtype=np.bool_)
