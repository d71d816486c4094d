"""Trials with one kind of failure compared with the other trials of the same design."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WithinDesigns:
    """Trials of the designs that have some with a failure and some without.

    Attributes:
        failed: Mask of the trials with it, shape (designs, seeds).
        others: Mask of the trials without, shape (designs, seeds).
        weights: Weight of each design, shape (designs,).
    """

    failed: Mask
    others: Mask
    weights: Array

    @staticmethod
    def of(failed: Mask, ran: Mask) -> WithinDesigns:
        """The designs of some trials that show both.

        A design's weight is the mean over its seeds of one over the number of designs with that seed, so that each
        seed counts about once however many designs it was run with.

        Args:
            failed: Mask of the trials with the failure, shape (n, seeds).
            ran: Mask of all trials, shape (n, seeds).
        """
        others = ran & ~failed
        both = failed.any(axis=1) & others.any(axis=1)
        own = ran[both]
        weights = (own / np.maximum(ran.sum(axis=0), 1)).sum(axis=1) / own.sum(axis=1)
        return WithinDesigns(failed=failed[both], others=others[both], weights=weights)

    @property
    def designs(self) -> int:
        """Number of designs."""
        return len(self.failed)

    @property
    def fewest_seeds(self) -> int:
        """Number of seeds with a failure, or of those with another trial if they are fewer."""
        return min(int(self.failed.any(axis=0).sum()), int(self.others.any(axis=0).sum()))

    @property
    def contrast(self) -> Array:
        """Weight of each seed in the statistic, shape (seeds,): a failure less the share of failures of its design."""
        ran = self.failed | self.others
        share = self.failed.sum(axis=1) / ran.sum(axis=1)
        contrasts: Array = self.weights @ (self.failed - share[:, None] * ran)
        return contrasts

    @property
    def pairs(self) -> Array:
        """Weight of each pair of seeds of a failure and of another trial of a design, shape (seeds, seeds)."""
        weights = self.weights / (self.failed | self.others).sum(axis=1)
        counted: Array = (self.failed * weights[:, None]).T @ self.others.astype(float)
        return counted


def weighted_auc(pairs: Array, values: Array) -> float:
    """Weighted share of the pairs whose first value is the greater; equals count half.

    Args:
        pairs: Weight of each pair of seeds, shape (seeds, seeds).
        values: Value of each seed, shape (seeds,).
    """
    wins = np.sign(values[:, None] - values[None, :]) / 2 + 0.5
    return float((pairs * wins).sum() / pairs.sum())
