"""The largest full factorial design among designs of which some have no estimate."""

from __future__ import annotations

import itertools
import math

import numpy as np
from numpy.typing import NDArray

MOST_BLOCKS = 300_000
"""Largest number of choices of levels that are examined for the largest complete block."""


def largest_complete_block(known: NDArray[np.bool_]) -> tuple[tuple[int, ...], ...] | None:
    """Largest sub-grid of levels with all combinations known.

    Designs without an estimate would confound the effects of the others, and are not imputed; the result is a smaller
    balanced design.

    Args:
        known: Mask of the designs with an estimate, one axis for each factor.

    Returns:
        The kept levels of each factor; of the largest blocks the one with most levels of the earlier factors. None if
        no block has two levels of some factor, or if more than `MOST_BLOCKS` would have to be examined.
    """
    if known.all() and known.size > 1:
        return tuple(tuple(range(length)) for length in known.shape)
    if math.prod(2**length - 1 for length in known.shape) > MOST_BLOCKS:
        return None
    best: tuple[int, tuple[tuple[int, ...], ...]] | None = None
    choices = [
        [kept for size in range(length, 0, -1) for kept in itertools.combinations(range(length), size)]
        for length in known.shape
    ]
    for kept in itertools.product(*choices):
        size = math.prod(len(levels) for levels in kept)
        if size > (best[0] if best else 1) and known[np.ix_(*kept)].all():
            best = (size, kept)
    return None if best is None else best[1]
