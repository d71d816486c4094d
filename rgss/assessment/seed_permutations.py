"""Permutation test of draws that all designs of a seed share, conditional on which designs ran with which seeds."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.assessment.within_designs import Array

PERMUTATIONS = 19_999
"""Permutations that are drawn where there are more; else all are taken."""

_BATCH = 50
"""Orders at a time: products of larger matrices take threads longer to divide than to compute."""
_EQUAL = 1e-9

Orders = NDArray[np.intp]


def permutation_p_values(contrasts: Array, scores: Array, blocks: Sequence[int]) -> Array:
    """Two-sided p of the association of contrasts and scores, by permutation of the seeds of a block among themselves.

    Args:
        contrasts: Weight of each seed in each statistic, shape (k, seeds).
        scores: Ranks of each draw, shape (c, seeds).
        blocks: The block of each seed, shape (seeds,).

    Returns:
        Shape (k, c): twice the lesser tail, at most 1; the observed order counts as one of those drawn.
    """
    observed = contrasts @ scores.T
    slack = _EQUAL * np.maximum(1.0, np.abs(observed))
    less, greater, count = np.zeros(observed.shape), np.zeros(observed.shape), 0
    members = [np.flatnonzero(np.asarray(blocks) == block) for block in sorted({*blocks})]
    is_all = math.prod(math.factorial(len(one)) for one in members) <= PERMUTATIONS
    for orders in _every_order(members) if is_all else _drawn_orders(members):
        found = contrasts[:, orders] @ scores.T
        less += (found <= observed[:, None] + slack[:, None]).sum(axis=1)
        greater += (found >= observed[:, None] - slack[:, None]).sum(axis=1)
        count += len(orders)
    own = 0 if is_all else 1
    tail: Array = (np.minimum(less, greater) + own) / (count + own)
    return np.minimum(1.0, 2.0 * tail)


def _every_order(members: Sequence[Orders]) -> Iterator[Orders]:
    """All orders of the seeds, in batches."""
    places = np.concatenate(members)
    every = itertools.product(*(itertools.permutations(one.tolist()) for one in members))
    while batch := list(itertools.islice(every, _BATCH)):
        orders = np.empty((len(batch), len(places)), dtype=np.intp)
        orders[:, places] = [list(itertools.chain.from_iterable(one)) for one in batch]
        yield orders


def _drawn_orders(members: Sequence[Orders]) -> Iterator[Orders]:
    """Random orders of the seeds, in batches."""
    generator = np.random.Generator(np.random.Philox(key=1))
    places = np.concatenate(members)
    block = np.repeat(np.arange(len(members)), [len(one) for one in members])
    for start in range(0, PERMUTATIONS, _BATCH):
        keys = generator.random((min(_BATCH, PERMUTATIONS - start), len(places)))
        orders = np.empty(keys.shape, dtype=np.intp)
        # The keys of a block lie between whole numbers, so that sorting leaves it in its place.
        orders[:, places] = places[np.argsort(keys + block, axis=1)]
        yield orders
