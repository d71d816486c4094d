"""Rare changes of a metric that none of the compared seeds has."""

from __future__ import annotations

import math

from rgss.regression.comparing import Series


def unseen_p_value(baseline: Series, margin: float, seeds: int, *, greatest_move: float = 0.0) -> float:
    """P-value of a mean that moves by its margin because a few seeds move by much and the others stay.

    Tests of a mean know the spread of the compared seeds alone. If a share ψ of all seeds moves, none of these is among
    n with a probability of (1 - ψ)^n, and the mean seems to stay where it is. A single seed is assumed to move by no
    more than the range R of the baseline's seeds, or than the greatest move that was seen; then the mean moves by the
    margin m if a share of m / R does.

    Args:
        baseline: The baseline's values, also those of seeds that are not compared.
        margin: The margin m.
        seeds: The number n of compared seeds.
        greatest_move: Greatest difference of a compared seed.

    Returns:
        (1 - m / R)^n; 0 where no seed moves by more than the margin.
    """
    span = max(_range_of_seeds(baseline), greatest_move)
    return 0.0 if span <= margin else (1.0 - margin / span) ** seeds


def _range_of_seeds(series: Series) -> float:
    """Greatest minus least mean of the designs over the seeds that any of them has a value of."""
    means = []
    for seed in {seed for row in series.values() for seed in row}:
        known = [value for row in series.values() if (value := row.get(seed)) is not None]
        if known:
            means.append(math.fsum(known) / len(known))
    return max(means) - min(means) if means else 0.0
